// Binning: which triangles can touch which cell of the image, in submission order.
//
// Small triangles may be resolved to patches at once (mask_finder.cpp), which lie in lists by value. Others
// lie in lists of indices, and each patch knows its place among its cell's indices.
//
// The triangles are cut into chunks (shares.h) that are binned in parallel, each into lists of its own; a
// cell's triangles are its lists of chunk 0, 1, 2 …, which keeps the order of submission (rule 7) whatever
// thread did which chunk. A list holds indices, not records, in blocks of two cache lines that are chained
// and reused from frame to frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/screen_triangle.h"
#include "edgewise/simd_target.h"
#include "raster/binning/cell_boxes.h"
#include "raster/binning/mask_finder.h"
#include "raster/binning/mask_lists.h"
#include "raster/binning/work_partition.h"

namespace edgewise {

class Bins {
 public:
  enum class Small { as_indices, as_masks };

  // Replaces what was binned before. A triangle with no sample in its bounding box lands nowhere; one without
  // area may land in up to four cells. Patches want cells of tiles; a target without vectors makes none.
  // `prefetch`: triangles are asked for before they are needed. Throws std::length_error when a chunk's lists
  // pass 2^32 entries.
  void build(std::span<const ScreenTriangle> triangles, const CellGrid& grid, int threads, SimdTarget target,
             Small small, bool prefetch);

  bool empty(int cell) const {
    const auto c = static_cast<std::size_t>(cell);
    for (std::size_t i = 0; i < used_chunks_; ++i)
      if (chunks_[i].first[c] != kNone || (has_masks_ && !chunks_[i].patches.empty(c))) return false;
    return true;
  }

  // Consecutive indices of a cell.
  struct Run {
    std::span<const std::uint32_t> indices;
    std::size_t chunk;
    std::uint32_t first_slot;
  };

  // visit(run) for a cell's triangle indices, in submission order.
  template <typename Visit>
  void for_each_run(int cell, Visit&& visit) const {
    const auto c = static_cast<std::size_t>(cell);
    for (std::size_t i = 0; i < used_chunks_; ++i) {
      const Chunk& chunk = chunks_[i];
      for (std::uint32_t slot = chunk.first[c]; slot != kNone;) {
        const std::uint32_t block_end = slot + kRun;
        const bool last = chunk.cursor[c] <= block_end && chunk.cursor[c] > slot;
        const std::uint32_t end = last ? chunk.cursor[c] : block_end;
        if (!last) {  // the next block is anywhere: ask for it in time
          const std::uint32_t* const next = &chunk.slots[chunk.slots[block_end]];
          __builtin_prefetch(next), __builtin_prefetch(next + kRun);
        }
        visit(Run{{&chunk.slots[slot], end - slot}, i, slot});
        slot = last ? kNone : chunk.slots[block_end];
      }
    }
  }

  // Goes through the patches of a cell, in submission order. draw(patches, rank) draws the first of some
  // consecutive patches, as many as have no higher rank, and returns how many these are.
  class MaskReader {
   public:
    MaskReader(const Bins& bins, int cell) : bins_(bins), cell_(static_cast<std::size_t>(cell)) {
      if (!bins_.has_masks_) return;
      for (std::size_t i = 0; i < bins_.used_chunks_; ++i) bins_.chunks_[i].patches.prefetch_first(cell_);
      reader_ = {bins_.chunks_[0].patches, cell_};
    }
    // Draws what is left of those before one of a run's triangles.
    template <typename Draw>
    void up_to(const Run& run, std::size_t index, Draw&& draw) {
      go_on(run.chunk, run.first_slot + static_cast<std::uint32_t>(index) + 1, draw);
    }
    template <typename Draw>
    void to_the_end(Draw&& draw) {
      go_on(bins_.used_chunks_ - 1, kNone, draw);
    }

   private:
    template <typename Draw>
    void go_on(std::size_t chunk, std::uint32_t rank, Draw&& draw) {
      if (!bins_.has_masks_) return;
      for (; chunk_ != chunk; reader_ = {bins_.chunks_[++chunk_].patches, cell_}) draw_some(kNone, draw);
      draw_some(rank, draw);
    }
    template <typename Draw>
    void draw_some(std::uint32_t rank, Draw&& draw) {
      for (auto ahead = reader_.ahead(); !ahead.empty() && ahead.front().rank <= rank;
           ahead = reader_.ahead())
        reader_.pass(draw(ahead, rank));
    }

    const Bins& bins_;
    std::size_t cell_, chunk_ = 0;
    MaskLists::Reader reader_;
  };

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::uint32_t kBlock = 32;        // slots, a power of two
  static constexpr std::uint32_t kRun = kBlock - 1;  // indices in a block; the last slot names the next block

  // Two chunks share no cache line, nor the pair of lines that processors fetch: threads write to them.
  struct alignas(128) Chunk {
    std::vector<std::uint32_t> slots;          // blocks of kBlock
    std::vector<std::uint32_t> first, cursor;  // for each cell: slot of its first block, next slot to write
    std::uint32_t used = 0;                    // slots in use
    MaskLists patches;

    void reset(std::size_t cells);
    // For a cell whose last block, if it has one, is full up to the slot that names the next.
    std::uint32_t begin_block(std::size_t cell, std::uint32_t end_of_last);
    // Adds it if it is wanted; no branch could guess whether.
    void push(std::size_t cell, std::uint32_t index, bool wanted);
    void bin(const ScreenTriangle& triangle, std::uint32_t index, const CellBox& box, int of_four,
             const CellGrid& grid);
    void bin_in_many(const ScreenTriangle& triangle, std::uint32_t index, const CellBox& box,
                     const CellGrid& grid);
    void bin_boxed(const ScreenTriangle* some, std::uint64_t boxed, const CellBoxes& boxes, std::size_t begin,
                   const CellGrid& grid);
    void append(const SortedTriangles& sorted, std::size_t n, std::size_t end);
    void bin_as_indices(std::span<const ScreenTriangle> triangles, std::size_t begin, const CellGrid& grid,
                        bool prefetch, CellBoxKernel find_boxes);
    void bin_with_masks(std::span<const ScreenTriangle> triangles, std::size_t begin, const CellGrid& grid,
                        bool prefetch, MaskFinder find_masks, std::size_t most_mask_bytes);
  };

  std::vector<Chunk> chunks_;
  WorkPartition partition_;
  std::size_t used_chunks_ = 0;
  bool has_masks_ = false;
};

}  // namespace edgewise
