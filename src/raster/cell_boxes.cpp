#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/cell_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "edgewise/contract.h"
#include "raster/cell_box_lanes-inl.h"
#include "raster/cell_boxes.h"
#include "raster/kernel_table.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

std::uint64_t cell_boxes(const ScreenTriangle* triangles, const CellGrid& grid, bool, CellBox* out) {
  std::uint64_t filled = 0;
  for (int i = 0; i < kBoxesAtOnce; ++i) {
    const auto box = contract::pixel_box(triangles[i], grid.width, grid.height);
    if (box.empty()) continue;
    filled |= std::uint64_t{1} << i;
    const auto cell = [](int px, int log2) { return static_cast<std::uint16_t>(px >> log2); };
    out[i] = {cell(box.x0, grid.cell_w_log2), cell(box.y0, grid.cell_h_log2),
              cell(box.x1 - 1, grid.cell_w_log2), cell(box.y1 - 1, grid.cell_h_log2)};
  }
  return filled;
}

#else

std::uint64_t cell_boxes(const ScreenTriangle* triangles, const CellGrid& grid, bool prefetch, CellBox* out) {
  std::uint64_t filled = 0;
  for (int i = 0; i < kBoxesAtOnce; i += kLanes) {
    const BoxLanes box(RecordLanes(triangles + i, prefetch), grid.width, grid.height);
    store_cell_boxes(box, grid, out + i);
    filled |= std::uint64_t{mask_bits(box.filled)} << i;
  }
  return filled;
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

CellBoxKernel cell_box_kernel(SimdTarget target) {
  return EDGEWISE_KERNEL(cell_boxes, target);
}

}  // namespace edgewise
#endif
