// Binning: lists for every cell of the image the triangles that may cover a pixel of it, in submission order.
//
// The triangles are cut into chunks (work_partition.h). Chunks are binned in parallel, each into its own
// lists. A cell's triangles are its lists of chunks 0, 1, 2 …, which is the order of submission (rule 7), no
// matter which thread binned which chunk.
//
// If a source makes the triangles while they are binned (triangle_source.h), a chunk keeps only those that it
// lists as indices.
//
// A list holds indices of triangles, in chained blocks of two cache lines that are reused from frame to
// frame. Small triangles may become coverage masks instead (mask_finder.cpp), stored by value in lists of
// their own (mask_lists.h). Each mask stores its rank among its cell's indices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/buffer.h"
#include "core/triangle_source.h"
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

  // Replaces the previous contents. A triangle without a sample in its bounding box is dropped; one without
  // area may be listed in up to four cells. as_masks needs cells that are tiles, and makes no masks on the
  // scalar target. `prefetch`: prefetch triangles that lie in memory. Throws std::length_error when a chunk's
  // lists exceed 2^32 entries. Returns false, with incomplete
  // contents, if a chunk's room for made triangles might not suffice.
  [[nodiscard]] bool build(TriangleSource& source, const CellGrid& grid, int threads, SimdTarget target,
                           Small small, bool prefetch);
  // The same for triangles that lie in memory, which need not be kept.
  void build(std::span<const ScreenTriangle> triangles, const CellGrid& grid, int threads, SimdTarget target,
             Small small, bool prefetch);

  // Indices refer to these triangles: the stored ones of the source, or those that were kept of it.
  const ScreenTriangle* triangles() const { return triangles_; }

  bool empty(int cell) const {
    const auto c = static_cast<std::size_t>(cell);
    for (std::size_t i = 0; i < used_chunks_; ++i)
      if (chunks_[i].first[c] != kNone || (has_masks_ && !chunks_[i].masks.empty(c))) return false;
    return true;
  }

  // True if each chunk lists at most kIndicesPerBlock triangles for the cell, and has no masks there.
  bool few(int cell) const {
    const auto c = static_cast<std::size_t>(cell);
    for (const Chunk& chunk : std::span(chunks_).first(used_chunks_)) {
      const bool one_block = chunk.first[c] == kNone || chunk.cursor[c] - chunk.first[c] < kSlotsPerBlock;
      if (!one_block || (has_masks_ && !chunk.masks.empty(c))) return false;
    }
    return true;
  }

  // Consecutive indices of a cell: one block of a list. `first_slot`: the slot of the first in the chunk.
  struct IndexBlock {
    std::span<const std::uint32_t> indices;
    std::size_t chunk;
    std::uint32_t first_slot;
  };

  // Calls visit(block) for the index blocks of a cell, in submission order.
  template <typename Visit>
  void for_each_index_block(int cell, Visit&& visit) const {
    const auto c = static_cast<std::size_t>(cell);
    for (std::size_t i = 0; i < used_chunks_; ++i) {
      const Chunk& chunk = chunks_[i];
      for (std::uint32_t slot = chunk.first[c]; slot != kNone;) {
        const std::uint32_t block_end = slot + kIndicesPerBlock;
        const bool last = chunk.cursor[c] <= block_end && chunk.cursor[c] > slot;
        const std::uint32_t end = last ? chunk.cursor[c] : block_end;
        if (!last) {  // the next block may lie anywhere: prefetch it
          const std::uint32_t* const next = &chunk.slots[chunk.slots[block_end]];
          __builtin_prefetch(next), __builtin_prefetch(next + kIndicesPerBlock);
        }
        visit(IndexBlock{{&chunk.slots[slot], end - slot}, i, slot});
        slot = last ? kNone : chunk.slots[block_end];
      }
    }
  }

  // Reads the masks of a cell in submission order. The callback draw(masks, rank) draws the leading masks
  // whose rank is at most `rank`, and returns their number.
  class MaskReader {
   public:
    MaskReader(const Bins& bins, int cell) : bins_(bins), cell_(static_cast<std::size_t>(cell)) {
      if (!bins_.has_masks_) return;
      for (std::size_t i = 0; i < bins_.used_chunks_; ++i) bins_.chunks_[i].masks.prefetch_first(cell_);
      reader_ = {bins_.chunks_[0].masks, cell_};
    }
    // Draws the remaining masks that precede triangle `index` of an index block.
    template <typename Draw>
    void draw_before(const IndexBlock& block, std::size_t index, Draw&& draw) {
      advance_to(block.chunk, block.first_slot + static_cast<std::uint32_t>(index) + 1, draw);
    }
    template <typename Draw>
    void draw_rest(Draw&& draw) {
      advance_to(bins_.used_chunks_ - 1, kNone, draw);
    }

   private:
    template <typename Draw>
    void advance_to(std::size_t chunk, std::uint32_t rank, Draw&& draw) {
      if (!bins_.has_masks_) return;
      for (; chunk_ != chunk; reader_ = {bins_.chunks_[++chunk_].masks, cell_}) draw_up_to_rank(kNone, draw);
      draw_up_to_rank(rank, draw);
    }
    template <typename Draw>
    void draw_up_to_rank(std::uint32_t rank, Draw&& draw) {
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
  static constexpr std::uint32_t kSlotsPerBlock = 32;                    // a power of two
  static constexpr std::uint32_t kIndicesPerBlock = kSlotsPerBlock - 1;  // the last slot links to the next

  // Different threads write to chunks. The alignment keeps them in different pairs of cache lines, which
  // processors fetch together (false sharing).
  struct alignas(128) Chunk {
    std::vector<std::uint32_t> slots;          // blocks of kSlotsPerBlock
    std::vector<std::uint32_t> first, cursor;  // for each cell: slot of its first block, next slot to write
    std::uint32_t used = 0;                    // slots in use
    MaskLists masks;
    ScreenTriangle* kept = nullptr;  // where triangles that are binned as indices are kept; null: nowhere
    std::size_t next_kept = 0;       // index there

    void reset(std::size_t cells);
    // Appends a block to a cell's list. `end_of_last`: the link slot of its last block, or kNone.
    std::uint32_t begin_block(std::size_t cell, std::uint32_t end_of_last);
    // Appends the index if it is a candidate, without a branch that would be mispredicted.
    void push(std::size_t cell, std::uint32_t index, bool is_candidate);
    void bin(const ScreenTriangle& triangle, std::uint32_t index, const CellBox& box, int candidate_cells,
             const CellGrid& grid);
    void bin_in_many(const ScreenTriangle& triangle, std::uint32_t index, const CellBox& box,
                     const CellGrid& grid);
    void bin_boxed(const ScreenTriangle* batch, std::uint64_t boxed, const CellBoxes& boxes,
                   std::size_t begin, const CellGrid& grid);
    void append(const SortedTriangles& sorted, std::size_t n, std::size_t end);
    void bin_as_indices(std::span<const ScreenTriangle> triangles, std::size_t begin, const CellGrid& grid,
                        bool prefetch, CellBoxKernel find_boxes);
    void bin_with_masks(std::span<const ScreenTriangle> triangles, std::size_t begin, const CellGrid& grid,
                        bool prefetch, MaskFinder find_masks, std::size_t max_mask_bytes);
  };

  std::vector<Chunk> chunks_;
  Buffer<ScreenTriangle> kept_;
  const ScreenTriangle* triangles_ = nullptr;
  WorkPartition partition_;
  std::size_t used_chunks_ = 0;
  bool has_masks_ = false;
};

}  // namespace edgewise
