// Rule 4 solved for x: a triangle covers one span of pixels per row, found by one exact division per edge.
#pragma once

#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"

namespace edgewise::lab {

// Calls body(y, begin, end) for each row from `first_row` on in which the triangle covers a pixel.
template <typename Body>
void for_each_span(const ScreenTriangle& triangle, int width, int height, Body&& body, int first_row = 0) {
  using namespace contract;
  const PixelBox box = pixel_box(triangle, width, height);
  const Oriented oriented = orient(triangle);
  if (box.empty() || oriented.area == 0) return;
  const Edge edges[3] = {make_edge(oriented, 0), make_edge(oriented, 1), make_edge(oriented, 2)};
  const auto floor_divide = [](std::int64_t n, std::int64_t d) {
    const std::int64_t q = n / d;
    return q * d > n ? q - 1 : q;
  };
  for (int y = std::max(box.y0, first_row); y < box.y1; ++y) {
    // E grows by 2^15 a from pixel to pixel, so each edge bounds the pixels of a row on one side.
    std::int64_t begin = box.x0, end = box.x1;
    for (const Edge& e : edges) {
      const std::int64_t first = e.at(0, y), step = std::int64_t{e.a} * kPixel_q15;
      if (step > 0)
        begin = std::max(begin, -floor_divide(first, step));
      else if (step < 0)
        end = std::min(end, floor_divide(first, -step) + 1);
      else if (first < 0)
        end = begin;
    }
    if (begin < end) body(y, static_cast<int>(begin), static_cast<int>(end));
  }
}

}  // namespace edgewise::lab
