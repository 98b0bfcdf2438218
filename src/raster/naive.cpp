// The tutorials' rasterizer: tests for every pixel of the bounding box whether it is inside. On one thread
// the whole image is one band.
#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"
#include "raster/bands.h"

namespace edgewise {

namespace {

using namespace contract;

// Draws what lies in `rows`. Three edge functions (rule 4) and the depth plane (rule 6) are evaluated at each
// pixel.
void draw_by_box_test(const ScreenTriangle& triangle, RowRange rows, const FramePart& part) {
  const FrameView& frame = part.frame;
  const PixelBox box = pixel_box(triangle, frame.width, frame.height);
  const Oriented oriented = orient(triangle);
  if (box.empty() || oriented.area == 0) return;
  const Edge edge[3] = {make_edge(oriented, 0), make_edge(oriented, 1), make_edge(oriented, 2)};
  const DepthPlane plane = make_depth(oriented);
  for (int y = std::max(box.y0, rows.begin); y < std::min(box.y1, rows.end); ++y) {
    std::uint32_t* depth = frame.depth + y * frame.stride;
    std::uint32_t* payload = frame.payload + y * frame.stride;
    for (int x = std::max(box.x0, part.x0); x < box.x1; ++x) {
      if (edge[0].at(x, y) < 0 || edge[1].at(x, y) < 0 || edge[2].at(x, y) < 0) continue;
      const std::uint32_t z = plane.at(x, y);
      if (z >= depth[x]) continue;
      depth[x] = z;
      payload[x] = triangle.payload;
    }
  }
}

class Naive final : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) override {
    if (execution.threads == 1) {
      const RowRange all{part.y0, part.frame.height};
      clear_rows(part, all);
      for (const ScreenTriangle& triangle : triangles) draw_by_box_test(triangle, all, part);
      return;
    }
    StoredTriangles stored(triangles);
    draw_in_bands(stored, part, execution, bins_, [&](int band, RowRange rows) {
      clear_rows(part, rows);
      bins_.for_each_segment(band, [&](const Bins::Segment& segment) {
        for (const std::uint32_t index : segment.indices) draw_by_box_test(triangles[index], rows, part);
      });
    });
  }
  Bins bins_;
};

}  // namespace

extern const std::string_view summary_naive;
const std::string_view summary_naive = "tests every pixel of the bounding box";
std::unique_ptr<Backend> make_naive() {
  return std::make_unique<Naive>();
}

}  // namespace edgewise
