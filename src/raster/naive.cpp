// The tutorials' rasterizer: tests for every pixel of the bounding box whether it is inside. Three edge
// functions (rule 4) and the depth plane (rule 6) are evaluated at each pixel, or, with Ablation::stepped,
// stepped along a row. On one thread the whole image is one band.
#include "raster/ablation.h"
#include "raster/bands.h"

namespace edgewise {

using namespace contract;

namespace {

template <bool kStepped>
void draw_triangle(const ScreenTriangle& triangle, RowRange rows, FrameView frame) {
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

class Naive final : public Backend {
 public:
  explicit Naive(const Ablation& ablation) : stepped_(ablation.stepped) {}

 private:
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    const auto draw = stepped_ ? draw_triangle<true> : draw_triangle<false>;
    if (execution.threads == 1) {
      const RowRange all{0, frame.height};
      clear_rows(frame, all, background);
      for (const ScreenTriangle& triangle : triangles) draw(triangle, all, frame);
      return;
    }
    StoredTriangles stored(triangles);
    draw_in_bands(stored, frame, execution, bins_, [&](int band, RowRange rows) {
      clear_rows(frame, rows, background);
      bins_.for_each_segment(band, [&](const Bins::Segment& segment) {
        for (const std::uint32_t index : segment.indices) draw(triangles[index], rows, frame);
      });
    });
  }
  const bool stepped_;
  Bins bins_;
};

}  // namespace

extern const std::string_view summary_naive;
const std::string_view summary_naive = "tests every pixel of the bounding box";
std::unique_ptr<Backend> make_naive(const Ablation& ablation) {
  return std::make_unique<Naive>(ablation);
}
std::unique_ptr<Backend> make_naive() {
  return make_naive(Ablation{});
}

}  // namespace edgewise
