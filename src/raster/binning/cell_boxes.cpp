#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/binning/cell_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/binning/cell_box_lanes-inl.h"
#include "raster/binning/cell_boxes.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

std::uint64_t cell_boxes(const ScreenTriangle* triangles, const CellGrid& grid, bool, CellBoxes& out) {
  std::uint64_t filled = 0;
  for (int i = 0; i < kPacket; ++i) {
    const auto box = box_in(grid, triangles[i]);
    if (box.empty()) continue;
    filled |= std::uint64_t{1} << i;
    out.set(static_cast<std::size_t>(i), box, grid);
  }
  return filled;
}

#else

std::uint64_t cell_boxes(const ScreenTriangle* triangles, const CellGrid& grid, bool prefetch,
                         CellBoxes& out) {
  std::uint64_t filled = 0;
  for (int i = 0; i < kPacket; i += kLanes) {
    const RecordLanes t(triangles + i, prefetch);
    const BoxLanes box(t.x, t.y, grid.drawn());
    store_cell_boxes(t, box, grid, i, out);
    filled |= std::uint64_t{mask_bits(box.filled)} << i;
  }
  return filled;
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(CellBoxKernel, cell_box_kernel, cell_boxes)
#endif
