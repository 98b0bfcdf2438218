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
// Where a square of blocks has its members, in the tile, from its first; and which members they are.
alignas(64) constexpr auto kSquareNames = [] {
  struct {
    std::int32_t v[kBlocksAtOnce];
    constexpr const std::int32_t* operator+(int i) const { return v + i; }
  } names{};
  for (int i = 0; i < kBlocksAtOnce; ++i) names.v[i] = (i / 4 * kMaxBlocks + i % 4) << 16 | i;
  return names;
}();
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

#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2
// For each mask, the lanes that it selects, and then any. Highway 1.0.3 has the same table in Compress(), but
// GCC copies it to the stack at every call.
constexpr auto kSelected = [] {
  struct {
    std::uint8_t lane[1 << kLanes][kLanes];
  } table{};
  for (int mask = 0; mask < 1 << kLanes; ++mask) {
    int count = 0;
    for (int lane = 0; lane < kLanes; ++lane)
      if (mask >> lane & 1) table.lane[mask][count++] = static_cast<std::uint8_t>(lane);
  }
  return table;
}();
HWY_INLINE V selected_first(V v, hn::Mask<D> mask) {
  const D d;
  const hn::Rebind<std::uint8_t, D> d8;
  const auto lanes = hn::PromoteTo(d, hn::LoadU(d8, kSelected.lane[mask_bits(mask)]));
  return hn::TableLookupLanes(v, hn::IndicesFromVec(d, lanes));
}
#else
HWY_INLINE V selected_first(V v, hn::Mask<D> mask) {
  return hn::Compress(v, mask);
}
#endif

// A list that a vector's selected lanes are appended to; it needs kLanes to spare.
struct List {
  std::int32_t* at;
  int length = 0;
  HWY_INLINE void append(V v, hn::Mask<D> mask) {
    hn::StoreU(selected_first(v, mask), D{}, at + length);
    length += static_cast<int>(hn::CountTrue(D{}, mask));
  }
};

// Values of a linear function over sixteen pixels, or the same over sixteen blocks.
struct Sixteen {
  V v[kVectors];
};
// Over one block, relative to its first pixel.
HWY_INLINE Sixteen over_block(const std::int32_t* x, const std::int32_t* y) {
  const D d;
  Sixteen out;
  for (int i = 0; i < kVectors; ++i)
    out.v[i] = hn::Add(hn::Mul(hn::Load(d, kLaneX + i * kLanes), hn::Set(d, *x)),
                       hn::Mul(hn::Load(d, kLaneY + i * kLanes), hn::Set(d, *y)));
  return out;
}

// Tests and writes a vector of a block's pixels.
HWY_INLINE void write(Tile& tile, int at, V outside, V z, V payload) {
  const D d;
  const V old_z = hn::Load(d, tile.depth + at);
  const auto wins = hn::AndNot(hn::Lt(outside, hn::Zero(d)), hn::Lt(z, old_z));
  hn::Store(hn::IfThenElse(wins, z, old_z), d, tile.depth + at);
  hn::Store(hn::IfThenElse(wins, payload, hn::Load(d, tile.payload + at)), d, tile.payload + at);
}

// Small triangles, whose boxes are at most 4 x 4 blocks. All blocks of one are sifted at once, and those it
// touches wait in a list that holds many triangles': how many each has is hard for a branch predictor to
// guess, and the loop over the list need not.
class SmallTriangles {
 public:
  static constexpr int kSide = 4;  // blocks
  explicit SmallTriangles(Tile& tile) : tile_(tile) {}

  HWY_INLINE void add(const Batch& batch, int k) {
    const D d;
    if (used_ == kSlots) draw();
    const int slot = used_++ * kBlockPixels;
    const V bx = hn::Set(d, batch.bx1[k] - batch.bx0[k]), by = hn::Set(d, batch.by1[k] - batch.by0[k]);
    const Sixteen in[4] = {over_block(batch.edge[0].x + k, batch.edge[0].y + k),
                           over_block(batch.edge[1].x + k, batch.edge[1].y + k),
                           over_block(batch.edge[2].x + k, batch.edge[2].y + k),
                           over_block(batch.depth.x + k, batch.depth.y + k)};
    const V name = hn::Set(d, (batch.by0[k] * kMaxBlocks + batch.bx0[k]) << 16 | slot);
    for (int p = 0; p < kVectors; ++p) {
      const int lane = p * kLanes;
      V most = hn::Zero(d);
      // Blocks lie in the square as pixels lie in a block, four times as far apart.
      const auto at_block = [&](int i, const std::int32_t* first) {
        const V at = hn::Add(hn::Set(d, *first), hn::ShiftLeft<2>(in[i].v[p]));
        hn::Store(in[i].v[p], d, in_block_[i] + slot + lane);
        hn::Store(at, d, at_block_[i] + slot + lane);
        return at;
      };
      for (int i = 0; i < 3; ++i)
        most = hn::Or(most, hn::Add(at_block(i, batch.edge[i].first + k), hn::Set(d, batch.edge[i].rise[k])));
      at_block(3, batch.depth.first + k);
      const auto beside =
          hn::Or(hn::Gt(hn::Load(d, kLaneX + lane), bx), hn::Gt(hn::Load(d, kLaneY + lane), by));
      const auto touched = hn::Not(hn::Or(beside, hn::Lt(most, hn::Zero(d))));
      const V names = hn::Add(name, hn::Load(d, kSquareNames + lane));
      list_.append(names, touched);
    }
    payload_[slot / kBlockPixels] = batch.payload[k];
  }

  HWY_INLINE void draw() {
    const D d;
    for (int n = 0; n < list_.length; ++n) {
      const int block = list_.at[n] >> 16, place = list_.at[n] & 0xFFFF, slot = place / kBlockPixels;
      for (int p = 0; p < kVectors; ++p) {
        const auto value = [&](int i) {
          return hn::Add(hn::Set(d, at_block_[i][place]),
                         hn::Load(d, in_block_[i] + slot * kBlockPixels + p * kLanes));
        };
        write(tile_, block * kBlockPixels + p * kLanes, hn::Or(hn::Or(value(0), value(1)), value(2)),
              value(3), hn::Set(d, payload_[slot]));
      }
    }
    used_ = list_.length = 0;
  }

 private:
  static constexpr int kSlots = 16;
  Tile& tile_;
  int used_ = 0;
  alignas(64) std::int32_t at_block_[4][kSlots * kBlocksAtOnce], in_block_[4][kSlots * kBlockPixels];
  std::int32_t payload_[kSlots];
  // block << 16 | slot * 16 + the block's place in the square
  std::int32_t touched_[(kSlots + 1) * kBlocksAtOnce];
  List list_{touched_};
};

// Draws entry k of the batch a row of blocks at a time: which are touched, not hidden, is found for all of
// them at once.
HWY_INLINE void draw_rows(Tile& tile, const Batch& batch, int k) {
  const D d;
  const V zero = hn::Zero(d);
  struct Row {
    V v[kVectors], step;
    HWY_INLINE Row(const std::int32_t* x, const std::int32_t* y, const std::int32_t* first) {
      const D di;
      for (int p = 0; p < kVectors; ++p)
        v[p] = hn::Add(hn::Set(di, *first),
                       hn::Mul(hn::Load(di, kIota + p * kLanes), hn::ShiftLeft<2>(hn::Set(di, *x))));
      step = hn::ShiftLeft<2>(hn::Set(di, *y));
    }
    HWY_INLINE void next() {
      for (V& part : v) part = hn::Add(part, step);
    }
  };
  const auto row = [&](const auto& f) { return Row(f.x + k, f.y + k, f.first + k); };
  Row edge[3] = {row(batch.edge[0]), row(batch.edge[1]), row(batch.edge[2])};
  Row depth = row(batch.depth), nearest = row(batch.nearest);
  const auto in_block = [&](const auto& f) { return over_block(f.x + k, f.y + k); };
  const Sixteen edge_in[3] = {in_block(batch.edge[0]), in_block(batch.edge[1]), in_block(batch.edge[2])};
  const Sixteen depth_in = in_block(batch.depth);
  const V payload = hn::Set(d, batch.payload[k]);
  const V last_column = hn::Set(d, batch.bx1[k] - batch.bx0[k]);

  // Values at the first pixels of blocks, and the blocks that are touched, by their places after the first.
  alignas(64) std::int32_t at_edge[3][kMaxBlocks * kMaxBlocks], at_depth[kMaxBlocks * kMaxBlocks];
  std::int32_t touched[kMaxBlocks * kMaxBlocks + kLanes];
  List list{touched};
  const int corner = batch.by0[k] * kMaxBlocks + batch.bx0[k];
  const int end = (batch.by1[k] - batch.by0[k] + 1) * kMaxBlocks;
  for (int start = 0; start < end; start += kMaxBlocks) {
    for (int p = 0; p < kVectors; ++p) {
      const int lane = p * kLanes;
      V most = zero, least = zero;
      for (int i = 0; i < 3; ++i) {
        const V high = hn::Add(edge[i].v[p], hn::Set(d, batch.edge[i].rise[k]));
        most = hn::Or(most, high);
        least = hn::Or(least, hn::Sub(high, hn::Set(d, batch.edge[i].span[k])));
        hn::Store(edge[i].v[p], d, at_edge[i] + start + lane);
      }
      hn::Store(depth.v[p], d, at_depth + start + lane);
      const V column = hn::Load(d, kIota + lane);
      const auto outside = hn::Or(hn::Gt(column, last_column), hn::Lt(most, zero));
      // No pixel of a block that lies inside is farther, from now on, than the triangle's own farthest there.
      std::int32_t* farthest = tile.farthest + corner + start + lane;
      const V old_farthest = hn::LoadU(d, farthest);
      const V own_farthest = hn::Add(depth.v[p], hn::Set(d, batch.depth.rise[k]));
      const auto crossed = hn::Or(outside, hn::Lt(least, zero));
      hn::StoreU(hn::IfThenElse(crossed, old_farthest, hn::Min(old_farthest, own_farthest)), d, farthest);
      const auto seen = hn::AndNot(outside, hn::Lt(nearest.v[p], old_farthest));
      list.append(hn::Add(column, hn::Set(d, start)), seen);
    }
    for (Row& e : edge) e.next();
    depth.next();
    nearest.next();
  }
  for (int n = 0; n < list.length; ++n) {
    const int block = touched[n];
    for (int p = 0; p < kVectors; ++p) {
      const auto value = [&](const std::int32_t* at_block, const Sixteen& in) {
        return hn::Add(hn::Set(d, at_block[block]), in.v[p]);
      };
      const V outside = hn::Or(hn::Or(value(at_edge[0], edge_in[0]), value(at_edge[1], edge_in[1])),
                               value(at_edge[2], edge_in[2]));
      write(tile, (corner + block) * kBlockPixels + p * kLanes, outside, value(at_depth, depth_in), payload);
    }
  }
}

// Blocks back to rows, past the caches where the frame's alignment allows it.
void write_out(const TileJob& job, const std::int32_t* blocks, std::uint32_t* plane) {
  const int width = std::min(1 << job.size_log2, job.frame.width - job.x0);
  const int height = std::min(1 << job.size_log2, job.frame.height - job.y0);
#if HWY_TARGET != HWY_SCALAR
  const bool streams = reinterpret_cast<std::uintptr_t>(plane) % 16 == 0 && job.frame.stride % kBlock == 0;
#endif
  for (int y = 0; y < height; ++y) {
    const std::int32_t* from = blocks + y / kBlock * kMaxBlocks * kBlockPixels + y % kBlock * kBlock;
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
  const int size = 1 << job.size_log2;
  Tile tile;
  const auto fill = [&](std::int32_t* at, int count, std::uint32_t value) {
    for (int i = 0; i < count; i += kLanes) hn::Store(hn::Set(d, wrap(value)), d, at + i);
  };
  for (int y = 0; y < size; y += kBlock) {
    fill(tile.depth + y * kMaxTile, size * kBlock, kDepthClear);
    fill(tile.payload + y * kMaxTile, size * kBlock, job.background);
  }
  fill(tile.farthest, kMaxBlocks * kMaxBlocks + kBlocksAtOnce, kDepthClear);

  // The records lie anywhere: each run's are asked for while the run before it is drawn.
  Batch batch;
  SmallTriangles small(tile);
  std::span<const std::uint32_t> asked_for;
  const auto draw_run = [&](std::span<const std::uint32_t> run) {
    for (std::uint32_t left = set_up(job, run, batch); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      if (std::max(batch.bx1[k] - batch.bx0[k], batch.by1[k] - batch.by0[k]) < SmallTriangles::kSide) {
        small.add(batch, k);
      } else {
        small.draw();
        draw_rows(tile, batch, k);
      }
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
  small.draw();
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
