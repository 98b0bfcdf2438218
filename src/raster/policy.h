// What drawing in tiles decides by thresholds. No decision changes a bit of the picture.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "edgewise/screen_triangle.h"
#include "raster/kernels.h"
#include "raster/llc.h"
#include "raster/tile_options.h"

namespace edgewise {

// How many triangles a tile has. Bins::few() defines `few`.
enum class TileContent { nothing, few, many };

// TileStore::automatic:
// - A frame larger than half the LLC is streamed: it cannot stay there beside its reader's data.
// - Empty tiles of other frames get cached stores, since no work overlaps with filling them.
// - If triangles and masks exceed an L2 cache, they need the LLC, and a tile with triangles is streamed.
// - On one thread, a tile with many triangles is streamed while the next one is drawn. Several threads that
//   stream would wait for the memory's bandwidth.
// - Other tiles get cached stores, and so do all tiles that are drawn over what the frame holds: they have
//   just been loaded.
// `read_bytes`: of all triangles and masks.
constexpr TileStore tile_store_for(TileContent content, std::size_t read_bytes, int threads,
                                   std::size_t frame_bytes, std::size_t llc) {
  const bool fits_llc = frame_bytes <= llc / 2, fits_l2 = read_bytes <= kL2Bytes;
  const bool cached =
      content == TileContent::nothing || (fits_l2 && (content == TileContent::few || threads > 1));
  return fits_llc && cached ? TileStore::cached : TileStore::streaming;
}

// A thread takes up to four consecutive tasks at once, since taking work costs oneTBB about 0.1 us.
constexpr int tasks_at_once(int tasks, int threads) {
  return std::clamp(tasks / (16 * threads), 1, 4);
}

// A tile is light if it has no more triangles than this, no masks, and is not cut by the frame's right side.
// Light tiles are cleared together with the empty ones of their row and drawn in the frame, which is faster
// than storing a buffer in short rows. More triangles overlap more, and drawing over pixels is slower in the
// frame than in a buffer in L1.
inline constexpr std::uint32_t kLightTriangles = 2;
static_assert(kLongestVector <= 16);  // px, of the smallest tile

}  // namespace edgewise
