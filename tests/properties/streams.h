// Generators of triangle streams that are hard to draw, and how each shrinks.
#pragma once

#include <rapidcheck.h>

#include <cstdint>

#include "edgewise/scene.h"
#include "support.h"

namespace edgewise::testing {

inline float pixels(std::int32_t q15) {
  return static_cast<float>(q15) / contract::kPixel_q15;
}

// `make` turns random numbers and a size of 1 to 100 into a value; `simpler` lists simpler values to try
// instead.
template <typename Value, typename Make, typename Simpler>
rc::Gen<Value> generator(Make make, Simpler simpler) {
  return [=](rc::Random source, int size) {
    Random random(source.next());
    return rc::shrinkable::shrinkRecur(make(random, size), simpler);
  };
}

// Families of lab/cases/hard_triangles.h, up to three in one stream; on the 1/256 px grid, within the guard
// band. Up to 42 triangles and 130 px a side.
rc::Gen<TriangleStream> grid_streams();

// The same, with positions off the grid, many of them half-way between two points of it.
rc::Gen<TriangleStream> float_streams();

// The same, with some vertices beyond the guard band, up to 10^5 px away.
rc::Gen<TriangleStream> far_streams();

// Makes any stream shrinkable in the same way.
rc::Shrinkable<TriangleStream> shrinkable(const TriangleStream& stream);

// Triangulations, fans and slivers among them, of a rectangle whose samples are those of the image; every
// edge is shared whole. They shrink to triangulations.
rc::Gen<TriangleStream> tessellations();

}  // namespace edgewise::testing
