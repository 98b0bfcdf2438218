// The operations that the cost model times, in vectors of the best SIMD target. See cost_model.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include "edgewise/framebuffer.h"

namespace edgewise::bench {

// Sums `count` integers, to read all of them.
std::uint64_t read_all(const std::uint64_t* from, std::size_t count);

// `to` is aligned to 64 bytes, `count` a multiple of 16. `streaming` uses stores that bypass the caches.
void fill_all(std::uint32_t* to, std::size_t count, std::uint32_t value, bool streaming);

// A tile of 64 x 64 pixels in blocks of 4 x 4, with a triangle's edge and depth values for every block.
struct L1Tile {
  static constexpr int kSide = 64, kBlocks = 256, kBlockPixels = 16;
  alignas(64) std::int32_t depth[kBlocks * kBlockPixels], payload[kBlocks * kBlockPixels];
  alignas(64) std::int32_t in_block[4][kBlockPixels];  // three edges and depth, relative to the first pixel
  std::int32_t at_block[4][kBlocks];                   // the same values at each block's first pixel
};
// Tests and writes every block once.
void draw_blocks(L1Tile& tile, std::int32_t payload);

// Clears the tile's depths, and copies the tile to the frame at (x0, y0), multiples of 64 px. Here the tile
// is read row by row, 64 consecutive integers each. The frame's rows are aligned to 64 bytes, and its stride
// is a multiple of 16.
void clear_and_copy(L1Tile& tile, const FrameView& frame, int x0, int y0, bool streaming);

}  // namespace edgewise::bench
