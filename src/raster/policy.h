// What drawing in tiles decides. No decision changes a bit of the picture. Ratios are of whole frames of 1920
// x 1080 px, on an idle machine with two cores, AVX-512 and 32 MB of last-level cache.
#pragma once

#include <cstddef>
#include <cstdint>

namespace edgewise {

// Whether a cleared frame cannot stay in the last-level cache beside its reader's data. Streaming
// (non-temporal) stores then save reading what it held. On a machine with 300 MB of that cache, `cube`,
// `sphere` and `terrain` of 7680 x 4320 px (265 MB) take 1.3 to 1.65 times as long without them, on one
// thread and on two. On one with 32 MB, `cube` of 1920 x 1080 px (17 MB) takes 1.6 times as long with them.
constexpr bool is_large(std::size_t frame_bytes, std::size_t llc) {
  return frame_bytes > llc / 3 * 2;
}

// TileStore::automatic for tiles in buffers. On one thread, streaming stores overlap with drawing the next
// tile: grid64 takes 0.9 times as long. On two, they wait for the memory's bandwidth: grid64 1.2 times.
constexpr bool tiles_are_streamed(bool large, int threads) {
  return large || threads == 1;
}

// A tile is light if it has no more triangles than this, no masks, and is not cut by the frame's right side.
// Unless clears are streamed, light tiles are cleared together with the empty ones of their row and drawn in
// the frame. In buffers, `cube` takes 1.1 times as long, on one thread and on two, and `cubes` 1.05 times.
inline constexpr std::uint32_t kLightTriangles = 2;

}  // namespace edgewise
