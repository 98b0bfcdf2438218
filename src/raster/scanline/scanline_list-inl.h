// The spans of many triangles, waiting to be drawn.
//
// 1. Spans are listed first and drawn later, many triangles' together: how many rows a triangle has is hard
//    for a branch predictor to guess, and the loop over the list need not. Short spans are cut into aligned
//    vectors of pixels, since how many of those a span needs is hard to guess, too.
// 2. Where the long spans of a vector of rows overlap, they are a rectangle, drawn at once in blocks. A block
//    keeps the depth of its farthest pixel and rejects what lies behind as a whole (hierarchical depth,
//    hiz-inl.h); what lies behind all blocks has no spans. Blocks that a side of the frame cuts hide
//    nothing.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "edgewise/contract.h"
#include "raster/scanline/scanline_rows-inl.h"
#include "raster/simd/hiz-inl.h"
#include "raster/simd/tile_store-inl.h"

// Included once a SIMD target.
#if defined(EDGEWISE_SCANLINE_LIST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_SCANLINE_LIST_INL_H
#undef EDGEWISE_SCANLINE_LIST_INL_H
#else
#define EDGEWISE_SCANLINE_LIST_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

constexpr int kBlock = 16;  // px, of kRows rows

struct SpanTile {
  alignas(64) std::int32_t depth[kMaxTile * kMaxTile];  // row by row
  alignas(64) std::int32_t payload[kMaxTile * kMaxTile];
  HiZ<kMaxTile / kBlock, kMaxTile / kRows> hiz;
};

constexpr std::int32_t wrapped_product(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}

class SpanList {
 public:
  explicit SpanList(SpanTile& tile) : tile_(tile) {}

  HWY_INLINE void add(const SpanBatch& batch, int k) {
    const bool wide = batch.x1[k] - batch.x0[k] > kNarrow;
    if (wide && tile_.hiz.occludes(batch.nearest[k])) return;
    if (length_ > kCapacity - kMostSpans) draw();
    const D d;
    const V zx = hn::Set(d, batch.depth.x[k]);
    hn::Store(hn::Mul(hn::Iota(d, 0), zx), d, in_vector_ + k * kLanes);
    hn::Store(hn::Mul(hn::Set(d, kLanes), zx), d, step_ + k * kLanes);
    payload_[k] = batch.payload[k];
    wide ? add_wide(batch, k) : add_narrow(batch, k);
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
  static constexpr int kNarrow = 3 * kLanes;       // px; wider boxes hold long spans
  static constexpr int kMostSpans = 4 * kMaxTile;  // of one triangle: a narrow box lies in four vectors
  static constexpr int kCapacity = 2 * kMostSpans;

  // One listed span for each vector that a span lies in.
  HWY_INLINE void add_narrow(const SpanBatch& batch, int k) {
    RowLanes rows(batch, k, batch.y0[k]);
    for (int y = batch.y0[k];;) {
      for (int x = batch.x0[k] & -kLanes; x < batch.x1[k]; x += kLanes)
        append(batch, k, rows, hn::Max(rows.begin, set32(x)), hn::Min(rows.end, set32(x + kLanes)));
      if ((y += kRows) >= batch.y1[k]) break;
      rows.next();
    }
  }

  // Where all rows' spans overlap, blocks are drawn at once, after the triangles before this one.
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
        for (int x = begin; x < end; x += kBlock) {
          const V32 z = hn::Add(rows.z, set32(wrapped_product(x, batch.depth.x[k])));
          draw_block(batch, k, x, y, hn::GetLane(upper(as64(z))));
        }
      } else {
        append(batch, k, rows, rows.begin, rows.end);
      }
      if ((y += kRows) >= batch.y1[k]) break;
      rows.next();
    }
  }

  // All pixels of a block are the triangle's, so nothing wraps here; z is the depth at the first.
  HWY_INLINE void draw_block(const SpanBatch& batch, int k, int x, int y, std::int32_t z) {
    const D d;
    const std::int32_t zx = batch.depth.x[k], zy = batch.depth.y[k];
    std::int32_t& hiz = *tile_.hiz.at(x / kBlock, y / kRows);
    if (z + std::min(0, zx * (kBlock - 1)) + std::min(0, zy * (kRows - 1)) >= hiz) return;
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
    hiz = hn::GetLane(hn::MaxOfLanes(d, far));
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

  SpanTile& tile_;
  int length_ = 0;
  // Of each span: the place in the tile of the vector that it begins in | entry << 16, and the depth at that
  // vector's first pixel; how far from there it begins, and its length in pixels.
  alignas(64) std::int32_t where_[2 * (kCapacity + kRows)], extent_[2 * (kCapacity + kRows)];
  // Of each entry: depth from a vector's first pixel, and from vector to vector.
  alignas(64) std::int32_t in_vector_[SpanBatch::kSize * kLanes], step_[SpanBatch::kSize * kLanes];
  std::int32_t payload_[SpanBatch::kSize];
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

#endif
