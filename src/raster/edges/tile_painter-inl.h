// Draws a tile: its triangles, through a batch at a time, and its coverage masks. See tile_edges.cpp.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "edgewise/contract.h"
#include "raster/edges/tile_blocks-inl.h"
#include "raster/edges/tile_candidates-inl.h"
#include "raster/edges/tile_masks-inl.h"
#include "raster/edges/tile_rows-inl.h"
#include "raster/edges/tile_setup-inl.h"
#include "raster/edges/tile_small-inl.h"
#include "raster/fill_counts.h"

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
      const std::int32_t* const block = tile.depth() + (row * kMaxBlocks + column) * kBlockPixels;
      V most = hn::Load(d, block);
      for (int p = 1; p < kVectors; ++p) most = hn::Max(most, hn::Load(d, block + p * kLanes));
      most = hn::MaxOfLanes(d, most);
      least = hn::Min(least, most);
      *tile.hiz.at(column, row) = hn::GetLane(most);
    }
  return hn::GetLane(least) < wrap(kDepthClear);
}

// Draws a tile's triangles and coverage masks, in submission order.
template <class Arithmetic>
class TilePainter {
 public:
  TilePainter(const TileTask& task, Tile& tile)
      : task_(task),
        tile_(tile),
        small_(tile),
        masks_(*task.bins, task.cell),
        stale_(!task.part.clear && task.hierarchical_depth) {}

  HWY_NOINLINE void draw_segment(const Bins::Segment& segment) {
    Candidates* next = candidates_;
    const Candidates* waiting = nullptr;
    const auto draw_waiting = [&] {
      if (waiting != nullptr) draw_candidates(tile_, batch_, *waiting);
      waiting = nullptr;
    };
    const auto draw_leading = [&](std::span<const CoverageMask> masks, std::uint32_t last) {
      draw_waiting();
      return draw(masks, last);
    };
    for (std::uint32_t left = set_up(task_, segment.indices, batch_); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      masks_.draw_before(segment, static_cast<std::size_t>(k), draw_leading);
      const int width = batch_.bx1[k] - batch_.bx0[k] + 1, height = batch_.by1[k] - batch_.by0[k] + 1;
      if (std::max(width, height) <= SmallTriangles<Arithmetic>::kSide) {
        draw_waiting();
        count(Part::tile_edges);
        small_.add(batch_, k);
      } else {
        small_.draw();
        if (stale_) [[unlikely]]
          stale_ = false, occludes_ = load_hiz(task_, tile_);
        // Thin triangles fill no block, so they occlude none.
        occludes_ = occludes_ || (task_.hierarchical_depth && may_fill_blocks(batch_, k));
        if (occludes_ && tile_.hiz.occludes(batch_.nearest.least[k])) [[unlikely]] {  // in most scenes
          count(Part::hiz);
          continue;
        }
        count(Part::tile_edges);
        occludes_ ? find_candidates<true>(k, width, *next) : find_candidates<false>(k, width, *next);
        draw_waiting();
        waiting = next;
        next = next == candidates_ ? candidates_ + 1 : candidates_;
      }
    }
    draw_waiting();
  }

  void draw_rest() {
    small_.draw();
    masks_.draw_rest(
        [&](std::span<const CoverageMask> masks, std::uint32_t last) { return draw(masks, last); });
  }

 private:
  HWY_INLINE std::size_t draw(std::span<const CoverageMask> masks, std::uint32_t last) {
    small_.draw();
    return draw_masks(tile_, masks, last);
  }
  template <bool kHierarchicalDepth>
  HWY_INLINE void find_candidates(int k, int width, Candidates& out) {
    constexpr std::size_t kAll = kVectors, kHalf = std::max(kVectors / 2, 1);
    width <= kMaxBlocks / 2
        ? find_candidates_by_rows<Arithmetic, kHierarchicalDepth, kHalf>(tile_, batch_, k, out)
        : find_candidates_by_rows<Arithmetic, kHierarchicalDepth, kAll>(tile_, batch_, k, out);
  }

  const TileTask& task_;
  Tile& tile_;
  Batch<Arithmetic> batch_;
  SmallTriangles<Arithmetic> small_;
  Candidates candidates_[2];  // one is filled while the other waits
  Bins::MaskReader masks_;
  bool occludes_ = false;
  bool stale_;  // zmax is not that of the loaded depths
};

template <class Arithmetic>
void draw_tile_in(const TileTask& task) {
  const int size = task.size();
  Tile tile;
  const auto clear = [&](std::int32_t* plane, std::uint32_t value) {
    for (int y = 0; y < size; y += kBlockSide)
      for (int i = 0; i < size * kBlockSide; i += kLanes)
        hn::Store(hn::Set(D{}, wrap(value)), D{}, plane + y * kMaxTile + i);
  };
  clear(tile.depth(), task.part.clear ? kDepthClear : 0);
  if (!InVectors(task).all) clear(tile.payload(), task.part.background);
  read_tile(task, tile.depth(), tile.payload(),
            [](const FramePlane& from, std::int32_t* buffer) { read_blocks(from, buffer); });
  tile.hiz.clear(task.width(), task.height());

  TilePainter<Arithmetic> painter(task, tile);
  task.bins->for_each_segment_ahead(task.cell,
                                    [&](const Bins::Segment& segment) { painter.draw_segment(segment); });
  painter.draw_rest();
  write_tile(task, tile.depth(), tile.payload(),
             [](const FramePlane& to, const auto& pixels) { write_blocks(to, pixels); });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
