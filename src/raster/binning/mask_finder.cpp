// The kernel that turns small triangles into coverage masks during binning.
//
// 1. Binning reads triangles in the order of memory. A tile kernel reads them tile by tile, from all over
//    memory, and waits for it. So the coverage of small triangles is found here, and stored in the tiles'
//    lists by value (mask_lists.h). A triangle that covers no sample is dropped.
// 2. Small triangles have small coordinates: samples are tested in 32-bit lanes, one triangle per lane
//    (mask_coverage-inl.h). Only triangles that cover a sample get a depth plane.
// 3. A mask is aligned to the blocks of the tile's buffer (mask_quadrants-inl.h), so drawing it needs
//    no branch.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/binning/mask_finder.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/binning/cell_box_lanes-inl.h"
#include "raster/binning/mask_coverage-inl.h"
#include "raster/binning/mask_finder.h"
#include "raster/binning/mask_quadrants-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

// Never called: mask_finder() returns null.
void find_masks(const ScreenTriangle*, const CellGrid&, bool, SortedTriangles&) {}

#else

void find_masks(const ScreenTriangle* triangles, const CellGrid& grid, bool prefetch, SortedTriangles& out) {
  Covering covering;
  out.boxed = out.masked = 0;
  for (int i = 0; i < kPacket; i += kLanes) {
    const RecordLanes t(triangles + i, prefetch);
    const BoxLanes box(t.x, t.y, grid.drawn());
    const auto small = is_small(t, box);
    const std::uint32_t small_bits = mask_bits(small), boxed_bits = mask_bits(box.filled) & ~small_bits;
    if (boxed_bits != 0) store_cell_boxes(t, box, grid, i, out.boxes);
    out.boxed |= std::uint64_t{boxed_bits} << i;
    if (small_bits != 0) out.masked |= std::uint64_t{append_covering(t, box, small, i, covering)} << i;
  }
  Planes planes;
  find_planes(triangles, covering, planes);
  cut_into_quadrants(grid, covering, planes, out);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

MaskFinder mask_finder(SimdTarget target) {
  if (target == SimdTarget::scalar) return nullptr;
  return EDGEWISE_KERNEL(find_masks, target);
}

}  // namespace edgewise
#endif
