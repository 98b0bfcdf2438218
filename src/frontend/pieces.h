// The triangles that a clipped polygon falls into.
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
  std::size_t count = 0;                                                       // two less than vertices
};

// Splits a polygon of 3 … Clipper::kMaxVertices snapped vertices into triangles of one winding, so that they
// cover what the polygon does, each sample once; a fan from the first vertex wherever that will do.
//
// Snapping can bend a convex polygon inwards by a hairline, where a cut lies close to a corner or to another
// cut. A fan may then hold a thin piece of the other winding: over it samples would be drawn twice, and
// culling, which judges pieces, would leave pixels of a triangle that faces the wrong way.
//
// Where two edges came so close that they cross once snapped (they lie within a few 1/256 px of each other
// there), no such triangles exist, and the polygon becomes the fan: no sample is lost, some may be drawn
// twice.
Pieces split(std::span<const Vertex> polygon);

}  // namespace edgewise
