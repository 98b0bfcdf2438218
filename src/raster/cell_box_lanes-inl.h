// From boxes of pixels to boxes of cells, in vectors.
#include <hwy/highway.h>

#include <cstdint>

#include "raster/cell_boxes.h"
#include "raster/record_lanes-inl.h"

// Included once a SIMD target.
#if defined(EDGEWISE_CELL_BOX_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_CELL_BOX_LANES_INL_H
#undef EDGEWISE_CELL_BOX_LANES_INL_H
#else
#define EDGEWISE_CELL_BOX_LANES_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// An empty box leaves garbage.
HWY_INLINE void store_cell_boxes(const BoxLanes& box, const CellGrid& grid, CellBox* out) {
  const D d;
  const V one = hn::Set(d, 1), low = hn::Set(d, 0xFFFF);
  const auto cells = [&](V x, V y) {  // 16 bits each
    return hn::Or(hn::And(hn::ShiftRightSame(x, grid.cell_w_log2), low),
                  hn::ShiftLeft<16>(hn::ShiftRightSame(y, grid.cell_h_log2)));
  };
  const V begin = cells(box.x0, box.y0), end = cells(hn::Sub(box.x1, one), hn::Sub(box.y1, one));
  hn::StoreInterleaved2(begin, end, d, reinterpret_cast<std::int32_t*>(out));
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

#endif
