// The tile kernel.
//
// 1. Depth and payload of the tile live in a buffer of 32 KB; with the lists beside it a tile works on about
//    46 KB, which an L1 cache of 48 KB just holds, while one of 32 KB leaves some to L2. The buffer is
//    written out once, past the other caches where the frame would not stay in them. The frame needs no clear
//    pass, and of the buffer only the depths do: where they are still clear, the background goes out.
// 2. The buffer is stored in blocks of 4 x 4 pixels, 16 consecutive integers: one AVX-512 vector, two of
//    AVX2, four of SSE4 (tile_blocks-inl.h). Four by four wastes fewer lanes on small triangles than 16 x 1.
// 3. Triangles are set up a vector at a time (tile_setup-inl.h), for the tile: an edge that accepts the
//    triangle's whole box there becomes the constant 0, the others are stepped in int32 lanes (rule 5).
// 4. A box of several blocks is first sifted a row of blocks (tile_rows-inl.h) or a square of blocks
//    (tile_small-inl.h) at a time: all blocks that an edge rejects, or that hide the triangle (hierarchical
//    depth, hiz-inl.h), fall out in one vector operation. What the whole tile hides is not sifted.
// 5. What is touched goes to a list first (tile_candidates-inl.h): how many blocks a triangle has is hard for
// a
//    branch predictor to guess, and the loop over the list need not. A large triangle's list waits while the
//    next one is sifted: so its length is long known when the loop begins.
// 6. Small triangles come as patches, whose pixels were found where they were binned (mask_finder.cpp); they
//    are drawn without a branch (tile_masks-inl.h).
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

// Draws what a tile's bin holds, in submission order.
class TilePainter {
 public:
  TilePainter(const TileTask& job, Tile& tile)
      : job_(job), tile_(tile), small_(tile), patches_(*job.bins, job.cell) {}

  HWY_NOINLINE void draw_run(const Bins::Run& run) {
    Candidates* next = touched_;
    const Candidates* waiting = nullptr;
    const auto draw_waiting = [&] {
      if (waiting != nullptr) draw_candidates(tile_, batch_, *waiting);
      waiting = nullptr;
    };
    const auto draw_some = [&](std::span<const CoverageMask> patches, std::uint32_t last) {
      draw_waiting();
      return draw(patches, last);
    };
    for (std::uint32_t left = set_up(job_, run.indices, batch_); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      patches_.up_to(run, static_cast<std::size_t>(k), draw_some);
      const int width = batch_.bx1[k] - batch_.bx0[k] + 1, height = batch_.by1[k] - batch_.by0[k] + 1;
      if (std::max(width, height) <= SmallTriangles::kSide) {
        draw_waiting();
        small_.add(batch_, k);
      } else {
        small_.draw();
        // Thin triangles fill no block, and hide none.
        occludes_ = occludes_ || (job_.ablation.hierarchical_depth && may_fill_blocks(batch_, k));
        if (occludes_ && tile_.hiz.occludes(batch_.nearest.least[k])) [[unlikely]]  // in most scenes
          continue;
        occludes_ ? find_candidates<true>(k, width, *next) : find_candidates<false>(k, width, *next);
        draw_waiting();
        waiting = next;
        next = next == touched_ ? touched_ + 1 : touched_;
      }
    }
    draw_waiting();
  }

  void draw_rest() {
    small_.draw();
    patches_.to_the_end(
        [&](std::span<const CoverageMask> patches, std::uint32_t last) { return draw(patches, last); });
  }

 private:
  HWY_INLINE std::size_t draw(std::span<const CoverageMask> patches, std::uint32_t last) {
    small_.draw();
    return draw_masks(tile_, patches, last);
  }
  template <bool kHierarchicalDepth>
  HWY_INLINE void find_candidates(int k, int width, Candidates& out) {
    constexpr std::size_t kAll = kVectors, kHalf = std::max(kVectors / 2, 1);
    width <= kMaxBlocks / 2 ? find_candidates_by_rows<kHierarchicalDepth, kHalf>(tile_, batch_, k, out)
                            : find_candidates_by_rows<kHierarchicalDepth, kAll>(tile_, batch_, k, out);
  }

  const TileTask& job_;
  Tile& tile_;
  Batch batch_;
  SmallTriangles small_;
  Candidates touched_[2];  // one is filled while the other waits
  Bins::MaskReader patches_;
  bool occludes_ = false;
};

void draw_tile(const TileTask& job) {
  if (job.bins->empty(job.cell)) {
    write_background(job);
    return clear_upper_halves();
  }
  const int size = job.size();
  Tile tile;
  const auto clear = [&](std::int32_t* plane, std::uint32_t value) {
    for (int y = 0; y < size; y += kBlock)
      for (int i = 0; i < size * kBlock; i += kLanes)
        hn::Store(hn::Set(D{}, wrap(value)), D{}, plane + y * kMaxTile + i);
  };
  clear(tile.depth(), kDepthClear);
  if (!InVectors(job.width(), job.height()).all) clear(tile.payload(), job.background);
  tile.hiz.clear(job.width(), job.height());

  TilePainter painter(job, tile);
  draw_runs(job, [&](const Bins::Run& run) { painter.draw_run(run); });
  painter.draw_rest();
  write_tile(job, tile.depth(), tile.payload(),
             [](const Place& to, const auto& pixels) { write_blocks(to, pixels); });
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
