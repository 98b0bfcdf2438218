// The tile kernel.
//
// 1. Depth and payload of the tile live in a buffer of 32 KB that fits the L1 cache. It is written out once,
// past the
//    caches; the frame needs no clear pass.
// 2. The buffer is stored in blocks of 4 x 4 pixels, 16 consecutive integers: one AVX-512 vector, two of
// AVX2, four
//    of SSE4. Four by four wastes fewer lanes on small triangles than 16 x 1.
// 3. Edges are decided for the triangle's whole box in int64 first; one that accepts the box becomes the
// constant 0.
//    The others are stepped in int32 lanes (rule 5).
// 4. A box of several blocks is first sifted a row of blocks at a time: all blocks that an edge rejects, or
// that lie
//    behind the block's farthest depth (hierarchical depth: Greene, Kass and Miller, "Hierarchical Z-buffer
//    visibility", 1993), fall out in one vector operation; blocks wholly inside skip the edge test.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tile_kernel.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "raster/contract.h"
#include "raster/kernel_table.h"
#include "raster/tile_kernel.h"
#include "raster/tile_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

using D = hn::CappedTag<std::int32_t, 16>;
using V = hn::Vec<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D{}));
constexpr int kBlockPixels = 16;
constexpr int kVectors = kBlockPixels / kLanes;  // in a block
constexpr int kMaxBlocks = kMaxTile / kBlock;    // a side of a tile
constexpr int kBlocksAtOnce = 16;  // are sifted together, which as many lanes as they have pixels
static_assert(kBlocksAtOnce == kMaxBlocks && kBlocksAtOnce == kBlockPixels);

alignas(64) constexpr std::int32_t kLaneX[kBlockPixels] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr std::int32_t kLaneY[kBlockPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) constexpr std::int32_t kZeros[kBlocksAtOnce] = {};
alignas(64) constexpr std::int32_t kIota[kBlocksAtOnce] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                           8, 9, 10, 11, 12, 13, 14, 15};

struct Tile {
  alignas(64) std::int32_t depth[kMaxTile * kMaxTile];  // block by block, 16 pixels each
  alignas(64) std::int32_t payload[kMaxTile * kMaxTile];
  alignas(
      64) std::int32_t farthest[kMaxBlocks * kMaxBlocks + kBlocksAtOnce];  // no pixel of the block is farther
};

HWY_INLINE std::uint32_t mask_bits(hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D{}, mask, bytes);
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

// Values of a linear function over one block, relative to its first pixel.
struct BlockOffsets {
  V v[kVectors];
  HWY_INLINE BlockOffsets(const std::int32_t* x, const std::int32_t* y) {
    const D d;
    for (int i = 0; i < kVectors; ++i)
      v[i] = hn::Add(hn::Mul(hn::Load(d, kLaneX + i * kLanes), hn::Set(d, *x)),
                     hn::Mul(hn::Load(d, kLaneY + i * kLanes), hn::Set(d, *y)));
  }
};

// How sixteen blocks lie that are sifted together: a row suits wide triangles, a square small and tall ones.
struct Row {
  static constexpr int kColumns = 16, kRows = 1;
  static constexpr const std::int32_t *kX = kIota, *kY = kZeros;
};
struct Square {
  static constexpr int kColumns = 4, kRows = 4;
  static constexpr const std::int32_t *kX = kLaneX, *kY = kLaneY;
};

// Values of a linear function at the first pixels of sixteen blocks.
template <class Shape>
struct BlockValues {
  V v[kVectors], step;
  HWY_INLINE BlockValues(const std::int32_t* x, const std::int32_t* y, const std::int32_t* first) {
    const D d;
    const V block_x = hn::ShiftLeft<2>(hn::Set(d, *x)), block_y = hn::ShiftLeft<2>(hn::Set(d, *y));
    for (int p = 0; p < kVectors; ++p) {
      v[p] = hn::Add(hn::Set(d, *first), hn::Mul(hn::Load(d, Shape::kX + p * kLanes), block_x));
      if constexpr (Shape::kRows > 1)
        v[p] = hn::Add(v[p], hn::Mul(hn::Load(d, Shape::kY + p * kLanes), block_y));
    }
    step = hn::ShiftLeft<std::countr_zero(static_cast<unsigned>(Shape::kRows))>(block_y);
  }
  HWY_INLINE void next() {
    for (V& part : v) part = hn::Add(part, step);
  }
};

// Draws entry k of the batch, whose box is at most Shape::kColumns blocks wide.
template <class Shape>
HWY_INLINE void paint(Tile& tile, const Batch& batch, int k, int blocks_per_row) {
  const D d;
  const V zero = hn::Zero(d);
  const auto values = [&](const auto& f) { return BlockValues<Shape>(f.x + k, f.y + k, f.first + k); };
  const auto offsets = [&](const auto& f) { return BlockOffsets(f.x + k, f.y + k); };
  BlockValues<Shape> edge[3] = {values(batch.edge[0]), values(batch.edge[1]), values(batch.edge[2])};
  BlockValues<Shape> depth = values(batch.depth), nearest = values(batch.nearest);
  const BlockOffsets edge_in[3] = {offsets(batch.edge[0]), offsets(batch.edge[1]), offsets(batch.edge[2])};
  const BlockOffsets depth_in = offsets(batch.depth);
  const V payload = hn::Set(d, batch.payload[k]);
  const V last_column = hn::Set(d, batch.bx1[k] - batch.bx0[k]);

  for (int by = batch.by0[k]; by <= batch.by1[k]; by += Shape::kRows) {
    alignas(64) std::int32_t at_edge[3][kBlocksAtOnce], at_depth[kBlocksAtOnce];
    const int corner = by * blocks_per_row + batch.bx0[k];
    std::int32_t* farthest = tile.farthest + corner;
    const V last_row = hn::Set(d, batch.by1[k] - by);
    // Which of the blocks may be touched?
    std::uint32_t touched = 0;
    for (int p = 0; p < kVectors; ++p) {
      const int lane = p * kLanes;
      V most = zero, least = zero;
      for (int i = 0; i < 3; ++i) {
        const V high = hn::Add(edge[i].v[p], hn::Set(d, batch.edge[i].rise[k]));
        most = hn::Or(most, high);
        least = hn::Or(least, hn::Sub(high, hn::Set(d, batch.edge[i].span[k])));
        hn::Store(edge[i].v[p], d, at_edge[i] + lane);
      }
      hn::Store(depth.v[p], d, at_depth + lane);
      auto passed_over = hn::Or(hn::Gt(hn::Load(d, Shape::kX + lane), last_column), hn::Lt(most, zero));
      if constexpr (Shape::kRows > 1) {
        passed_over = hn::Or(passed_over, hn::Gt(hn::Load(d, Shape::kY + lane), last_row));
      } else {
        // Hierarchical depth. No pixel of a block that lies inside is farther, from now on, than the
        // triangle's own farthest there.
        const V old_farthest = hn::LoadU(d, farthest + lane);
        const V own_farthest = hn::Add(depth.v[p], hn::Set(d, batch.depth.rise[k]));
        const auto crossed = hn::Or(passed_over, hn::Lt(least, zero));
        hn::StoreU(hn::IfThenElse(crossed, old_farthest, hn::Min(old_farthest, own_farthest)), d,
                   farthest + lane);
        passed_over = hn::Or(passed_over, hn::Not(hn::Lt(nearest.v[p], old_farthest)));
      }
      touched |= mask_bits(hn::Not(passed_over)) << lane;
    }
    for (std::uint32_t left = touched; left != 0; left &= left - 1) {
      const int n = std::countr_zero(left);
      const int block = corner + n / Shape::kColumns * blocks_per_row + n % Shape::kColumns;
      for (int i = 0; i < kVectors; ++i) {
        const auto at = static_cast<std::size_t>(block * kBlockPixels + i * kLanes);
        const auto value = [&](const std::int32_t* at_block, const BlockOffsets& in) {
          return hn::Add(hn::Set(d, at_block[n]), in.v[i]);
        };
        const V outside = hn::Or(hn::Or(value(at_edge[0], edge_in[0]), value(at_edge[1], edge_in[1])),
                                 value(at_edge[2], edge_in[2]));
        const V z = value(at_depth, depth_in), old_z = hn::Load(d, tile.depth + at);
        const auto wins = hn::AndNot(hn::Lt(outside, zero), hn::Lt(z, old_z));
        hn::Store(hn::IfThenElse(wins, z, old_z), d, tile.depth + at);
        hn::Store(hn::IfThenElse(wins, payload, hn::Load(d, tile.payload + at)), d, tile.payload + at);
      }
    }
    for (auto& e : edge) e.next();
    depth.next();
    nearest.next();
  }
}

// Blocks back to rows, past the caches where the frame's alignment allows it.
void write_out(const TileJob& job, const std::int32_t* blocks, std::uint32_t* plane) {
  const int blocks_per_row = (1 << job.size_log2) / kBlock;
  const int width = std::min(1 << job.size_log2, job.frame.width - job.x0);
  const int height = std::min(1 << job.size_log2, job.frame.height - job.y0);
#if HWY_TARGET != HWY_SCALAR
  const bool streams = reinterpret_cast<std::uintptr_t>(plane) % 16 == 0 && job.frame.stride % kBlock == 0;
#endif
  for (int y = 0; y < height; ++y) {
    const std::int32_t* from = blocks + (y / kBlock * blocks_per_row) * kBlockPixels + y % kBlock * kBlock;
    auto* to = reinterpret_cast<std::int32_t*>(plane + (job.y0 + y) * job.frame.stride + job.x0);
    int x = 0;
#if HWY_TARGET != HWY_SCALAR
    const hn::Full128<std::int32_t> d;
    if (streams)
      for (; x + kBlock <= width; x += kBlock, from += kBlockPixels) hn::Stream(hn::Load(d, from), d, to + x);
#endif
    for (; x < width; x += kBlock, from += kBlockPixels)
      std::memcpy(to + x, from, sizeof(std::int32_t) * static_cast<std::size_t>(std::min(kBlock, width - x)));
  }
}

// Where a tile has no triangle, GCC 12 forgets this instruction between the clear and the return. The
// caller's code is SSE, and writes to registers whose upper halves are in use merge: it would run at half
// speed, until the next context switch.
HWY_INLINE void clear_upper_halves() {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2  // the better the target, the lower its number
  _mm256_zeroupper();
#endif
}

void draw_tile(const TileJob& job) {
  const D d;
  const int size = 1 << job.size_log2, blocks_per_row = size / kBlock;
  Tile tile;
  const auto fill = [&](std::int32_t* at, int count, std::uint32_t value) {
    for (int i = 0; i < count; i += kLanes) hn::Store(hn::Set(d, wrap(value)), d, at + i);
  };
  fill(tile.depth, size * size, kDepthClear);
  fill(tile.payload, size * size, job.background);
  fill(tile.farthest, kMaxBlocks * kMaxBlocks + kBlocksAtOnce, kDepthClear);

  // The records lie anywhere: each run's are asked for while the run before it is drawn.
  Batch batch;
  std::span<const std::uint32_t> asked_for;
  const auto draw_run = [&](std::span<const std::uint32_t> run) {
    for (std::uint32_t left = set_up(job, run, batch); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      if (std::max(batch.bx1[k] - batch.bx0[k], batch.by1[k] - batch.by0[k]) < Square::kRows)
        paint<Square>(tile, batch, k, blocks_per_row);
      else
        paint<Row>(tile, batch, k, blocks_per_row);
    }
  };
  job.bins->for_each_run(job.cell, [&](std::span<const std::uint32_t> run) {
    for (const std::uint32_t index : run) {
      const auto* record = reinterpret_cast<const char*>(job.triangles + index);
      hwy::Prefetch(record);
      hwy::Prefetch(record + sizeof(ScreenTriangle) - 1);
    }
    if (!asked_for.empty()) draw_run(asked_for);
    asked_for = run;
  });
  if (!asked_for.empty()) draw_run(asked_for);
  write_out(job, tile.depth, job.frame.depth);
  write_out(job, tile.payload, job.frame.payload);
  hwy::FlushStream();
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

TileKernel tile_kernel(SimdTarget target) {
  return EDGEWISE_KERNEL(draw_tile, target);
}

}  // namespace edgewise
#endif
