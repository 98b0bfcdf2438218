// The spans of a triangle, in integers.
#pragma once

#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"

namespace edgewise {

// The first pixel whose sample is not left of the edge from p down to q:
//   ceil(((p.x - 2^14) dy + (s - p.y) dx) / (2^15 dy)), where s is the height of the row's sample.
// All fits 64 bits: dy <= 2^30 and |dx| <= 2^30, so the numerator stays below 2^61 (proofs/spans.smt2).
inline std::int64_t first_right_of(std::int32_t px, std::int32_t py, std::int32_t qx, std::int32_t qy,
                                   int row) {
  using namespace contract;
  const std::int64_t dx = qx - px, dy = qy - py, denominator = dy * kPixel_q15;
  const std::int64_t numerator = (px - kHalf_q15) * dy + (sample_q15(row) - py) * dx + denominator - 1;
  return numerator / denominator - (numerator % denominator < 0);  // rounds down
}

// Calls span(y, begin, end) for each row of a box inside the triangle's pixel box: of row y, the triangle
// covers the box's pixels begin … end - 1, and none if begin >= end. Spans and boxes are half open, which is
// the top-left rule (rule 4). Past its end, an edge's line does not cut into the triangle, so every row uses
// all edges. Clockwise on a y-down screen: an edge that goes up is on the left.
template <typename Span>
void for_each_span(const contract::Oriented& t, const contract::PixelBox& box, Span&& span) {
  for (int y = box.y0; y < box.y1; ++y) {
    std::int64_t begin = box.x0, end = box.x1;
    for (int p = 0; p < 3; ++p) {
      const int q = (p + 1) % 3;
      if (t.y[p] < t.y[q]) end = std::min(end, first_right_of(t.x[p], t.y[p], t.x[q], t.y[q], y));
      if (t.y[p] > t.y[q]) begin = std::max(begin, first_right_of(t.x[q], t.y[q], t.x[p], t.y[p], y));
    }
    span(y, static_cast<int>(begin), static_cast<int>(end));
  }
}

// Fills pixels [begin, end) of a row where they are nearer. Stores unconditionally, so that compilers
// vectorise it.
inline void fill_span(std::int32_t* depths, std::int32_t* payloads, int begin, int end, std::uint32_t z,
                      std::uint32_t zx, std::uint32_t payload) {
  for (int x = begin; x < end; ++x) {
    const auto z_here = static_cast<std::int32_t>(z + static_cast<std::uint32_t>(x) * zx);
    const bool nearer = z_here < depths[x];
    depths[x] = nearer ? z_here : depths[x];
    payloads[x] = nearer ? static_cast<std::int32_t>(payload) : payloads[x];
  }
}

}  // namespace edgewise
