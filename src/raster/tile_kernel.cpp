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
static_assert(kMaxBlocks == 16, "a row of blocks is sifted in 16 lanes");

alignas(64) constexpr std::int32_t kLaneX[kBlockPixels] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr std::int32_t kLaneY[kBlockPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) constexpr std::int32_t kColumn[kMaxBlocks] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                          8, 9, 10, 11, 12, 13, 14, 15};

struct Tile {
  alignas(64) std::int32_t depth[kMaxTile * kMaxTile];  // block by block, 16 pixels each
  alignas(64) std::int32_t payload[kMaxTile * kMaxTile];
  alignas(64) std::int32_t farthest[kMaxBlocks * kMaxBlocks];  // no pixel of the block is farther
};

constexpr std::int32_t wrap_add(std::int32_t a, std::int32_t b) {
  return wrap(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
constexpr std::int32_t wrap_mul_add(std::int32_t a, int n, std::int32_t b) {
  return wrap_add(wrap(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(n)), b);
}

// A linear function's values over one block, relative to its first pixel.
struct BlockOffsets {
  V v[kVectors];
  HWY_INLINE explicit BlockOffsets(const Linear& f) {
    const D d;
    for (int i = 0; i < kVectors; ++i)
      v[i] = hn::Add(hn::Mul(hn::Load(d, kLaneX + i * kLanes), hn::Set(d, f.x)),
                     hn::Mul(hn::Load(d, kLaneY + i * kLanes), hn::Set(d, f.y)));
  }
};

// What a triangle means to one tile: an entry of a batch.
struct TileTriangle {
  HWY_INLINE TileTriangle(const Batch& batch, int k)
      : edge{batch.edge[0][k], batch.edge[1][k], batch.edge[2][k]},
        depth(batch.depth[k]),
        nearest(batch.nearest[k]),
        payload(batch.payload[k]),
        bx0(batch.bx0[k]),
        by0(batch.by0[k]),
        bx1(batch.bx1[k]),
        by1(batch.by1[k]) {}
  Linear edge[3], depth, nearest;
  std::int32_t payload;
  int bx0, by0, bx1, by1;
};

// Smallest and largest of a linear function over a block, relative to the block's first pixel.
constexpr std::int32_t block_min(const Linear& f) {
  return std::min(f.x, 0) * (kBlock - 1) + std::min(f.y, 0) * (kBlock - 1);
}
constexpr std::int32_t block_max(const Linear& f) {
  return std::max(f.x, 0) * (kBlock - 1) + std::max(f.y, 0) * (kBlock - 1);
}

HWY_INLINE std::uint32_t mask_bits(hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D{}, mask, bytes);
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

struct BlockRow {
  std::uint32_t touched, inside;  // a bit for each block of the row
};

// Which blocks of a row hold pixels that may be drawn, and which of these lie wholly inside the triangle.
HWY_INLINE BlockRow sift(const Tile& tile, const TileTriangle& t, int by, int blocks_per_row) {
  const D d;
  const auto zero = hn::Zero(d);
  BlockRow row{0, 0};
  for (int first = 0; first < kMaxBlocks; first += kLanes) {
    const auto column = hn::Load(d, kColumn + first);
    const auto at_blocks = [&](const Linear& f, std::int32_t offset) {
      return hn::Add(hn::Set(d, wrap_add(wrap_mul_add(f.y, by * kBlock, f.origin), offset)),
                     hn::Mul(column, hn::Set(d, wrap_mul_add(f.x, kBlock, 0))));
    };
    auto most = zero, least = zero;
    for (const Linear& edge : t.edge) {
      const std::int32_t span = block_max(edge) - block_min(edge);
      const auto high = at_blocks(edge, block_max(edge));
      most = hn::Or(most, high);
      least = hn::Or(least, hn::Sub(high, hn::Set(d, span)));
    }
    const auto nearest = at_blocks(t.nearest, block_min(t.nearest));
    const auto in_front = hn::Lt(nearest, hn::LoadU(d, tile.farthest + by * blocks_per_row + first));
    const auto touched = hn::AndNot(hn::Lt(most, zero), in_front);
    row.touched |= mask_bits(touched) << first;
    row.inside |= mask_bits(hn::AndNot(hn::Lt(least, zero), touched)) << first;
  }
  return row;
}

class Painter {
 public:
  HWY_INLINE Painter(Tile& tile, const TileTriangle& t, int blocks_per_row)
      : tile_(tile),
        t_(t),
        blocks_per_row_(blocks_per_row),
        depth_(t.depth),
        edges_{BlockOffsets(t.edge[0]), BlockOffsets(t.edge[1]), BlockOffsets(t.edge[2])} {}

  HWY_INLINE void draw() {
    // A box of at most 2 x 2 blocks is tested directly; sifting would cost as much.
    const bool small = t_.bx1 - t_.bx0 <= 1 && t_.by1 - t_.by0 <= 1;
    const std::uint32_t columns = (2u << t_.bx1) - (1u << t_.bx0);
    for (int by = t_.by0; by <= t_.by1; ++by) {
      const BlockRow row = small ? BlockRow{columns, 0} : sift(tile_, t_, by, blocks_per_row_);
      for (std::uint32_t left = row.touched & columns; left != 0; left &= left - 1) {
        const int bx = std::countr_zero(left);
        if (row.inside >> bx & 1)
          fill_inside(bx, by);
        else
          fill_crossed(bx, by);
      }
    }
  }

 private:
  HWY_INLINE static V value(const Linear& f, const BlockOffsets& offsets, int bx, int by, int i) {
    return hn::Add(hn::Set(D{}, wrap_mul_add(f.x, bx * kBlock, wrap_mul_add(f.y, by * kBlock, f.origin))),
                   offsets.v[i]);
  }
  HWY_INLINE void write(hn::Mask<D> nearer, V z, V old_z, std::size_t at) {
    const D d;
    const auto payload = hn::Set(d, t_.payload);
    hn::Store(hn::IfThenElse(nearer, z, old_z), d, tile_.depth + at);
    hn::Store(hn::IfThenElse(nearer, payload, hn::Load(d, tile_.payload + at)), d, tile_.payload + at);
  }

  HWY_INLINE void fill_inside(int bx, int by) {
    const D d;
    const auto block = static_cast<std::size_t>(by * blocks_per_row_ + bx);
    for (int i = 0; i < kVectors; ++i) {
      const std::size_t at = block * kBlockPixels + static_cast<std::size_t>(i * kLanes);
      const V z = value(t_.depth, depth_, bx, by, i), old_z = hn::Load(d, tile_.depth + at);
      write(hn::Lt(z, old_z), z, old_z, at);
    }
    const std::int32_t farthest =
        wrap_mul_add(t_.depth.x, bx * kBlock, wrap_mul_add(t_.depth.y, by * kBlock, t_.depth.origin)) +
        block_max(t_.depth);
    tile_.farthest[block] = std::min(tile_.farthest[block], farthest);
  }

  HWY_INLINE void fill_crossed(int bx, int by) {
    const D d;
    const auto block = static_cast<std::size_t>(by * blocks_per_row_ + bx);
    for (int i = 0; i < kVectors; ++i) {
      const std::size_t at = block * kBlockPixels + static_cast<std::size_t>(i * kLanes);
      const V outside =
          hn::Or(hn::Or(value(t_.edge[0], edges_[0], bx, by, i), value(t_.edge[1], edges_[1], bx, by, i)),
                 value(t_.edge[2], edges_[2], bx, by, i));
      const V z = value(t_.depth, depth_, bx, by, i), old_z = hn::Load(d, tile_.depth + at);
      write(hn::AndNot(hn::Lt(outside, hn::Zero(d)), hn::Lt(z, old_z)), z, old_z, at);
    }
  }

  Tile& tile_;
  const TileTriangle& t_;
  const int blocks_per_row_;
  const BlockOffsets depth_;
  const BlockOffsets edges_[3];
};

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
  fill(tile.farthest, kMaxBlocks * kMaxBlocks, kDepthClear);

  // The records lie anywhere: each run's are asked for while the run before it is drawn.
  Batch batch;
  std::span<const std::uint32_t> asked_for;
  const auto draw_run = [&](std::span<const std::uint32_t> run) {
    for (std::uint32_t left = set_up(job, run, batch); left != 0; left &= left - 1)
      Painter(tile, TileTriangle(batch, std::countr_zero(left)), blocks_per_row).draw();
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
