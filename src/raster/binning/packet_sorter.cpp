// The kernel that sorts triangles for binning: they get cell boxes, but small ones become coverage masks.
//
// 1. Binning reads triangles in the order of memory. A tile kernel reads them tile by tile, from all over
//    memory, and waits for it. So the coverage of small triangles is found here, and stored in the tiles'
//    lists by value (mask_lists.h). A triangle that covers no sample is dropped.
// 2. Small triangles have small coordinates: samples are tested in 32-bit lanes, one triangle per lane
//    (mask_coverage-inl.h). Only triangles that cover a sample get a depth plane.
// 3. A mask is aligned to the blocks of the tile's buffer (mask_quadrants-inl.h), so drawing it needs
//    no branch.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/binning/packet_sorter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/binning/mask_coverage-inl.h"
#include "raster/binning/mask_quadrants-inl.h"
#include "raster/binning/packet_sorter.h"
#include "raster/simd/rule_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void sort_packet(const ScreenTriangle* triangles, const CellGrid& grid, bool, SortedPacket& out) {
  out.boxed = out.masked = 0;
  for (int i = 0; i < kPacket; ++i) {
    for (int k = 0; k < 3; ++k) out.fine |= !is_on<Coarse>(triangles[i].x_q15[k] | triangles[i].y_q15[k]);
    contract::PixelBox box = contract::pixel_box(triangles[i], grid.width, grid.height);
    box.x0 = std::max(box.x0, grid.x0), box.y0 = std::max(box.y0, grid.y0);
    if (box.empty()) continue;
    const auto cell = [](int at, int log2) { return static_cast<std::uint16_t>(at >> log2); };
    out.boxed |= std::uint64_t{1} << i;
    out.box[i] = {cell(box.x0, grid.cell_w_log2), cell(box.y0, grid.cell_h_log2),
                  cell(box.x1 - 1, grid.cell_w_log2), cell(box.y1 - 1, grid.cell_h_log2)};
  }
}

#else

// Lanes with an empty box store unspecified values.
HWY_INLINE void store_cell_boxes(const BoxLanes& box, const CellGrid& grid, CellBox* out) {
  const V one = hn::Set(D{}, 1);
  const auto cell = [&](V x, V y) {  // 16 bits each
    return hn::Or(hn::ShiftRightSame(x, grid.cell_w_log2),
                  hn::ShiftLeft<16>(hn::ShiftRightSame(y, grid.cell_h_log2)));
  };
  hn::StoreInterleaved2(cell(box.x0, box.y0), cell(hn::Sub(box.x1, one), hn::Sub(box.y1, one)), D{},
                        reinterpret_cast<std::int32_t*>(out));
}

// Returns false, with unspecified contents, if a position is not on the grid.
template <class G>
bool sort_on_grid(const ScreenTriangle* triangles, const CellGrid& grid, bool with_masks, SortedPacket& out) {
  Covering covering;
  out.boxed = out.masked = 0;
  for (int i = 0; i < kPacket; i += kLanes) {
    const TriangleLanes stored = load_triangles([&](int lane) { return triangles + i + lane; });
    if (!are_on<G>(stored)) return false;
    const GridTriangles<G> t(stored);
    const BoxLanes box(t, grid.drawn());
    std::uint32_t boxed = mask_bits(box.filled);
    if (with_masks) {
      const auto small = is_small(t, box);
      const std::uint32_t small_bits = mask_bits(small);
      boxed &= ~small_bits;
      if (small_bits != 0) out.masked |= std::uint64_t{append_covering(t, box, small, i, covering)} << i;
    }
    if (boxed != 0) store_cell_boxes(box, grid, out.box + i);
    out.boxed |= std::uint64_t{boxed} << i;
  }
  if (covering.count == 0) return true;
  Planes<G> planes;
  find_planes(triangles, covering, planes);
  cut_into_quadrants(grid, covering, planes, out);
  return true;
}

void sort_packet(const ScreenTriangle* triangles, const CellGrid& grid, bool with_masks, SortedPacket& out) {
  out.fine = out.fine || !sort_on_grid<Coarse>(triangles, grid, with_masks, out);  // a slice stays fine
  if (out.fine) sort_on_grid<Fine>(triangles, grid, with_masks, out);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(PacketSorter, packet_sorter, sort_packet)
#endif
