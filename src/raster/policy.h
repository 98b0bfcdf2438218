// What drawing in tiles decides. No decision changes a bit of the picture. Ratios are of whole frames of 1920
// x 1080 px, on a processor with AVX-512 and 32 MB of last-level cache.
#pragma once

#include <cstddef>

namespace edgewise {

// TileStore::automatic for tiles with triangles. Streaming stores overlap with drawing the next tile. While
// other processes use the cache, cached ones are 1.1x slower on one thread, up to 1.4x on two (grid64). A
// tile that is drawn over what the frame holds has just been loaded.
constexpr bool tiles_are_streamed(bool clear) {
  return clear;
}

// TileStore::automatic for empty tiles. A frame larger than half the last-level cache cannot stay there
// beside its reader's data. In others, no work overlaps with the clear. On an idle machine, frame after
// frame, streaming stores make `cube` 1.6x slower on two threads; while other processes use the cache, 2x
// faster.
constexpr bool clears_are_streamed(std::size_t frame_bytes, std::size_t llc) {
  return frame_bytes > llc / 2;
}

}  // namespace edgewise
