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

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

using D = hn::CappedTag<std::int32_t, 16>;
using V = hn::Vec<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D{}));
constexpr int kBlock = 4;  // px a side
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

// A linear function of the pixel's place in the tile, in wrapping int32: a shifted edge value or a depth.
struct Linear {
  std::int32_t x, y;    // step a pixel
  std::int32_t origin;  // at the tile's first pixel
};

constexpr std::int32_t wrap(std::uint32_t v) {
  return static_cast<std::int32_t>(v);
}
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

// What a triangle means to one tile.
struct TileTriangle {
  Linear edge[3];  // inside where all are >= 0
  Linear depth;
  Linear nearest;  // a bound for hierarchical depth: no pixel of the triangle is nearer (see below)
  std::int32_t payload;
  int bx0, by0, bx1, by1;  // blocks it may touch, inclusive
};

// False if the triangle touches no pixel of the tile.
HWY_INLINE bool set_up(const TileJob& job, const ScreenTriangle& triangle, TileTriangle& out) {
  const int size = 1 << job.size_log2;
  const PixelBox box = pixel_box(triangle, job.frame.width, job.frame.height);
  const int x0 = std::max(box.x0 - job.x0, 0), x1 = std::min(box.x1 - job.x0, size);
  const int y0 = std::max(box.y0 - job.y0, 0), y1 = std::min(box.y1 - job.y0, size);
  if (x0 >= x1 || y0 >= y1) return false;
  const Oriented t = orient(triangle);
  if (t.area == 0) return false;
  out.bx0 = x0 / kBlock, out.bx1 = (x1 - 1) / kBlock;
  out.by0 = y0 / kBlock, out.by1 = (y1 - 1) / kBlock;

  // The box in whole blocks, so that an edge that accepts it accepts every lane that will be tested.
  const int left = out.bx0 * kBlock, top = out.by0 * kBlock;
  const std::int64_t last_x = (out.bx1 - out.bx0 + 1) * kBlock - 1,
                     last_y = (out.by1 - out.by0 + 1) * kBlock - 1;
  for (int i = 0; i < 3; ++i) {
    const Edge edge = make_edge(t, i);
    const std::int64_t first = edge.at(job.x0 + left, job.y0 + top);
    const std::int64_t across = std::int64_t{edge.a} * kSub * last_x,
                       down = std::int64_t{edge.b} * kSub * last_y;
    if (first + std::max<std::int64_t>(across, 0) + std::max<std::int64_t>(down, 0) < 0) return false;
    if (first + std::min<std::int64_t>(across, 0) + std::min<std::int64_t>(down, 0) >= 0)
      out.edge[i] = {0, 0, 0};
    else
      out.edge[i] = {edge.a, edge.b,
                     static_cast<std::int32_t>((first >> kSubBits) - std::int64_t{edge.a} * left -
                                               std::int64_t{edge.b} * top)};
  }

  const DepthPlane plane = make_depth(t);
  out.depth = {wrap(plane.zx), wrap(plane.zy), wrap(plane.at(job.x0, job.y0))};
  out.payload = wrap(triangle.payload);
  // Below 2^24 a step, the plane over a tile stays within 2^31 of the triangle's depths, so a wrapped value
  // is negative and passes as near: the bound may be the plane itself. Steeper planes fall back to the
  // nearest vertex.
  constexpr std::int32_t kSteep = 1 << 24;
  const bool flat =
      std::max(std::abs(std::int64_t{out.depth.x}), std::abs(std::int64_t{out.depth.y})) < kSteep;
  const std::int64_t nearest = std::min({t.z[0], t.z[1], t.z[2]}) - kDepthError;
  out.nearest = flat ? out.depth : Linear{0, 0, static_cast<std::int32_t>(nearest)};
  return true;
}

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

  job.bins->for_each_run(job.cell, [&](std::span<const std::uint32_t> run) {
    // The records lie anywhere; ask for them before they are needed.
    constexpr std::size_t kAhead = 6;
    const auto prefetch = [&](std::size_t i) {
      const auto* record = reinterpret_cast<const char*>(job.triangles + run[i]);
      hwy::Prefetch(record);
      hwy::Prefetch(record + sizeof(ScreenTriangle) - 1);
    };
    for (std::size_t i = 0; i < std::min(kAhead, run.size()); ++i) prefetch(i);
    for (std::size_t i = 0; i < run.size(); ++i) {
      if (i + kAhead < run.size()) prefetch(i + kAhead);
      TileTriangle triangle;
      if (set_up(job, job.triangles[run[i]], triangle)) Painter(tile, triangle, blocks_per_row).draw();
    }
  });
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
