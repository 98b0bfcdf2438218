// A cost model of a frame on this machine, the sum of three parts:
// - reading each triangle's record once,
// - testing and writing each block of 4 x 4 pixels once for each triangle that wins a pixel of it, in the L1
//   cache, with vectors of the best SIMD target,
// - writing depth and payload of the frame once, by cached or streaming stores, whichever is faster.
//
// It is no lower bound: parts that overlap in time undercut it. Each part is measured here, with warm caches,
// on the frame's number of threads. A triangle's occluded blocks are free, as hierarchical depth may reject
// them. If every covered block is drawn, blocks_s grows by the factor covered / won. A backend with tile
// buffers clears each buffer's depths and copies it to the frame: tiles_s then replaces write_s.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <tuple>

#include "edgewise/framebuffer.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::bench {

struct BlockCounts {
  std::uint64_t covered = 0;  // pairs of a block and a triangle that covers a pixel of it
  std::uint64_t won = 0;      // of those, the pairs where it is nearer in a pixel than all earlier triangles
};
BlockCounts count_blocks(std::span<const ScreenTriangle> triangles, int width, int height);

struct FrameCost {
  BlockCounts blocks;
  double read_s = 0, blocks_s = 0, write_s = 0, tiles_s = 0;
};

// Measures block and write times once per thread count and frame size, and keeps them for later frames.
class CostModel {
 public:
  // Overwrites `frame`.
  FrameCost estimate(std::span<const ScreenTriangle> triangles, const BlockCounts& blocks, Framebuffer& frame,
                     int threads);

 private:
  struct Writing {
    double write_s, tiles_s;
  };
  std::map<int, double> block_s_;                         // by threads
  std::map<std::tuple<int, int, int>, Writing> writing_;  // by size and threads
};

}  // namespace edgewise::bench
