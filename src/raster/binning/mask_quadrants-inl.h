// Cuts the coverage of small triangles into masks. A mask is 2 x 2 blocks of the tile's buffer, so a box of
// up to 8 x 8 pixels at any position needs up to 2 x 2 masks, the quadrants. Where a tile ends, the right or
// lower quadrants begin at the next tile.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "raster/binning/mask_coverage-inl.h"
#include "raster/simd/depth_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_MASK_QUADRANTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_MASK_QUADRANTS_INL_H
#undef EDGEWISE_MASK_QUADRANTS_INL_H
#else
#define EDGEWISE_MASK_QUADRANTS_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The depth planes of small triangles, at the first pixel of the depth cell in which their boxes begin.
template <class G>
struct Planes {
  alignas(64) std::int32_t zx[Covering::kCapacity], zy[Covering::kCapacity];
  alignas(64) std::int64_t gx[Covering::kCapacity], gy[Covering::kCapacity];
  alignas(64) std::int64_t start[Covering::kCapacity];  // as DepthLanes::start

  // The base of the depth cell to the right, below, or both, less that of the triangle's first cell.
  std::uint32_t base_step(int k, std::uint32_t right, std::uint32_t below) const {
    const auto bits = [&](const std::int64_t(&list)[Covering::kCapacity]) {
      return static_cast<std::uint64_t>(list[k]);
    };
    constexpr std::uint64_t kCell = std::uint64_t{kDepthCell} << G::kSubBits;
    const std::uint64_t here = bits(start),
                        there = here + bits(gx) * (right * kCell) + bits(gy) * (below * kCell);
    return static_cast<std::uint32_t>(there >> G::kPlaneBits) -
           static_cast<std::uint32_t>(here >> G::kPlaneBits);
  }
};

template <class G>
void find_planes(const ScreenTriangle* triangles, const Covering& from, Planes<G>& out) {
  const D64 d;
  for (int k = 0; k < from.count; k += kLanes64) {
    const auto read = [&](const std::int32_t* list) {
      return lower(hn::PromoteTo(D64{}, hn::LoadU(hn::Rebind<std::int32_t, D64>{}, list + k)));
    };
    const V32 dx1 = read(from.dx1), dx2 = read(from.dx2), dy1 = read(from.dy1), dy2 = read(from.dy2);
    const DepthLanes<G> depth =
        depth_lanes<G>({dx1, dx2, dy1, dy2, read(from.dz1), read(from.dz2), area_of(dx1, dx2, dy1, dy2).value,
                        read(from.from_x), read(from.from_y), read(from.anchor_z)});
    store(depth.x, out.zx + k), store(depth.y, out.zy + k);
    hn::StoreU(depth.gx, d, out.gx + k), hn::StoreU(depth.gy, d, out.gy + k);
    hn::StoreU(depth.start, d, out.start + k);
    const std::uint32_t live = (1u << std::min(from.count - k, kLanes64)) - 1;
    for (std::uint32_t left = live & ~mask_bits(depth.exact); left != 0; left &= left - 1) {
      const int at = k + std::countr_zero(left);
      const DepthPlane plane = make_depth(orient(triangles[from.index[at]]));
      const auto pixels = [](std::int32_t px) {
        return static_cast<std::uint64_t>(px & -kDepthCell) << G::kSubBits;
      };
      out.gx[at] = static_cast<std::int64_t>(plane.gx), out.gy[at] = static_cast<std::int64_t>(plane.gy);
      out.start[at] = static_cast<std::int64_t>(
          (plane.origin >> G::kSpareBits) + plane.gx * pixels(from.x0[at]) + plane.gy * pixels(from.y0[at]));
      out.zx[at] = static_cast<std::int32_t>(plane.zx), out.zy[at] = static_cast<std::int32_t>(plane.zy);
    }
  }
}

// Along one axis: the first blocks of a box's two quadrants, and the number of pixels before the second.
struct Cut {
  V block;        // the box's first block
  V first_count;  // px
  V second_block;
  HWY_INLINE Cut(V px, int tile_size_log2) {
    const D d;
    block = hn::ShiftRight<2>(px);
    const V last_in_tile = hn::Set(d, (1 << tile_size_log2) / 4 - 1);
    const auto at_end = hn::Eq(hn::And(block, last_in_tile), last_in_tile);
    second_block = hn::Add(block, hn::IfThenElse(at_end, hn::Set(d, 1), hn::Set(d, 2)));
    first_count = hn::Sub(hn::ShiftLeft<2>(second_block), px);
  }
};

using DU = hn::RebindToUnsigned<D>;
using U = hn::Vec<DU>;
HWY_INLINE U unsigned_bits(V v) {
  return hn::BitCast(DU{}, v);
}

// The rows of pixels of four masks, four rows of 8 bits per word. `covered`: of boxes that begin at (x0, y0).
HWY_INLINE void cut_rows(V x0, V y0, const Cut& across, const Cut& down, const U (&covered)[2],
                         U (&rows)[SortedPacket::kQuadrants][2]) {
  const DU du;
  const auto in_each_row = [](U v) {
    return unsigned_bits(hn::Mul(hn::BitCast(D{}, v), hn::Set(D{}, 0x01010101)));
  };
  // Shift the left quadrants' pixels to their columns, the right ones' to column 0.
  const U shift = unsigned_bits(hn::And(x0, hn::Set(D{}, 3))), left_count = unsigned_bits(across.first_count);
  const U all = hn::Set(du, 0xFF), zero = hn::Zero(du);
  const U left_bits = in_each_row(all >> (hn::Set(du, 8) - left_count)),
          right_bits = in_each_row(all >> left_count);
  // Then shift rows: y0 % 4 of them move to the next word.
  const U row_shift = unsigned_bits(hn::ShiftLeft<3>(hn::And(y0, hn::Set(D{}, 3))));
  const U back = hn::Set(du, 24) - row_shift;
  const auto two_words = hn::RebindMask(du, hn::Eq(hn::Sub(down.second_block, down.block), hn::Set(D{}, 2)));
  for (int right = 0; right < 2; ++right) {
    const auto moved = [&](U v) { return right ? (v >> left_count) & right_bits : (v & left_bits) << shift; };
    const U upper = moved(covered[0]), lower = moved(covered[1]);
    const U word[3] = {upper << row_shift, (lower << row_shift) | (hn::ShiftRight<8>(upper) >> back),
                       hn::ShiftRight<8>(lower) >> back};
    rows[right][0] = word[0];
    rows[right][1] = hn::IfThenElseZero(two_words, word[1]);
    rows[2 + right][0] = hn::IfThenElse(two_words, word[2], word[1]);
    rows[2 + right][1] = hn::IfThenElse(two_words, zero, word[2]);
  }
}

// The tiles of blocks, and their places in the tiles, in bits as CoverageMask::block.
HWY_INLINE void place(const CellGrid& grid, V bx, V by, V& tile, V& in_tile) {
  const D d;
  const int across_log2 = grid.cell_w_log2 - 2, down_log2 = grid.cell_h_log2 - 2;
  tile = hn::Add(hn::Mul(hn::ShiftRightSame(by, down_log2), hn::Set(d, grid.columns())),
                 hn::ShiftRightSame(bx, across_log2));
  const V in_x = hn::And(bx, hn::Set(d, (1 << across_log2) - 1));
  const V in_y = hn::And(by, hn::Set(d, (1 << down_log2) - 1));
  in_tile = hn::Add(hn::ShiftLeft<4>(in_y), in_x);
}

template <class G>
void cut_into_quadrants(const CellGrid& grid, const Covering& from, const Planes<G>& planes,
                        SortedPacket& out) {
  const D d;
  for (int k = 0; k < from.count; k += kLanes) {
    const auto read = [&](const std::int32_t* list) { return hn::LoadU(d, list + k); };
    const V x0 = read(from.x0), y0 = read(from.y0);
    const Cut across(x0, grid.cell_w_log2), down(y0, grid.cell_h_log2);
    U rows[SortedPacket::kQuadrants][2];
    cut_rows(x0, y0, across, down,
             {unsigned_bits(read(from.covered[0])), unsigned_bits(read(from.covered[1]))}, rows);
    const V payload = read(from.payload), zx = read(planes.zx), zy = read(planes.zy);
    const auto base_at = [&](int at) {  // start has kPlaneBits fraction bits
      return lower(shift_right<G::kPlaneBits>(hn::LoadU(D64{}, planes.start + at)));
    };
    const V base = hn::ConcatEven(d, base_at(k + kLanes64), base_at(k));
    V present = hn::Zero(d);
    const auto live = hn::FirstN(d, static_cast<std::size_t>(from.count - k));
    for (int q = 0; q < SortedPacket::kQuadrants; ++q) {
      const auto filled = hn::And(live, hn::RebindMask(d, hn::Ne(rows[q][0] | rows[q][1], hn::Zero(DU{}))));
      if (hn::AllFalse(d, filled)) continue;
      present = hn::Or(present, hn::IfThenElseZero(filled, hn::Set(d, 1 << q)));
      const V bx = q & 1 ? across.second_block : across.block, by = q & 2 ? down.second_block : down.block;
      V tile, in_tile;
      place(grid, bx, by, tile, in_tile);
      const auto in_depth_cell = [&](V block) {
        return hn::ShiftLeft<2>(hn::And(block, hn::Set(d, kDepthCell / 4 - 1)));
      };
      const V z = hn::Add(base, hn::Add(hn::Mul(zx, in_depth_cell(bx)), hn::Mul(zy, in_depth_cell(by))));
      hn::StoreInterleaved4(hn::BitCast(d, rows[q][0]), hn::BitCast(d, rows[q][1]), in_tile, payload, d,
                            reinterpret_cast<std::int32_t*>(out.first[q] + k));
      hn::StoreInterleaved4(z, zx, zy, tile, d, reinterpret_cast<std::int32_t*>(out.second[q] + k));
      // A quadrant in another depth cell has another base.
      const auto leaves = [&](V from_block, V to_block) {
        const V same_cell = hn::ShiftRight<4>(hn::Xor(from_block, to_block));
        return mask_bits(hn::And(filled, hn::Ne(same_cell, hn::Zero(d))));
      };
      const std::uint32_t to_right = leaves(across.block, bx), to_below = leaves(down.block, by);
      for (std::uint32_t left = to_right | to_below; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        out.second[q][k + lane].field[0] +=
            planes.base_step(k + lane, to_right >> lane & 1, to_below >> lane & 1);
      }
    }
    const hn::Rebind<std::uint8_t, D> d8;
    hn::StoreU(hn::DemoteTo(d8, present), d8, out.quadrants + k);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

#endif
