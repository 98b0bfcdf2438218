// The backend `scanline`, the reference: walks a triangle's edges row by row and fills the spans between them
// in the frame itself, band by band.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/scanline/scanline.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/kernel_table.h"
#include "raster/bands.h"
#include "raster/scanline/scanline_band-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

void draw_band(const BandTask& task) {
  draw_band_by<NarrowBatch>(
      task, [&](const ScreenTriangle& triangle, const PixelBox& box) { draw_spans(task, triangle, box); });
}

void draw_in_spans(const BandTask& task) {
  task.bins.for_each_segment(task.cell, [&](const Bins::Segment& segment) {
    for (const std::uint32_t index : segment.indices)
      draw_in_area(task, task.bins.triangles()[index],
                   [&](const ScreenTriangle& t, const PixelBox& box) { draw_spans(task, t, box); });
  });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(BandKernel, scanline_kernel, draw_band)
EDGEWISE_DEFINE_KERNEL(BandKernel, span_kernel, draw_in_spans)

namespace edgewise {

extern const std::string_view summary_scanline;
const std::string_view summary_scanline =
    "walks the edges row by row and fills the spans between them; the reference";
std::unique_ptr<Backend> make_scanline() {
  return std::make_unique<BandBackend>(scanline_kernel);
}

}  // namespace edgewise
#endif
