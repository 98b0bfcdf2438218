// Tasks of the kernels that draw a cell's triangles in the frame itself or in a tile's buffer, and counts of
// what they drew.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "edgewise/simd_target.h"
#include "raster/binning/bins.h"

namespace edgewise {

inline constexpr int kLongestVector = 16;  // px

// Draws the triangles of a cell in the frame itself: those of a band, or of rows of a tile.
struct FrameTask {
  const Bins& bins;
  int cell;
  // Ends at kLongestVector or further right, unless the kernel is scalar. Its rows lie in one row of depth
  // cells; frame_edges takes at most 32 rows.
  //
  // The last vector of a row's pixels ends with the region. So it may begin left of the region, where it
  // keeps what the frame holds. No other thread may draw there.
  contract::PixelBox region;
  FrameView frame;  // FramePart::frame
};
using FrameKernel = void (*)(const FrameTask&);

// Draws the triangles of a tile in a buffer sized for the L1 cache, and stores the buffer to the frame.
struct TileTask {
  const Bins& bins;
  int cell;       // index of the tile in `bins`
  int x0, y0;     // px, the tile's first pixel; multiples of the tile's size
  int size_log2;  // px; at most 6
  FramePart part;
  bool hierarchical_depth;  // TileOptions::hierarchical_depth
  bool streaming;           // if the planes are aligned for it

  int size() const { return 1 << size_log2; }  // px
  // The tile's columns left() … width() - 1 and rows top() … height() - 1 are drawn, px. The kernel may also
  // draw what lies left of or above them in its buffer, but must not store it.
  int left() const { return std::max(part.x0 - x0, 0); }
  int top() const { return std::max(part.y0 - y0, 0); }
  int width() const { return std::min(size(), part.frame.width - x0); }
  int height() const { return std::min(size(), part.frame.height - y0); }
  contract::PixelBox box() const { return {x0, y0, x0 + width(), y0 + height()}; }
};
using TileKernel = void (*)(const TileTask&);

// The fills, each defined at the end of the file of its name. `target` must be resolved.
FrameKernel frame_boxes(SimdTarget target);  // tests all pixels of a triangle's box; the same for all targets
FrameKernel frame_spans(SimdTarget target);
FrameKernel frame_edges(SimdTarget target);
TileKernel tile_spans(SimdTarget target);
TileKernel tile_edges(SimdTarget target);

// How many triangles each part has drawn, for tests. Only builds with EDGEWISE_COUNT_FILLS count.
enum class Part { frame_boxes, frame_spans, frame_edges, tile_spans, tile_edges, masks, hiz };
#ifdef EDGEWISE_COUNT_FILLS
inline std::array<std::atomic<std::uint64_t>, 7> fill_counts;
inline void count(Part part, std::uint64_t triangles = 1) {
  fill_counts[static_cast<std::size_t>(part)] += triangles;
}
#else
inline void count(Part, std::uint64_t = 1) {}
#endif

}  // namespace edgewise
