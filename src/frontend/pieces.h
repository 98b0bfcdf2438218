// Splits a clipped polygon into triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "frontend/clip.h"
#include "frontend/vertex.h"

namespace edgewise {

struct Pieces {
  std::array<std::array<std::uint8_t, 3>, Clipper::kMaxVertices - 2> corners;  // indices into the polygon
  std::size_t count = 0;                                                       // the number of vertices - 2
};

// Splits a polygon of 3 … Clipper::kMaxVertices snapped vertices into triangles of one winding, which
// together cover each sample of the polygon once. The split is a fan about the first vertex if that has one
// winding.
//
// Snapping can bend a convex polygon slightly inwards, where a clipped edge lies close to a vertex or to
// another clipped edge. A fan may then contain a thin piece of the other winding. Its samples would be drawn
// twice. And culling, which tests each piece, would keep this piece of a triangle that faces the wrong way.
//
// Two edges within a few 1/256 px of each other may cross after snapping. Then no such split exists, and the
// result is the fan: it loses no sample, but may draw some twice.
Pieces split(std::span<const Vertex> polygon);

}  // namespace edgewise
