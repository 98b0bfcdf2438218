// Draws a tile: its triangles, a batch at a time, and its coverage masks. See tile_edges.cpp.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "edgewise/contract.h"
#include "raster/binning/bins.h"
#include "raster/edges/tile_blocks-inl.h"
#include "raster/edges/tile_candidates-inl.h"
#include "raster/edges/tile_setup-inl.h"
#include "raster/fill_counts.h"
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

// Sets zmax to the farthest depth that a block holds. Returns whether any block's zmax is below kDepthClear.
inline bool load_hiz(const TileTask& task, Tile& tile) {
  const D d;
  const int columns = (task.width() + kBlockSide - 1) / kBlockSide,
            rows = (task.height() + kBlockSide - 1) / kBlockSide;
  V least = hn::Set(d, wrap(kDepthClear));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::int32_t* const block = tile.depth + (row * kMaxBlocks + column) * kBlockPixels;
      V most = hn::Load(d, block);
      for (int p = 1; p < kVectors; ++p) most = hn::Max(most, hn::Load(d, block + p * kLanes));
      most = hn::MaxOfLanes(d, most);
      least = hn::Min(least, most);
      *tile.hiz.at(column, row) = hn::GetLane(most);
    }
  return hn::GetLane(least) < wrap(kDepthClear);
}

// Draws a tile's triangles and coverage masks in submission order.
//
// Blocks are drawn in loops over lists, so two stores hold back work: `small_`, and `waiting_`, the candidate
// blocks of the last large triangle. At most one of them holds work: each is drawn before work is added to
// the other, and both are drawn before masks.
template <class Numbers>
class TilePainter {
 public:
  TilePainter(const TileTask& task, Tile& tile)
      : task_(task),
        tile_(tile),
        small_(tile),
        masks_(*task.bins, task.cell),
        zmax_is_stale_(!task.part.clear && task.hierarchical_depth) {}

  void draw_segment(const Bins::Segment& segment) {
    for (std::uint32_t left = set_up(task_, segment.indices, batch_); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      masks_.draw_before(segment, static_cast<std::size_t>(k), draw_masks_);
      const int width = batch_.bx1[k] - batch_.bx0[k] + 1, height = batch_.by1[k] - batch_.by0[k] + 1;
      if (std::max(width, height) <= SmallTriangles<Numbers>::kSide) {
        draw_waiting();
        count(Part::tile_edges);
        small_.add(batch_, k);
      } else {
        small_.draw();
        add_large(k, width);
      }
    }
    draw_waiting();  // before the next batch replaces this one
  }

  void draw_rest() {
    small_.draw();
    masks_.draw_rest(draw_masks_);
  }

 private:
  struct DrawMasks {
    TilePainter& painter;
    std::size_t operator()(std::span<const CoverageMask> masks, std::uint32_t last) const {
      painter.draw_waiting();
      painter.small_.draw();
      return draw_masks(painter.tile_, masks, last);
    }
  };

  HWY_INLINE void draw_waiting() {
    if (waiting_ != nullptr) draw_candidates(tile_, batch_, *waiting_);
    waiting_ = nullptr;
  }

  // Draws the previous triangle's list after this one's is filled, so its length is known long before its
  // loop begins.
  HWY_INLINE void add_large(int k, int width) {
    if (zmax_is_stale_) [[unlikely]]
      zmax_is_stale_ = false, has_occluders_ = load_hiz(task_, tile_);
    // Thin triangles fill no block, so they occlude none.
    has_occluders_ = has_occluders_ || (task_.hierarchical_depth && may_fill_blocks(batch_, k));
    const NearestDepth nearest(batch_, k);
    if (has_occluders_ && tile_.hiz.occludes(nearest.least)) [[unlikely]]  // in most scenes
      return count(Part::hiz);
    count(Part::tile_edges);
    Candidates& next = candidates_[waiting_ == candidates_ ? 1 : 0];
    has_occluders_ ? find<true>(k, width, nearest, next) : find<false>(k, width, nearest, next);
    draw_waiting();
    waiting_ = &next;
  }

  template <bool kHiZ>
  HWY_INLINE void find(int k, int width, const NearestDepth& nearest, Candidates& out) {
    constexpr int kHalf = std::max(kVectors / 2, 1);
    width <= kMaxBlocks / 2 ? find_candidates<Numbers, kHiZ, kHalf>(tile_, batch_, k, nearest, out)
                            : find_candidates<Numbers, kHiZ, kVectors>(tile_, batch_, k, nearest, out);
  }

  const TileTask& task_;
  Tile& tile_;
  Batch<Numbers> batch_;
  SmallTriangles<Numbers> small_;
  Candidates candidates_[2];  // one is filled while the other waits
  const Candidates* waiting_ = nullptr;
  Bins::MaskReader masks_;
  const DrawMasks draw_masks_{*this};
  bool has_occluders_ = false;  // the zmax of a block is nearer than kDepthClear
  bool zmax_is_stale_;          // it is not that of the loaded depths
};

template <class Numbers>
void draw_tile_in(const TileTask& task) {
  Tile tile;
  for (int y = 0; y < task.size(); y += kBlockSide)
    for (int i = 0; i < task.size() * kBlockSide; i += kLanes)
      hn::Store(hn::Set(D{}, wrap(task.part.clear ? kDepthClear : 0)), D{}, tile.depth + y * kMaxTile + i);
  read_tile(task, tile.depth, tile.payload,
            [](const FramePlane& from, std::int32_t* buffer) { read_blocks(from, buffer); });
  tile.hiz.clear(task.width(), task.height());

  TilePainter<Numbers> painter(task, tile);
  task.bins->for_each_segment_ahead(task.cell,
                                    [&](const Bins::Segment& segment) { painter.draw_segment(segment); });
  painter.draw_rest();
  write_tile(task, tile.depth, tile.payload,
             [](const FramePlane& to, const auto& pixels) { write_blocks(to, pixels); });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
