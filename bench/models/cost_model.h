// A cost model of a frame on this machine, no lower bound: work that runs side by side undercuts it. It is
// the sum of
//   - reading each triangle's record once,
//   - testing and writing each block of 4 x 4 pixels once for each triangle that wins a pixel of it, out of
//     the L1 cache and with vectors of the best target,
//   - writing depth and payload of the frame once, by cached or streaming stores, whichever is faster,
// each measured here, warm, on as many threads. A triangle's hidden blocks are free, as hierarchical depth
// may reject them. With every covered block drawn, blocks_s grows by covered / won. A backend that draws into
// tile buffers clears each buffer's depths and copies it to the frame: it has tiles_s instead of write_s.
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
  std::uint64_t won = 0;      // those where it is, at its turn, nearer than all before it in a pixel
};
BlockCounts count_blocks(std::span<const ScreenTriangle> triangles, int width, int height);

struct FrameCost {
  BlockCounts blocks;
  double read_s = 0, blocks_s = 0, write_s = 0, tiles_s = 0;
  double total_s() const { return read_s + blocks_s + write_s; }
  double in_tiles_s() const { return read_s + blocks_s + tiles_s; }
};

// Measures, and remembers what other frames need too.
class CostModel {
 public:
  // `frame` is overwritten.
  FrameCost under(std::span<const ScreenTriangle> triangles, const BlockCounts& blocks, Framebuffer& frame,
                  int threads);

 private:
  struct Writing {
    double write_s, tiles_s;
  };
  std::map<int, double> block_s_;                         // by threads
  std::map<std::tuple<int, int, int>, Writing> writing_;  // by size and threads
};

}  // namespace edgewise::bench
