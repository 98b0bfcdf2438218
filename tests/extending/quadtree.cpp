// A backend: quarters a triangle's bounding box until a part lies outside an edge or is one pixel.
#include <algorithm>

#include "edgewise/backend.h"
#include "edgewise/contract.h"

namespace edgewise {

using namespace contract;

namespace {

struct Prepared {
  Edge edges[3];     // rule 4
  DepthPlane depth;  // rule 6
  std::uint32_t payload;
};

void draw_part(const Prepared& t, PixelBox part, FrameView frame) {
  if (part.empty()) return;
  for (const Edge& edge : t.edges)  // evaluated at the part's corner that lies furthest inside
    if (edge.at(edge.a > 0 ? part.x1 - 1 : part.x0, edge.b > 0 ? part.y1 - 1 : part.y0) < 0) return;
  if (part.x1 - part.x0 == 1 && part.y1 - part.y0 == 1) {
    const std::ptrdiff_t pixel = part.y0 * frame.stride + part.x0;
    const std::uint32_t z = t.depth.at(part.x0, part.y0);
    if (z < frame.depth[pixel]) frame.depth[pixel] = z, frame.payload[pixel] = t.payload;  // rule 7
    return;
  }
  const int x = (part.x0 + part.x1) / 2, y = (part.y0 + part.y1) / 2;
  draw_part(t, {part.x0, part.y0, x, y}, frame);
  draw_part(t, {x, part.y0, part.x1, y}, frame);
  draw_part(t, {part.x0, y, x, part.y1}, frame);
  draw_part(t, {x, y, part.x1, part.y1}, frame);
}

class Quadtree final : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution&) override {
    const FrameView& frame = part.frame;
    for (int y = part.y0; part.clear && y < frame.height; ++y) {
      std::fill(frame.depth + y * frame.stride + part.x0, frame.depth + y * frame.stride + frame.width,
                kDepthClear);
      std::fill(frame.payload + y * frame.stride + part.x0, frame.payload + y * frame.stride + frame.width,
                part.background);
    }
    for (const ScreenTriangle& triangle : triangles) {
      const Oriented t = orient(triangle);
      if (t.area == 0) continue;
      PixelBox box = pixel_box(triangle, frame.width, frame.height);
      box.x0 = std::max(box.x0, part.x0), box.y0 = std::max(box.y0, part.y0);
      draw_part({{make_edge(t, 0), make_edge(t, 1), make_edge(t, 2)}, make_depth(t), triangle.payload}, box,
                frame);
    }
  }
};

}  // namespace

extern const std::string_view summary_quadtree;
const std::string_view summary_quadtree = "quarters the bounding box until a part is outside or one pixel";
std::unique_ptr<Backend> make_quadtree();
std::unique_ptr<Backend> make_quadtree() {
  return std::make_unique<Quadtree>();
}

}  // namespace edgewise
