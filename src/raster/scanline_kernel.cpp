// The scanline kernel.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/scanline_kernel.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "raster/contract.h"
#include "raster/kernel_table.h"
#include "raster/scanline_kernel.h"
#include "raster/scanline_setup-inl.h"
#include "raster/scanline_walk.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

namespace {  // the other kernel has a Tile, too

using D = hn::CappedTag<std::int32_t, 16>;
using V = hn::Vec<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D{}));

constexpr int kRows = static_cast<int>(hn::MaxLanes(hn::CappedTag<std::int64_t, 8>{}));  // set up together
constexpr int kBlock = 16;  // px of kRows rows, which hierarchical depth rejects together

struct Tile {
  alignas(64) std::int32_t depth[kMaxTile * kMaxTile];  // row by row
  alignas(64) std::int32_t payload[kMaxTile * kMaxTile];
  std::int32_t farthest[kMaxTile / kRows][kMaxTile / kBlock];  // no pixel of the block is farther
};

#if HWY_TARGET != HWY_SCALAR

constexpr int kRowsLog2 = std::countr_zero(static_cast<unsigned>(kRows));

// The selected 64-bit lanes, and then any. Highway 1.0.3 can do that, but with a table that GCC copies to the
// stack at every call, except for 32-bit lanes under AVX-512.
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE V64 selected_first(V64 v, hn::Mask<D64> mask) {
  const V32 both_halves = hn::DupOdd(lower(hn::VecFromMask(D64{}, mask)));
  return as64(hn::Compress(lower(v), hn::MaskFromVec(both_halves)));
}
#else
constexpr auto kSelected = [] {
  struct {
    std::uint8_t half[1 << kRows][2 * kRows];
  } table{};
  for (int mask = 0; mask < 1 << kRows; ++mask) {
    int count = 0;
    for (int lane = 0; lane < kRows; ++lane)
      if (mask >> lane & 1)
        for (const int half : {2 * lane, 2 * lane + 1}) table.half[mask][count++] = static_cast<std::uint8_t>(half);
  }
  return table;
}();
HWY_INLINE V64 selected_first(V64 v, hn::Mask<D64> mask) {
  const D32 d;
  const hn::Rebind<std::uint8_t, D32> d8;
  const V32 halves = hn::PromoteTo(d, hn::LoadU(d8, kSelected.half[mask_bits(mask)]));
  return as64(hn::TableLookupLanes(lower(v), hn::IndicesFromVec(d, halves)));
}
#endif

// Where the spans of entry k begin and end, kRows rows at a time: a lane is a row, in its upper half.
class RowLanes {
 public:
  HWY_INLINE RowLanes(const SpanBatch& batch, int k, int first_row)
      : zy_(set32(batch.depth.y[k])), first_row_(set32(batch.y0[k])), rows_(set32(batch.y1[k] - batch.y0[k])) {
    const D64 d;
    const V64 lane = hn::Add(hn::Iota(d, 0), hn::Set(d, first_row - batch.y0[k]));
    for (int i = 0; i < 3; ++i) {
      const auto& line = batch.line[i];
      const V64 step = hn::Set(d, line.step[k]);
      at_[i] = hn::Add(hn::Set(d, line.at[k]), product(step, lower(lane)));
      stride_[i] = hn::ShiftLeft<kRowsLog2>(step);
      is_left_[i] = set32(line.is_left[k]), is_right_[i] = set32(line.is_right[k]);
    }
    const V32 from_first = lower(hn::ShiftLeft<32>(lane));
    row = hn::Add(first_row_, from_first);
    z = hn::Add(set32(batch.depth.first[k]), hn::Mul(zy_, from_first));
    find_ends();
  }
  HWY_INLINE void next() {
    for (int i = 0; i < 3; ++i) at_[i] = hn::Add(at_[i], stride_[i]);
    row = hn::Add(row, set32(kRows));
    z = hn::Add(z, hn::ShiftLeft<kRowsLog2>(zy_));
    find_ends();
  }
  V32 row, z;      // in the tile; at the row's first pixel
  V32 begin, end;  // in the tile; end = 0 for rows that are not the triangle's

 private:
  HWY_INLINE void find_ends() {
    const V32 size = set32(kMaxTile);
    begin = hn::Zero(D32{}), end = size;
    for (int i = 0; i < 3; ++i) {
      const V32 pixel = hn::ShiftRight<kUnitBits - 32>(lower(at_[i]));
      begin = hn::Max(begin, hn::And(pixel, is_left_[i]));
      end = hn::Min(end, hn::IfVecThenElse(is_right_[i], pixel, size));
    }
    const V32 from_first = hn::Sub(row, first_row_);
    end = hn::IfThenElseZero(hn::And(hn::Gt(from_first, set32(-1)), hn::Lt(from_first, rows_)), end);
  }
  V64 at_[3], stride_[3];
  V32 is_left_[3], is_right_[3], zy_, first_row_, rows_;
};

// The spans of many triangles. How many rows a triangle has is hard for a branch predictor to guess, and the
// loop over the list need not.
class SpanList {
 public:
  explicit SpanList(Tile& tile) : tile_(tile) {}

  HWY_INLINE void add(const SpanBatch& batch, int k) {
    if (length_ > kCapacity - kMostSpans) draw();
    const D d;
    const V zx = hn::Set(d, batch.depth.x[k]);
    hn::Store(hn::Mul(hn::Iota(d, 0), zx), d, in_vector_ + k * kLanes);
    hn::Store(hn::Mul(hn::Set(d, kLanes), zx), d, step_ + k * kLanes);
    payload_[k] = batch.payload[k];
    if (batch.x1[k] - batch.x0[k] > kNarrow)
      add_wide(batch, k);
    else
      add_narrow(batch, k);
  }

  HWY_INLINE void draw() {
    const D d;
    const hn::RebindToUnsigned<D> du;
    std::int32_t *const depth = tile_.depth, *const payload = tile_.payload;  // stores cannot change these
    const int end = length_;
    for (int n = 0; n < end; ++n) {
      const int k = where_[2 * n] >> 16;
      int at = where_[2 * n] & 0xFFFF, left = extent_[2 * n] + extent_[2 * n + 1];
      V from = hn::Sub(hn::Iota(d, 0), hn::Set(d, extent_[2 * n]));
      V z = hn::Add(hn::Load(d, in_vector_ + k * kLanes), hn::Set(d, where_[2 * n + 1]));
      const auto length = hn::Set(du, static_cast<std::uint32_t>(extent_[2 * n + 1]));
      for (;;) {
        const V old_z = hn::Load(d, depth + at);
        const auto inside = hn::RebindMask(d, hn::Lt(hn::BitCast(du, from), length));
        const auto wins = hn::And(inside, hn::Lt(z, old_z));
        hn::Store(hn::IfThenElse(wins, z, old_z), d, depth + at);
        hn::Store(hn::IfThenElse(wins, hn::Set(d, payload_[k]), hn::Load(d, payload + at)), d, payload + at);
        if ((left -= kLanes) <= 0) break;
        at += kLanes;
        from = hn::Add(from, hn::Set(d, kLanes));
        z = hn::Add(z, hn::Load(d, step_ + k * kLanes));
      }
    }
    length_ = 0;
  }

 private:
  static constexpr int kNarrow = 3 * kLanes;           // px; wider boxes hold long spans
  static constexpr int kMostSpans = kMaxTile * kMaxTile / kLanes;  // of one triangle
  static constexpr int kCapacity = 2 * kMostSpans;

  // Spans are cut into vectors: how many a span needs is hard to guess, too.
  HWY_INLINE void add_narrow(const SpanBatch& batch, int k) {
    RowLanes rows(batch, k, batch.y0[k]);
    for (int y = batch.y0[k];;) {
      for (int x = batch.x0[k] & -kLanes; x < batch.x1[k]; x += kLanes)
        append(batch, k, rows, hn::Max(rows.begin, set32(x)), hn::Min(rows.end, set32(x + kLanes)));
      if ((y += kRows) >= batch.y1[k]) break;
      rows.next();
    }
  }

  // Where all rows' spans overlap, blocks are drawn at once, after those before.
  HWY_INLINE void add_wide(const SpanBatch& batch, int k) {
    const D32 d32;
    draw();
    const int first_row = batch.y0[k] & -kRows;
    RowLanes rows(batch, k, first_row);
    for (int y = first_row;;) {
      const int last_begin = hn::GetLane(hn::MaxOfLanes(d32, hn::DupOdd(rows.begin)));
      const int first_end = hn::GetLane(hn::MinOfLanes(d32, hn::DupOdd(rows.end)));
      const int begin = (last_begin + kBlock - 1) & -kBlock, end = first_end & -kBlock;
      if (begin < end) {
        if (last_begin > 0) append(batch, k, rows, rows.begin, set32(begin));
        if (first_end < kMaxTile) append(batch, k, rows, set32(end), rows.end);
        const auto z = hn::GetLane(upper(as64(rows.z)));
        for (int x = begin; x < end; x += kBlock) draw_block(batch, k, x, y, z + x * batch.depth.x[k]);
      } else {
        append(batch, k, rows, rows.begin, rows.end);
      }
      if ((y += kRows) >= batch.y1[k]) break;
      rows.next();
    }
  }

  // All pixels of a block are the triangle's; z is the depth at the first.
  HWY_INLINE void draw_block(const SpanBatch& batch, int k, int x, int y, std::int32_t z) {
    const D d;
    const std::int32_t zx = batch.depth.x[k], zy = batch.depth.y[k];
    std::int32_t& farthest = tile_.farthest[y / kRows][x / kBlock];
    if (z + std::min(0, zx * (kBlock - 1)) + std::min(0, zy * (kRows - 1)) >= farthest) return;
    V far = hn::Zero(d);
    const V payload = hn::Set(d, batch.payload[k]);
    for (int p = 0; p < kBlock; p += kLanes) {
      V z_here = hn::Add(hn::Set(d, z + p * zx), hn::Load(d, in_vector_ + k * kLanes));
      for (int r = 0; r < kRows; ++r) {
        const int at = (y + r) * kMaxTile + x + p;
        const V old_z = hn::Load(d, tile_.depth + at), new_z = hn::Min(z_here, old_z);
        const auto wins = hn::Lt(z_here, old_z);
        hn::Store(new_z, d, tile_.depth + at);
        hn::Store(hn::IfThenElse(wins, payload, hn::Load(d, tile_.payload + at)), d, tile_.payload + at);
        far = hn::Max(far, new_z);
        z_here = hn::Add(z_here, hn::Set(d, zy));
      }
    }
    farthest = hn::GetLane(hn::MaxOfLanes(d, far));
  }

  // Appends the rows' spans [begin, end) that are not empty.
  HWY_INLINE void append(const SpanBatch& batch, int k, const RowLanes& rows, V32 begin, V32 end) {
    const D64 d;
    const V32 length = hn::Sub(end, begin), x = hn::And(begin, set32(-kLanes));
    const auto filled = hn::Gt(as64(length), hn::Set(d, 0xFFFFFFFF));
    const V32 place = hn::Add(hn::Add(hn::ShiftLeft<6>(rows.row), x), set32(k << 16));
    append(place, hn::Add(rows.z, hn::Mul(x, set32(batch.depth.x[k]))), where_, filled);
    append(hn::Sub(begin, x), length, extent_, filled);
    length_ += std::popcount(mask_bits(filled));
  }
  // Pairs of the upper halves, `first` below.
  HWY_INLINE void append(V32 first, V32 second, std::int32_t* list, hn::Mask<D64> mask) {
    const D64 d;
    const V64 pair = as64(hn::OddEven(second, upper(as64(first))));
    hn::StoreU(selected_first(pair, mask), d, reinterpret_cast<std::int64_t*>(list) + length_);
  }

  Tile& tile_;
  int length_ = 0;
  // For each vector: its place in the tile | triangle << 16, and the depth at its first pixel; the first
  // pixel of the span, counted from there, and the span's length.
  alignas(64) std::int32_t where_[2 * (kCapacity + kRows)], extent_[2 * (kCapacity + kRows)];
  alignas(64) std::int32_t in_vector_[SpanBatch::kSize * kLanes], step_[SpanBatch::kSize * kLanes];  // depth from a vector's first pixel
  std::int32_t payload_[SpanBatch::kSize];
};

void draw_run(const TileJob& job, std::span<const std::uint32_t> run, Tile& tile, SpanList& list) {
  SpanBatch batch;
  const Alive alive = set_up(job, run, batch);
  for (std::uint32_t left = alive.all; left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    if (alive.plain >> k & 1) {
      list.draw();
      walk_triangle(job, job.triangles[run[static_cast<std::size_t>(k)]], tile.depth, tile.payload);
    } else {
      list.add(batch, k);
    }
  }
  list.draw();
}

#endif

// Past the caches where the frame's alignment allows it.
void write_out(const TileJob& job, const std::int32_t* rows, std::uint32_t* plane) {
  const D d;
  const int width = std::min(kMaxTile, job.frame.width - job.x0);
  const int height = std::min(kMaxTile, job.frame.height - job.y0);
  constexpr std::size_t kVectorBytes = sizeof(std::int32_t) * kLanes;
  const bool streams = reinterpret_cast<std::uintptr_t>(plane) % kVectorBytes == 0 && job.frame.stride % kLanes == 0;
  for (int y = 0; y < height; ++y) {
    const std::int32_t* from = rows + y * kMaxTile;
    auto* to = reinterpret_cast<std::int32_t*>(plane + (job.y0 + y) * job.frame.stride + job.x0);
    int x = 0;
    if (streams)
      for (; x + kLanes <= width; x += kLanes) hn::Stream(hn::Load(d, from + x), d, to + x);
    std::memcpy(to + x, from + x, sizeof(std::int32_t) * static_cast<std::size_t>(width - x));
  }
}

// As in tile_kernel.cpp.
HWY_INLINE void clear_upper_halves() {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2  // the better the target, the lower its number
  _mm256_zeroupper();
#endif
}

}  // namespace

void draw_tile_in_spans(const TileJob& job) {
  Tile tile;
  std::fill_n(tile.depth, kMaxTile * kMaxTile, static_cast<std::int32_t>(kDepthClear));
  std::fill_n(&tile.farthest[0][0], sizeof tile.farthest / sizeof(std::int32_t), static_cast<std::int32_t>(kDepthClear));
  std::fill_n(tile.payload, kMaxTile * kMaxTile, static_cast<std::int32_t>(job.background));

  // The records lie anywhere: each run's are asked for while the run before it is drawn.
  std::span<const std::uint32_t> asked_for;
#if HWY_TARGET == HWY_SCALAR
  const auto draw = [&] {
    for (const std::uint32_t index : asked_for)
      walk_triangle(job, job.triangles[index], tile.depth, tile.payload);
  };
#else
  SpanList list(tile);
  const auto draw = [&] {
    if (!asked_for.empty()) draw_run(job, asked_for, tile, list);
  };
#endif
  job.bins->for_each_run(job.cell, [&](std::span<const std::uint32_t> run) {
    for (const std::uint32_t index : run) {
      const auto* record = reinterpret_cast<const char*>(job.triangles + index);
      hwy::Prefetch(record);
      hwy::Prefetch(record + sizeof(ScreenTriangle) - 1);
    }
    draw();
    asked_for = run;
  });
  draw();
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

TileKernel scanline_kernel(SimdTarget target) {
  return EDGEWISE_KERNEL(draw_tile_in_spans, target);
}

}  // namespace edgewise
#endif
