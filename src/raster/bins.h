// Binning: which triangles can touch which cell of the image, in submission order.
//
// The triangles are cut into chunks that are binned in parallel, each into lists of its own; a cell's
// triangles are its lists of chunk 0, 1, 2 …, which keeps the order of submission (rule 7) whatever thread
// did which chunk. A list holds indices, not records, in blocks of two cache lines that are chained and
// reused from frame to frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/cell_boxes.h"
#include "raster/screen_triangle.h"
#include "raster/simd_target.h"
#include "raster/tiled_ideas.h"

namespace edgewise {

class Bins {
 public:
  // Replaces what was binned before. A triangle with no sample in its bounding box lands nowhere; one without
  // area may land in a cell or two. Throws std::length_error when a chunk's lists pass 2^32 entries.
  void build(std::span<const ScreenTriangle> triangles, const CellGrid& grid, int threads, SimdTarget target,
             const TiledIdeas& ideas = {});

  bool empty(int cell) const {
    for (std::size_t i = 0; i < used_chunks_; ++i)
      if (chunks_[i].first[static_cast<std::size_t>(cell)] != kNone) return false;
    return true;
  }

  // visit(indices) for consecutive runs of a cell's triangle indices, in submission order.
  template <typename Visit>
  void for_each_run(int cell, Visit&& visit) const {
    const auto c = static_cast<std::size_t>(cell);
    for (std::size_t i = 0; i < used_chunks_; ++i) {
      const Chunk& chunk = chunks_[i];
      for (std::uint32_t slot = chunk.first[c]; slot != kNone;) {
        const std::uint32_t block_end = slot + kRun;
        const bool last = chunk.cursor[c] <= block_end && chunk.cursor[c] > slot;
        const std::uint32_t end = last ? chunk.cursor[c] : block_end;
        visit(std::span<const std::uint32_t>(&chunk.slots[slot], end - slot));
        slot = last ? kNone : chunk.slots[block_end];
      }
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::uint32_t kBlock = 32;        // slots, a power of two
  static constexpr std::uint32_t kRun = kBlock - 1;  // indices in a block; the last slot names the next block

  // Two chunks share no cache line, nor the pair of lines that processors fetch: threads write to them.
  struct alignas(128) Chunk {
    std::vector<std::uint32_t> slots;          // blocks of kBlock
    std::vector<std::uint32_t> first, cursor;  // for each cell: slot of its first block, next slot to write
    std::uint32_t used = 0;                    // slots in use

    void reset(std::size_t cells);
    void push(std::size_t cell, std::uint32_t index);
  };

  static void bin(const ScreenTriangle& triangle, std::uint32_t index, const CellBox& box,
                  const CellGrid& grid, Chunk& chunk);

  std::vector<Chunk> chunks_;
  std::size_t used_chunks_ = 0;
};

}  // namespace edgewise
