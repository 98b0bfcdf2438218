// Draws a triangle by testing every pixel of its bounding box.
#pragma once

#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"
#include "edgewise/framebuffer.h"
#include "raster/bands.h"

namespace edgewise {

// Draws the part in `rows`. Three edge functions (rule 4) and the depth plane (rule 6) are evaluated at each
// pixel, or, if stepped, along a row.
template <bool kStepped>
void draw_by_box_test(const ScreenTriangle& triangle, RowRange rows, FrameView frame) {
  using namespace contract;
  const PixelBox box = pixel_box(triangle, frame.width, frame.height);
  const Oriented oriented = orient(triangle);
  if (box.empty() || oriented.area == 0) return;
  const Edge edge[3] = {make_edge(oriented, 0), make_edge(oriented, 1), make_edge(oriented, 2)};
  const DepthPlane plane = make_depth(oriented);
  const auto step = [&](int i) { return std::int64_t{edge[i].a} * kSub; };

  for (int y = std::max(box.y0, rows.begin); y < std::min(box.y1, rows.end); ++y) {
    std::uint32_t* depth = frame.depth + y * frame.stride;
    std::uint32_t* payload = frame.payload + y * frame.stride;
    const auto test_and_write = [&](int x, std::uint32_t z) {
      if (z >= depth[x]) return;
      depth[x] = z;
      payload[x] = triangle.payload;
    };
    if constexpr (kStepped) {
      // Depth is re-based in each cell (rule 6).
      for (int x = box.x0, end; x < box.x1; x = end) {
        end = std::min(box.x1, (x / kDepthCell + 1) * kDepthCell);
        std::int64_t e0 = edge[0].at(x, y), e1 = edge[1].at(x, y), e2 = edge[2].at(x, y);
        std::uint32_t z = plane.at(x, y);
        for (; x < end; ++x) {
          if (e0 >= 0 && e1 >= 0 && e2 >= 0) test_and_write(x, z);
          e0 += step(0), e1 += step(1), e2 += step(2), z += plane.zx;
        }
      }
    } else {
      for (int x = box.x0; x < box.x1; ++x) {
        if (edge[0].at(x, y) < 0 || edge[1].at(x, y) < 0 || edge[2].at(x, y) < 0) continue;
        test_and_write(x, plane.at(x, y));
      }
    }
  }
}

}  // namespace edgewise
