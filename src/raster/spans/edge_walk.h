// Walks the edges of a triangle row by row, in integers.
#pragma once

#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"

namespace edgewise {

// The first pixel whose sample is not left of the edge from p down to q, row by row:
//   ceil(((p.x - 128) dy + (s - p.y) dx) / (256 dy)), where s is the height of the row's sample.
// It is stepped with a remainder (Bresenham, "Algorithm for computer control of a digital plotter", 1965), so
// a row costs an addition and a comparison, and no division. All fits 64 bits: dy <= 2^23 and |dx| <= 2^23,
// so numerators stay below 2^49, and the denominator is at most 2^31. proofs/spans.smt2 proves both claims.
class EdgeWalk {
 public:
  EdgeWalk(std::int32_t px, std::int32_t py, std::int32_t qx, std::int32_t qy, int first_row) {
    using namespace contract;
    const std::int64_t dx = qx - px, dy = qy - py;
    denominator_ = dy * kSub;
    const std::int64_t numerator = (px - kHalf) * dy + (sample_sub(first_row) - py) * dx + denominator_ - 1;
    pixel_ = floor_div(numerator, denominator_);
    rest_ = numerator - pixel_ * denominator_;
    pixel_step_ = floor_div(dx, dy);
    rest_step_ = (dx - pixel_step_ * dy) * kSub;
  }
  int pixel() const { return static_cast<int>(pixel_); }
  void next_row() {
    pixel_ += pixel_step_;
    rest_ += rest_step_;
    const std::int64_t carry = rest_ >= denominator_;  // no branch: it would be mispredicted
    rest_ -= denominator_ & -carry;
    pixel_ += carry;
  }

 private:
  static constexpr std::int64_t floor_div(std::int64_t n, std::int64_t d) {
    const std::int64_t q = n / d;
    return q * d > n ? q - 1 : q;
  }
  std::int64_t pixel_, rest_, denominator_, pixel_step_, rest_step_;
};

// Calls span(y, begin, end) for each row of a box inside the triangle's pixel box: of row y, the triangle
// covers the box's pixels begin … end - 1, and none if begin >= end. Spans and boxes are half open, which is
// the top-left rule (rule 4).
template <typename Span>
[[gnu::always_inline]] inline void for_each_span(const contract::Oriented& t, const contract::PixelBox& box,
                                                 Span&& span) {
  // Clockwise on a y-down screen: from the top vertex a, the edge to b goes down on the right side, and the
  // edge to c on the left side.
  const int a = t.y[1] < t.y[0] ? (t.y[2] < t.y[1] ? 2 : 1) : (t.y[2] < t.y[0] ? 2 : 0);
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  const auto walk = [&](int from, int to, int row) {
    return EdgeWalk(t.x[from], t.y[from], t.x[to], t.y[to], row);
  };
  const auto rows = [&](int begin, int end, EdgeWalk left, EdgeWalk right) {
    for (int y = begin; y < end; ++y, left.next_row(), right.next_row())
      span(y, std::max(left.pixel(), box.x0), std::min(right.pixel(), box.x1));
  };
  // One side's edge ends at the middle vertex, and the side goes on along the edge between b and c.
  const int middle = (std::min(t.y[b], t.y[c]) + contract::kHalf - 1) >> contract::kSubBits;
  const int upper_end = std::clamp(middle, box.y0, box.y1);
  if (box.y0 < upper_end) rows(box.y0, upper_end, walk(a, c, box.y0), walk(a, b, box.y0));
  if (upper_end == box.y1) return;
  if (t.y[b] < t.y[c])
    rows(upper_end, box.y1, walk(a, c, upper_end), walk(b, c, upper_end));
  else
    rows(upper_end, box.y1, walk(c, b, upper_end), walk(a, b, upper_end));
}

// Fills pixels [begin, end) of a row where they are nearer. Stores unconditionally, so that compilers
// vectorise it.
inline void fill_span(std::int32_t* depth, std::int32_t* payload, int begin, int end, std::uint32_t z,
                      std::uint32_t zx, std::uint32_t colour) {
  for (int x = begin; x < end; ++x) {
    const auto z_here = static_cast<std::int32_t>(z + static_cast<std::uint32_t>(x) * zx);
    const bool nearer = z_here < depth[x];
    depth[x] = nearer ? z_here : depth[x];
    payload[x] = nearer ? static_cast<std::int32_t>(colour) : payload[x];
  }
}

}  // namespace edgewise
