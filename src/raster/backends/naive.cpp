// The tutorials' rasterizer: ask every pixel of the bounding box whether it is inside. Three edge functions
// (rule 4) and the depth plane (rule 6) are evaluated anew at each pixel.
#include "raster/bands.h"

namespace edgewise {

using namespace contract;

namespace {

void draw_triangle(const ScreenTriangle& triangle, RowRange rows, FrameView frame) {
  const PixelBox box = pixel_box(triangle, frame.width, frame.height);
  const Oriented oriented = orient(triangle);
  if (box.empty() || oriented.area == 0) return;
  const Edge edge[3] = {make_edge(oriented, 0), make_edge(oriented, 1), make_edge(oriented, 2)};
  const DepthPlane plane = make_depth(oriented);

  for (int y = std::max(box.y0, rows.begin); y < std::min(box.y1, rows.end); ++y) {
    std::uint32_t* depth = frame.depth + y * frame.stride;
    std::uint32_t* payload = frame.payload + y * frame.stride;
    for (int x = box.x0; x < box.x1; ++x) {
      if (edge[0].at(x, y) < 0 || edge[1].at(x, y) < 0 || edge[2].at(x, y) < 0) continue;
      const std::uint32_t z = plane.at(x, y);
      if (z >= depth[x]) continue;
      depth[x] = z;
      payload[x] = triangle.payload;
    }
  }
}

class Naive final : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    draw_in_bands(triangles, frame, background, execution, bins_,
                  [&](const ScreenTriangle& t, RowRange rows) { draw_triangle(t, rows, frame); });
  }
  Bins bins_;
};

}  // namespace

extern const std::string_view idea_naive;
const std::string_view idea_naive = "asks every pixel of the bounding box: inside?";
std::unique_ptr<Backend> make_naive() {
  return std::make_unique<Naive>();
}

}  // namespace edgewise
