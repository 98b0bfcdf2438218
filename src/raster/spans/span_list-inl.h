// A list of the spans of many triangles, and its drawing.
//
// 1. The spans of many triangles are listed first and drawn in one loop: the number of rows per triangle is
//    hard to predict for a branch predictor, but a loop over a list is not. For the same reason, short spans
//    are cut into aligned vectors of pixels.
// 2. Where the long spans of a vector of rows overlap, they form a rectangle, which is drawn at once in
//    blocks. A block stores zmax and rejects occluded triangles as a whole (HiZ, hiz-inl.h). A triangle that
//    is occluded in all blocks is not cut into spans. Blocks cut by a side of the frame occlude nothing.
// 3. Small triangles may arrive as coverage masks (raster/binning/packet_sorter.cpp).
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "edgewise/contract.h"
#include "raster/binning/mask_lists.h"
#include "raster/kernels.h"
#include "raster/simd/hiz-inl.h"
#include "raster/spans/span_rows-inl.h"
#include "raster/tile_store-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_SPAN_LIST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_SPAN_LIST_INL_H
#undef EDGEWISE_SPAN_LIST_INL_H
#else
#define EDGEWISE_SPAN_LIST_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

constexpr int kSpanBlockWidth = 16;  // px; blocks have kRows rows

struct SpanTile {
  // Behind each plane lie pixels that a mask at its end reads and writes back.
  static constexpr int kPixels = (kMaxTile + kMaskSide) * kMaxTile;
  alignas(64) std::int32_t depth[kPixels];  // row by row
  alignas(64) std::int32_t payload[kPixels];
  HiZ<kMaxTile / kSpanBlockWidth, kMaxTile / kRows> hiz;
};

#if HWY_TARGET == HWY_SCALAR

// The scalar target lists no spans.
template <class G>
struct SpanList {
  SpanList(SpanTile&, bool) {}
  void draw() {}
};

#else

template <class G>
class SpanList {
 public:
  SpanList(SpanTile& tile, bool hierarchical_depth) : tile_(tile), uses_hiz_(hierarchical_depth) {}

  HWY_INLINE void add(const SpanBatch<G>& batch, int k) {
    const bool wide = batch.x1[k] - batch.x0[k] > kNarrow;
    if (wide && uses_hiz_ && tile_.hiz.occludes(batch.nearest[k])) return count(Part::hiz);
    count(Part::tile_spans);
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
    std::int32_t *const depth = tile_.depth, *const payload = tile_.payload;  // no store can change these
    const int end = length_;
    for (int n = 0; n < end; ++n) {
      const int k = position_and_depth_[2 * n] >> 16;
      int at = position_and_depth_[2 * n] & 0xFFFF, left = extent_[2 * n] + extent_[2 * n + 1];
      V from = hn::Sub(hn::Iota(d, 0), hn::Set(d, extent_[2 * n]));
      V z = hn::Add(hn::Load(d, in_vector_ + k * kLanes), hn::Set(d, position_and_depth_[2 * n + 1]));
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
  static constexpr int kNarrow = 3 * kLanes;       // px; wider boxes have long spans
  static constexpr int kMostSpans = 4 * kMaxTile;  // per triangle: a narrow box overlaps at most four vectors
  static constexpr int kCapacity = 2 * kMostSpans;

  // Appends a span for each vector of pixels that a row's span overlaps.
  HWY_INLINE void add_narrow(const SpanBatch<G>& batch, int k) {
    RowLanes<G> rows(batch, k, batch.y0[k]);
    for (int y = batch.y0[k];;) {
      for (int x = batch.x0[k] & -kLanes; x < batch.x1[k]; x += kLanes)
        append(batch, k, rows, hn::Max(rows.begin, set32(x)), hn::Min(rows.end, set32(x + kLanes)));
      if ((y += kRows) >= batch.y1[k]) break;
      rows.next();
    }
  }

  // Draws the blocks that all rows' spans cover at once, after the spans of earlier triangles (rule 7).
  HWY_INLINE void add_wide(const SpanBatch<G>& batch, int k) {
    const D32 d32;
    draw();
    const int first_row = batch.y0[k] & -kRows;
    RowLanes<G> rows(batch, k, first_row);
    for (int y = first_row;;) {
      const int last_begin = hn::GetLane(hn::MaxOfLanes(d32, hn::DupOdd(rows.begin)));
      const int first_end = hn::GetLane(hn::MinOfLanes(d32, hn::DupOdd(rows.end)));
      const int begin = (last_begin + kSpanBlockWidth - 1) & -kSpanBlockWidth,
                end = first_end & -kSpanBlockWidth;
      if (begin < end) {
        if (last_begin > 0) append(batch, k, rows, rows.begin, set32(begin));
        if (first_end < kMaxTile) append(batch, k, rows, set32(end), rows.end);
        const V32 zx = set32(batch.depth.x[k]);
        for (int x = begin; x < end; x += kSpanBlockWidth)
          draw_block(batch, k, x, y, hn::GetLane(upper(as64(hn::Add(rows.z, hn::Mul(set32(x), zx))))));
      } else {
        append(batch, k, rows, rows.begin, rows.end);
      }
      if ((y += kRows) >= batch.y1[k]) break;
      rows.next();
    }
  }

  // The triangle covers the whole block, so no depth wraps. `z`: depth at the first pixel.
  HWY_INLINE void draw_block(const SpanBatch<G>& batch, int k, int x, int y, std::int32_t z) {
    const D d;
    const std::int32_t zx = batch.depth.x[k], zy = batch.depth.y[k];
    std::int32_t& hiz = *tile_.hiz.at(x / kSpanBlockWidth, y / kRows);
    if (uses_hiz_ && z + std::min(0, zx * (kSpanBlockWidth - 1)) + std::min(0, zy * (kRows - 1)) >= hiz)
      return;
    V far = hn::Zero(d);
    const V payload = hn::Set(d, batch.payload[k]);
    for (int p = 0; p < kSpanBlockWidth; p += kLanes) {
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

  // Appends the non-empty spans [begin, end) of the rows.
  HWY_INLINE void append(const SpanBatch<G>& batch, int k, const RowLanes<G>& rows, V32 begin, V32 end) {
    const D64 d;
    const V32 length = hn::Sub(end, begin), x = hn::And(begin, set32(-kLanes));
    const auto filled = hn::Gt(as64(length), hn::Set(d, 0xFFFFFFFF));
    const V32 position = hn::Add(hn::Add(hn::ShiftLeft<6>(rows.row), x), set32(k << 16));
    append(position, hn::Add(rows.z, hn::Mul(x, set32(batch.depth.x[k]))), position_and_depth_, filled);
    append(hn::Sub(begin, x), length, extent_, filled);
    length_ += std::popcount(mask_bits(filled));
  }
  // Appends pairs of the lanes' upper halves, `first` in the lower half.
  HWY_INLINE void append(V32 first, V32 second, std::int32_t* list, hn::Mask<D64> mask) {
    const D64 d;
    const V64 pair = as64(hn::OddEven(second, upper(as64(first))));
    hn::StoreU(selected_first(pair, mask), d, reinterpret_cast<std::int64_t*>(list) + length_);
  }

  SpanTile& tile_;
  const bool uses_hiz_;
  int length_ = 0;
  // Two pairs per span. The first describes the aligned vector of pixels in which the span begins: its
  // position in the tile | triangle of the batch << 16, and the depth at its first pixel. The second is the
  // span's first pixel in that vector, and its length, px.
  alignas(64) std::int32_t position_and_depth_[2 * (kCapacity + kRows)], extent_[2 * (kCapacity + kRows)];
  // Per triangle of the batch: depths of a vector relative to its first pixel; step from vector to vector.
  alignas(64) std::int32_t in_vector_[kBatch * kLanes], step_[kBatch * kLanes];
  std::int32_t payload_[kBatch];
};

#endif

// Draws masks up to the first with a rank above `last`, and returns their number.
inline std::size_t draw_masks(SpanTile& tile, std::span<const CoverageMask> masks, std::uint32_t last) {
  const hn::CappedTag<std::int32_t, kMaskSide> d;
  constexpr int kColumns = static_cast<int>(hn::MaxLanes(d)), kBlocks = kMaxTile / 4;
  const auto set = [&](std::uint32_t v) { return hn::Set(d, static_cast<std::int32_t>(v)); };
  std::size_t n = 0;
  for (; n != masks.size() && masks[n].rank <= last; ++n) {
    const CoverageMask& mask = masks[n];
    const std::uint32_t first = (mask.block / kBlocks * kMaxTile + mask.block % kBlocks) * 4;
    for (int column = 0; column < kMaskSide; column += kColumns) {
      const auto px = hn::Iota(d, column), bit = hn::Shl(hn::Set(d, 1), px);
      auto z = hn::Add(set(mask.z), hn::Mul(px, set(mask.zx)));
      std::int32_t* depth = tile.depth + first + column;
      std::int32_t* payload = tile.payload + first + column;
      for (int y = 0; y < kMaskSide; ++y, depth += kMaxTile, payload += kMaxTile) {
        const auto covered = hn::TestBit(set(mask.covered[y / 4] >> (y % 4 * kMaskSide)), bit);
        const auto old_z = hn::LoadU(d, depth);
        const auto wins = hn::And(covered, hn::Lt(z, old_z));
        hn::StoreU(hn::IfThenElse(wins, z, old_z), d, depth);
        hn::StoreU(hn::IfThenElse(wins, set(mask.payload), hn::LoadU(d, payload)), d, payload);
        z = hn::Add(z, set(mask.zy));
      }
    }
  }
  count(Part::masks, n);
  return n;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
