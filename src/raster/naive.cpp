// The tutorials' rasterizer: tests for every pixel of the bounding box whether it is inside (box_test.h). On
// one thread the whole image is one band.
#include "raster/ablation.h"
#include "raster/bands.h"
#include "raster/box_test.h"

namespace edgewise {

namespace {

class Naive final : public Backend {
 public:
  explicit Naive(const Ablation& ablation) : stepped_(ablation.stepped) {}

 private:
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    const auto draw = stepped_ ? draw_by_box_test<true> : draw_by_box_test<false>;
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
