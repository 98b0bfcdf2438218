// The tutorials' fill, in plain C++: tests for every pixel of the bounding box whether it is inside.
#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"
#include "raster/kernels.h"

namespace edgewise {

namespace {

using namespace contract;

// Three edge functions (rule 4) and the depth plane (rule 6) are evaluated at each pixel. Inlined into the
// loop over triangles, GCC 12 keeps them in memory, and frames of cubes take 1.2 times as long.
[[gnu::noinline]] void draw_box(const ScreenTriangle& triangle, const FrameTask& task) {
  const PixelBox box = pixel_box(triangle, task.region.x1, task.region.y1);
  const Oriented oriented = orient(triangle);
  if (box.empty() || oriented.area == 0) return;
  count(Part::frame_boxes);
  const Edge edge[3] = {make_edge(oriented, 0), make_edge(oriented, 1), make_edge(oriented, 2)};
  const DepthPlane plane = make_depth(oriented);
  for (int y = std::max(box.y0, task.region.y0); y < box.y1; ++y) {
    std::uint32_t* depth = task.frame.depth + y * task.frame.stride;
    std::uint32_t* payload = task.frame.payload + y * task.frame.stride;
    for (int x = std::max(box.x0, task.region.x0); x < box.x1; ++x) {
      if (edge[0].at(x, y) < 0 || edge[1].at(x, y) < 0 || edge[2].at(x, y) < 0) continue;
      const std::uint32_t z = plane.at(x, y);
      if (z >= depth[x]) continue;
      depth[x] = z;
      payload[x] = triangle.payload;
    }
  }
}

}  // namespace

FrameKernel frame_boxes(SimdTarget) {
  return [](const FrameTask& task) {
    task.bins.for_each_segment(task.cell, [&](const Bins::Segment& segment) {
      for (const std::uint32_t index : segment.indices) draw_box(task.bins.triangles()[index], task);
    });
  };
}

}  // namespace edgewise
