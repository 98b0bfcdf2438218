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
struct Planes {
  alignas(64) std::int32_t zx[Covering::kCapacity], zy[Covering::kCapacity];
  alignas(64) std::int64_t gx[Covering::kCapacity], gy[Covering::kCapacity];
  alignas(64) std::int64_t start[Covering::kCapacity];  // 2^24 (depth at the first pixel of the cell + 1/2)

  // The base of the depth cell to the right, below, or both, less that of the triangle's first cell.
  std::uint32_t base_step(int k, std::uint32_t right, std::uint32_t below) const {
    const auto bits = [&](const std::int64_t(&list)[Covering::kCapacity]) {
      return static_cast<std::uint64_t>(list[k]);
    };
    constexpr std::uint64_t kCell = std::uint64_t{kDepthCell} << kSubBits;
    const std::uint64_t here = bits(start),
                        there = here + bits(gx) * (right * kCell) + bits(gy) * (below * kCell);
    return static_cast<std::uint32_t>(there >> 24) - static_cast<std::uint32_t>(here >> 24);
  }
};

inline void find_planes(const ScreenTriangle* triangles, const Covering& from, Planes& out) {
  const D64 d;
  constexpr int kLanes64 = static_cast<int>(hn::MaxLanes(d));
  for (int k = 0; k < from.count; k += kLanes64) {
    const auto read = [&](const std::int32_t* list) {
      return hn::PromoteTo(D64{}, hn::LoadU(hn::Rebind<std::int32_t, D64>{}, list + k));
    };
    const DepthLanes depth =
        depth_lanes({lower(read(from.dx1)), lower(read(from.dx2)), lower(read(from.dy1)),
                     lower(read(from.dy2)), lower(read(from.dz1)), lower(read(from.dz2)), read(from.area),
                     lower(read(from.from_x)), lower(read(from.from_y)), lower(read(from.anchor_z))});
    store(depth.x, out.zx + k), store(depth.y, out.zy + k);
    hn::StoreU(depth.gx, d, out.gx + k), hn::StoreU(depth.gy, d, out.gy + k);
    hn::StoreU(depth.start, d, out.start + k);
    const std::uint32_t live = (1u << std::min(from.count - k, kLanes64)) - 1;
    for (std::uint32_t left = live & ~mask_bits(depth.exact); left != 0; left &= left - 1) {
      const int at = k + std::countr_zero(left);
      const DepthPlane plane = make_depth(orient(triangles[from.index[at]]));
      const auto pixels = [](std::int32_t px) {
        return static_cast<std::uint64_t>(px & -kDepthCell) << kSubBits;
      };
      out.gx[at] = static_cast<std::int64_t>(plane.gx), out.gy[at] = static_cast<std::int64_t>(plane.gy);
      out.start[at] = static_cast<std::int64_t>(plane.origin + plane.gx * pixels(from.x0[at]) +
                                                plane.gy * pixels(from.y0[at]));
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

inline void cut_into_quadrants(const CellGrid& grid, const Covering& from, const Planes& planes,
                               SortedTriangles& out) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  using U = hn::Vec<decltype(du)>;
  using Pairs64 = hn::RebindToUnsigned<Pairs>;
  const auto bits = [&](V v) { return hn::BitCast(du, v); };
  const auto bytes = [&](U v) { return bits(hn::Mul(hn::BitCast(d, v), hn::Set(d, 0x01010101))); };
  const int columns = grid.columns();
  for (int k = 0; k < from.count; k += kLanes) {
    const auto read = [&](const std::int32_t* list) { return hn::LoadU(d, list + k); };
    const V x0 = read(from.x0), y0 = read(from.y0);
    const Cut across(x0, grid.cell_w_log2), down(y0, grid.cell_h_log2);

    // Four rows of 8 bits per word: shift the left quadrants' pixels to their columns, the right ones' to
    // column 0.
    const U shift = bits(hn::And(x0, hn::Set(d, 3))), left_count = bits(across.first_count);
    const U all = hn::Set(du, 0xFF), eight = hn::Set(du, 8);
    const U left_bits = bytes(all >> (eight - left_count)), right_bits = bytes(all >> left_count);
    // Then shift rows: y0 % 4 of them move to the next word.
    const U row_shift = bits(hn::ShiftLeft<3>(hn::And(y0, hn::Set(d, 3))));
    const U back = hn::Set(du, 24) - row_shift;
    const auto two_words = hn::Eq(hn::Sub(down.second_block, down.block), hn::Set(d, 2));
    const U upper = bits(read(from.covered[0])), lower_rows = bits(read(from.covered[1]));
    U rows[SortedTriangles::kQuadrants][2];
    for (int right = 0; right < 2; ++right) {
      const auto moved = [&](U v) {
        return right ? (v >> left_count) & right_bits : (v & left_bits) << shift;
      };
      const U u = moved(upper), l = moved(lower_rows);
      const U word[3] = {u << row_shift, (l << row_shift) | (hn::ShiftRight<8>(u) >> back),
                         hn::ShiftRight<8>(l) >> back};
      const auto two = hn::RebindMask(du, two_words);
      const U zero = hn::Zero(du);
      rows[right][0] = word[0];
      rows[right][1] = hn::IfThenElseZero(two, word[1]);
      rows[2 + right][0] = hn::IfThenElse(two, word[2], word[1]);
      rows[2 + right][1] = hn::IfThenElse(two, zero, word[2]);
    }

    const V payload = read(from.payload), zx = read(planes.zx), zy = read(planes.zy);
    const auto upper_bits = [&](int at) {  // start has 24 fraction bits
      return hn::BitCast(d,
                         hn::ShiftRight<24>(hn::BitCast(Pairs64{}, hn::LoadU(Pairs{}, planes.start + at))));
    };
    const V base = hn::ConcatEven(d, upper_bits(k + kPairs), upper_bits(k));
    V present = hn::Zero(d);
    const auto live = hn::FirstN(d, static_cast<std::size_t>(from.count - k));
    for (int w = 0; w < SortedTriangles::kQuadrants; ++w) {
      const auto filled = hn::And(live, hn::RebindMask(d, hn::Ne(rows[w][0] | rows[w][1], hn::Zero(du))));
      const std::uint32_t these = mask_bits(filled);
      if (these == 0) continue;
      present = hn::Or(present, hn::IfThenElseZero(filled, hn::Set(d, 1 << w)));
      const V bx = w & 1 ? across.second_block : across.block, by = w & 2 ? down.second_block : down.block;
      const int across_log2 = grid.cell_w_log2 - 2, down_log2 = grid.cell_h_log2 - 2;
      const V cell = hn::Add(hn::Mul(hn::ShiftRightSame(by, down_log2), hn::Set(d, columns)),
                             hn::ShiftRightSame(bx, across_log2));
      const V in_x = hn::And(bx, hn::Set(d, (1 << across_log2) - 1));
      const V in_y = hn::And(by, hn::Set(d, (1 << down_log2) - 1));
      const V block = hn::Add(hn::ShiftLeft<4>(in_y), in_x);
      const auto in_depth_cell = [&](V b) {
        return hn::ShiftLeft<2>(hn::And(b, hn::Set(d, kDepthCell / 4 - 1)));
      };
      const V z = hn::Add(base, hn::Add(hn::Mul(zx, in_depth_cell(bx)), hn::Mul(zy, in_depth_cell(by))));
      hn::StoreInterleaved4(hn::BitCast(d, rows[w][0]), hn::BitCast(d, rows[w][1]), block, payload, d,
                            reinterpret_cast<std::int32_t*>(out.first[w] + k));
      hn::StoreInterleaved4(z, zx, zy, cell, d, reinterpret_cast<std::int32_t*>(out.second[w] + k));
      if (w == 0) continue;
      // A quadrant in another depth cell has another base.
      const auto leaves = [&](V from_block, V to_block) {
        const V same_cell = hn::ShiftRight<4>(hn::Xor(from_block, to_block));
        return mask_bits(hn::And(filled, hn::Ne(same_cell, hn::Zero(d))));
      };
      const std::uint32_t to_right = leaves(across.block, bx), to_below = leaves(down.block, by);
      for (std::uint32_t left = to_right | to_below; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        out.second[w][k + lane].field[0] +=
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
