#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/cell_boxes.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster/cell_boxes.h"
#include "raster/contract.h"
#include "raster/kernel_table.h"
#include "raster/triangle_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

std::uint64_t cell_boxes(std::span<const ScreenTriangle> triangles, const CellGrid& grid, bool,
                         CellBox* out) {
  std::uint64_t filled = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
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

std::uint64_t cell_boxes(std::span<const ScreenTriangle> triangles, const CellGrid& grid, bool prefetch,
                         CellBox* out) {
  const D64 d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(d));
  const V64 last = hn::Set(d, static_cast<std::int64_t>(triangles.size()) - 1);
  const int count = static_cast<int>(triangles.size());
  constexpr std::size_t kAhead = 2560;  // bytes
  std::uint64_t all_filled = 0;
  for (int k = 0; k < count; k += kLanes) {
    // Gathers don't teach the hardware's prefetchers what a stream this is.
    const char* ahead = reinterpret_cast<const char*>(triangles.data() + k) + kAhead;
    if (prefetch)
      for (std::size_t i = 0; i < kLanes * sizeof(ScreenTriangle); i += 64) hwy::Prefetch(ahead + i);
    const V64 index = hn::Min(hn::Add(hn::Iota(d, 0), hn::Set(d, k)), last);
    const TriangleLanes t = load(triangles.data(), record_offset(index));
    const auto [x0, x1] = sample_range(t.x, 0, grid.width);
    const auto [y0, y1] = sample_range(t.y, 0, grid.height);
    const auto empty = hn::Not(hn::And(hn::Lt(x0, x1), hn::Lt(y0, y1)));
    const V32 one = set32(1);
    const auto cell = [](V32 px, int log2) { return hn::ShiftRightSame(px, log2); };
    // 16 bits each; an empty box may leave garbage.
    const V32 begin = hn::Or(cell(x0, grid.cell_w_log2), hn::ShiftLeft<16>(cell(y0, grid.cell_h_log2)));
    const V32 end = hn::Or(cell(hn::Sub(x1, one), grid.cell_w_log2),
                           hn::ShiftLeft<16>(cell(hn::Sub(y1, one), grid.cell_h_log2)));
    const V32 box = hn::OddEven(lower(hn::ShiftLeft<32>(as64(end))), begin);
    hn::StoreU(as64(box), d, reinterpret_cast<std::int64_t*>(out + k));
    const V64 dead = hn::ShiftLeft<32>(as64(hn::VecFromMask(D32{}, empty)));
    all_filled |= std::uint64_t{mask_bits(hn::Not(hn::Lt(dead, hn::Zero(d))))} << k;
  }
  return all_filled & (~std::uint64_t{0} >> (kBoxesAtOnce - count));
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
