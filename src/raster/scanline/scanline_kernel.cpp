#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/scanline/scanline_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/kernel_table.h"
#include "raster/bands.h"
#include "raster/scanline/scanline_band-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

void draw_band(const BandTask& task) {
  const auto large = [&](const ScreenTriangle& triangle, const PixelBox& box) {
    draw_spans(task, triangle, box);
  };
  task.vector_test ? draw_band_by<true>(task, large) : draw_band_by<false>(task, large);
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

BandKernel scanline_kernel(SimdTarget target) {
  return EDGEWISE_KERNEL(draw_band, target);
}

}  // namespace edgewise
#endif
