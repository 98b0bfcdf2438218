// Draws a tile: its triangles, a batch at a time, and its coverage masks. See tile_edges.cpp.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "edgewise/contract.h"
#include "raster/binning/bins.h"
#include "raster/binning/mask_lists.h"
#include "raster/edges/tile_blocks-inl.h"
#include "raster/edges/tile_candidates-inl.h"
#include "raster/edges/tile_setup-inl.h"
#include "raster/kernels.h"
#include "raster/tile_store-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_PAINTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_PAINTER_INL_H
#undef EDGEWISE_TILE_PAINTER_INL_H
#else
#define EDGEWISE_TILE_PAINTER_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// The bit of each pixel of a mask's left blocks in CoverageMask::covered.
alignas(64) constexpr auto kMaskBits = [] {
  std::array<std::int32_t, kBlockPixels> bits{};
  for (int i = 0; i < kBlockPixels; ++i)
    bits[static_cast<std::size_t>(i)] = 1 << (i / kBlockSide * kMaskSide + i % kBlockSide);
  return bits;
}();

// Draws masks up to the first with a rank above `last`, and returns their number. Writes all four blocks of
// every mask: a branch that skips blocks without a covered pixel would be mispredicted too often.
inline std::size_t draw_masks(Tile& tile, std::span<const CoverageMask> masks, std::uint32_t last) {
  const D d;
  static_assert(kMaskSide == 2 * kBlockSide);
  std::size_t n = 0;
  for (; n != masks.size() && masks[n].rank <= last; ++n) {
    const CoverageMask& mask = masks[n];
    const V zx = hn::Set(d, wrap(mask.zx)), zy = hn::Set(d, wrap(mask.zy));
    const V z0 = hn::Set(d, wrap(mask.z)), payload = hn::Set(d, wrap(mask.payload));
    const V z_right = hn::ShiftLeft<2>(zx), z_down = hn::ShiftLeft<2>(zy);
    const V rows[2] = {hn::Set(d, wrap(mask.covered[0])), hn::Set(d, wrap(mask.covered[1]))};
    for (int p = 0; p < kBlockPixels; p += kLanes) {
      const V left_bits = hn::Load(d, kMaskBits.data() + p),
              right_bits = hn::ShiftLeft<kBlockSide>(left_bits);
      V z = hn::Add(z0, hn::Add(hn::Mul(hn::Load(d, kLaneX + p), zx), hn::Mul(hn::Load(d, kLaneY + p), zy)));
      int at = static_cast<int>(mask.block) * kBlockPixels + p;
      for (int y = 0; y < 2; ++y) {
        depth_test(tile, at, hn::TestBit(rows[y], left_bits), z, payload);
        depth_test(tile, at + kBlockPixels, hn::TestBit(rows[y], right_bits), hn::Add(z, z_right), payload);
        z = hn::Add(z, z_down);
        at += kMaxBlocks * kBlockPixels;
      }
    }
  }
  count(Part::masks, n);
  return n;
}

// Draws a tile's triangles and coverage masks in submission order.
//
// Blocks are drawn in loops over lists, so two queues hold back work: `squares_`, and `waiting_`, the
// candidate blocks of the last large triangle. At most one of them holds work: each is drawn before work is
// added to the other, and both are drawn before masks.
template <class Numbers>
class TilePainter {
 public:
  TilePainter(const TileTask& task, Tile& tile)
      : task_(task),
        tile_(tile),
        squares_(tile),
        mask_reader_(task.bins, task.cell),
        zmax_is_stale_(!task.part.clear && task.hierarchical_depth) {}

  void draw_segment(const Bins::Segment& segment) {
    std::uint32_t drawn = set_up_batch(segment.indices, [&](const std::uint32_t* indices, int k) {
      return set_up_vector(task_, indices + k, batch_, k);
    });
    for (; drawn != 0; drawn &= drawn - 1) {
      const int k = std::countr_zero(drawn);
      mask_reader_.draw_before(segment, static_cast<std::size_t>(k), draw_lists_then_masks_);
      const int width = batch_.bx1[k] - batch_.bx0[k] + 1, height = batch_.by1[k] - batch_.by0[k] + 1;
      if (std::max(width, height) <= BlockSquares<Numbers>::kSide && !batch_.is_long(k)) {
        draw_waiting();
        count(Part::tile_edges);
        squares_.add(batch_, k);
      } else {
        squares_.draw();
        add_large(k, width);
      }
    }
    draw_waiting();  // before the next batch replaces this one
  }

  void draw_rest() {
    squares_.draw();
    mask_reader_.draw_rest(draw_lists_then_masks_);
  }

 private:
  struct DrawListsThenMasks {
    TilePainter& painter;
    std::size_t operator()(std::span<const CoverageMask> masks, std::uint32_t last) const {
      painter.draw_waiting();
      painter.squares_.draw();
      return draw_masks(painter.tile_, masks, last);
    }
  };

  HWY_INLINE void draw_waiting() {
    if (waiting_ != nullptr) draw_candidates(tile_, batch_, *waiting_);
    waiting_ = nullptr;
  }

  // Fills this triangle's list, then draws the previous one's: a list's length is known long before the loop
  // over it begins.
  HWY_INLINE void add_large(int k, int width) {
    if (zmax_is_stale_) [[unlikely]]
      zmax_is_stale_ = false, has_occluders_ = load_hiz(task_, tile_);
    // Thin triangles fill no block, so they occlude none.
    has_occluders_ = has_occluders_ || (task_.hierarchical_depth && may_fill_blocks(batch_, k));
    if (has_occluders_ && tile_.hiz.occludes(batch_.nearest_in_tile[k])) [[unlikely]]  // in most scenes
      return count(Part::hiz);
    count(Part::tile_edges);
    Candidates& next = candidates_[waiting_ == candidates_ ? 1 : 0];
    has_occluders_ ? find<true>(k, width, next) : find<false>(k, width, next);
    draw_waiting();
    waiting_ = &next;
  }

  // Narrow boxes need half the vectors of a row of blocks. If they used all, tiled would take 1.1 times as
  // long for medium with AVX2 (one thread, Zen 4).
  template <bool kHiZ>
  HWY_INLINE void find(int k, int width, Candidates& out) {
    constexpr int kHalf = std::max(kVectors / 2, 1);
    width <= kMaxBlocks / 2 ? find_candidates<Numbers, kHiZ, kHalf>(tile_, batch_, k, out)
                            : find_candidates<Numbers, kHiZ, kVectors>(tile_, batch_, k, out);
  }

  const TileTask& task_;
  Tile& tile_;
  Batch<Numbers> batch_;
  BlockSquares<Numbers> squares_;
  Candidates candidates_[2];  // one is filled while the other waits
  const Candidates* waiting_ = nullptr;
  Bins::MaskReader mask_reader_;
  const DrawListsThenMasks draw_lists_then_masks_{*this};
  bool has_occluders_ = false;  // some block may have a zmax nearer than kDepthClear
  bool zmax_is_stale_;          // no zmax is that of the loaded depths yet
};

template <class Numbers>
void draw_tile_in(const TileTask& task) {
  Tile tile;
  // Without a clear, pixels that are not read from the frame have depth 0, which nothing is nearer than.
  for (int y = 0; y < task.size(); y += kBlockSide)
    for (int i = 0; i < task.size() * kBlockSide; i += kLanes)
      hn::Store(hn::Set(D{}, wrap(task.part.clear ? kDepthClear : 0)), D{}, tile.depth() + y * kMaxTile + i);
  read_tile(task, tile.depth(), tile.payload(),
            [](const FramePlane& from, std::int32_t* buffer) { read_blocks(from, buffer); });
  tile.hiz.clear(task.width(), task.height());

  TilePainter<Numbers> painter(task, tile);
  task.bins.for_each_segment(task.cell, [&](const Bins::Segment& segment) { painter.draw_segment(segment); });
  painter.draw_rest();
  write_tile(task, tile.depth(), tile.payload(),
             [](const FramePlane& to, const auto& pixels) { write_blocks(to, pixels); });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
