// The tile kernel.
//
// 1. Depth and payload of the tile live in a buffer of 32 KB. With its lists a tile uses about 46 KB, which
//    fits an L1 cache of 48 KB; with one of 32 KB, part of it lies in L2. The buffer is stored to the frame
//    once. Only the buffer's depths are cleared: pixels whose depth is still clear get the background.
// 2. The buffer is stored in blocks of 4 x 4 pixels, 16 consecutive integers: one AVX-512 vector, two of
//    AVX2, four of SSE4 (tile_blocks-inl.h). 4 x 4 wastes fewer lanes on small triangles than 16 x 1.
// 3. Triangles are set up for the tile, a vector at a time (tile_setup-inl.h). An edge that accepts the
//    triangle's whole box becomes the constant 0; the others are stepped in int32 lanes (rule 5).
// 4. Coarse rejection tests a row of blocks (tile_rows-inl.h) or, for small boxes, a square of blocks
//    (tile_small-inl.h) at a time, one lane per block. Blocks outside an edge are rejected; in rows of
//    blocks, so are occluded ones (HiZ, hiz-inl.h). Triangles that are occluded in the whole tile skip the
//    test.
// 5. Candidate blocks go into a list first (tile_candidates-inl.h): the number of blocks per triangle is hard
//    to predict for a branch predictor, but a loop over a list is not. A large triangle's list is drawn
//    after the next triangle's list is filled, so its length is known long before its loop begins.
// 6. Small triangles arrive as coverage masks, made by binning (mask_finder.cpp), and are drawn without a
//    branch (tile_masks-inl.h).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tiled/tile_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/tiled/tile_blocks-inl.h"
#include "raster/tiled/tile_candidates-inl.h"
#include "raster/tiled/tile_kernel.h"
#include "raster/tiled/tile_masks-inl.h"
#include "raster/tiled/tile_rows-inl.h"
#include "raster/tiled/tile_setup-inl.h"
#include "raster/tiled/tile_small-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// Draws a tile's triangles and coverage masks, in submission order.
class TilePainter {
 public:
  TilePainter(const TileTask& task, Tile& tile)
      : task_(task), tile_(tile), small_(tile), masks_(*task.bins, task.cell) {}

  HWY_NOINLINE void draw_index_block(const Bins::IndexBlock& block) {
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
    for (std::uint32_t left = set_up(task_, block.indices, batch_); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      masks_.draw_before(block, static_cast<std::size_t>(k), draw_leading);
      const int width = batch_.bx1[k] - batch_.bx0[k] + 1, height = batch_.by1[k] - batch_.by0[k] + 1;
      if (std::max(width, height) <= SmallTriangles::kSide) {
        draw_waiting();
        small_.add(batch_, k);
      } else {
        small_.draw();
        // Thin triangles fill no block, so they occlude none.
        occludes_ = occludes_ || (task_.ablation.hierarchical_depth && may_fill_blocks(batch_, k));
        if (occludes_ && tile_.hiz.occludes(batch_.nearest.least[k])) [[unlikely]]  // in most scenes
          continue;
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
    width <= kMaxBlocks / 2 ? find_candidates_by_rows<kHierarchicalDepth, kHalf>(tile_, batch_, k, out)
                            : find_candidates_by_rows<kHierarchicalDepth, kAll>(tile_, batch_, k, out);
  }

  const TileTask& task_;
  Tile& tile_;
  Batch batch_;
  SmallTriangles small_;
  Candidates candidates_[2];  // one is filled while the other waits
  Bins::MaskReader masks_;
  bool occludes_ = false;
};

void draw_tile(const TileTask& task) {
  if (task.bins->empty(task.cell)) {
    write_background(task);
    return clear_upper_halves();
  }
  const int size = task.size();
  Tile tile;
  const auto clear = [&](std::int32_t* plane, std::uint32_t value) {
    for (int y = 0; y < size; y += kBlockSide)
      for (int i = 0; i < size * kBlockSide; i += kLanes)
        hn::Store(hn::Set(D{}, wrap(value)), D{}, plane + y * kMaxTile + i);
  };
  clear(tile.depth(), kDepthClear);
  if (!InVectors(task.width(), task.height()).all) clear(tile.payload(), task.background);
  tile.hiz.clear(task.width(), task.height());

  TilePainter painter(task, tile);
  draw_index_blocks(task, [&](const Bins::IndexBlock& block) { painter.draw_index_block(block); });
  painter.draw_rest();
  write_tile(task, tile.depth(), tile.payload(),
             [](const FramePlane& to, const auto& pixels) { write_blocks(to, pixels); });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

TileKernel tile_kernel(SimdTarget target) {
  return EDGEWISE_KERNEL(draw_tile, target);
}

}  // namespace edgewise
#endif
