// Which samples small triangles cover, and what their depth planes are made of: a lane belongs to a triangle,
// and all that is known of it fits 32 bits.
//
// A triangle is small if its box is less than 16 px wide and high, of which at most 8 x 8 lie in the image.
// So steps and distances stay below 2^12 sub-units, and edge values below 2^25.
#include <hwy/highway.h>

#include <bit>
#include <cstdint>

#include "raster/patch_finder.h"
#include "raster/record_lanes-inl.h"

// Included once a SIMD target.
#if defined(EDGEWISE_PATCH_COVERAGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_PATCH_COVERAGE_INL_H
#undef EDGEWISE_PATCH_COVERAGE_INL_H
#else
#define EDGEWISE_PATCH_COVERAGE_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::int32_t kLongest = 1 << 12;  // sub-units, of a small triangle's sides along an axis

// Small triangles that cover a sample, in their order. Vectors may be stored behind the last.
struct Covering {
  static constexpr int kRoom = kBoxesAtOnce + 16;
  int count = 0;
  alignas(64) std::int32_t name[kRoom];           // which of the triangles
  alignas(64) std::int32_t x0[kRoom], y0[kRoom];  // first pixel of the box
  alignas(64) std::int32_t rows[2][kRoom];        // as in Patch, but from the box's first pixel on
  alignas(64) std::int32_t payload[kRoom];
  // depth_lanes-inl.h
  alignas(64) std::int32_t dx1[kRoom], dx2[kRoom], dy1[kRoom], dy2[kRoom], dz1[kRoom], dz2[kRoom];
  alignas(64) std::int32_t area[kRoom], from_x[kRoom], from_y[kRoom], anchor_z[kRoom];
};

HWY_INLINE hn::Mask<D> is_small(const RecordLanes& t, const BoxLanes& box) {
  const D d;
  const V side = hn::Set(d, kPatchSide), longest = hn::Set(d, kLongest);
  // Differences fit (rule 3).
  const auto fits = [&](V begin, V end, const V(&c)[3]) {
    return hn::AndNot(hn::Gt(hn::Sub(end, begin), side), hn::Lt(hn::Sub(most(c), least(c)), longest));
  };
  return hn::And(box.filled, hn::And(fits(box.x0, box.x1, t.x), fits(box.y0, box.y1, t.y)));
}

// Appends those of kLanes triangles that `small` selects and that cover a sample; returns which they are.
HWY_INLINE std::uint32_t append_covering(const RecordLanes& t, const BoxLanes& box, hn::Mask<D> small,
                                         int name, Covering& out) {
  const D d;
  const V zero = hn::Zero(d);
  const auto minus = [](V a, V b) { return hn::Sub(a, b); };
  // Positive area (rule 4).
  V dx1 = minus(t.x[1], t.x[0]), dx2 = minus(t.x[2], t.x[0]);
  V dy1 = minus(t.y[1], t.y[0]), dy2 = minus(t.y[2], t.y[0]);
  const V signed_area = minus(hn::Mul(dx1, dy2), hn::Mul(dy1, dx2));
  const V flip = hn::BroadcastSignBit(signed_area);
  const auto flipped = [&](V v) { return hn::Sub(hn::Xor(v, flip), flip); };
  const V area = flipped(signed_area);
  dx1 = flipped(dx1), dx2 = flipped(dx2), dy1 = flipped(dy1), dy2 = flipped(dy2);

  const V width = minus(box.x1, box.x0), height = minus(box.y1, box.y0);
  const auto sample = [&](V px) { return hn::Add(hn::ShiftLeft<kSubBits>(px), hn::Set(d, kHalf)); };
  const V sx = sample(box.x0), sy = sample(box.y0);
  const V a[3] = {hn::Neg(dy1), minus(dy1, dy2), dy2}, b[3] = {dx1, minus(dx2, dx1), hn::Neg(dx2)};
  V row[3];
  for (int i = 0; i < 3; ++i) {
    const auto top_left = hn::Or(hn::Gt(a[i], zero), hn::And(hn::Eq(a[i], zero), hn::Gt(b[i], zero)));
    const V bias = hn::IfThenZeroElse(top_left, hn::Set(d, -1));
    const V first = hn::Add(hn::Mul(a[i], minus(sx, t.x[i])), hn::Mul(b[i], minus(sy, t.y[i])));
    row[i] = hn::ShiftRight<kSubBits>(hn::Add(first, bias));  // rule 5
  }

  // Bits of samples that are outside; where none of the triangles has a sample, they don't matter.
  const int columns = hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(small, width)));
  const int rows = hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(small, height)));
  const V sign = hn::Set(d, INT32_MIN);
  const hn::RebindToUnsigned<D> du;
  const auto shifted_right = [&](V v, int by) {
    return hn::BitCast(d, hn::ShiftRightSame(hn::BitCast(du, v), by));
  };
  V outside[2] = {zero, zero};
  for (int y = 0; y < rows; ++y) {
    V e0 = row[0], e1 = row[1], e2 = row[2], bits = zero;
    for (int x = 0; x < columns; ++x) {
      bits = hn::Or(hn::BitCast(d, hn::ShiftRight<1>(hn::BitCast(du, bits))),
                    hn::And(hn::Or(hn::Or(e0, e1), e2), sign));
      e0 = hn::Add(e0, a[0]), e1 = hn::Add(e1, a[1]), e2 = hn::Add(e2, a[2]);
    }
    bits = shifted_right(bits, 32 - columns);
    V& half = outside[y / 4];
    half = hn::Or(half, hn::ShiftLeftSame(bits, y % 4 * 8));
    for (int i = 0; i < 3; ++i) row[i] = hn::Add(row[i], b[i]);
  }
  // The box.
  const auto unsigned_of = [&](V v) { return hn::BitCast(du, v); };
  const auto bytes = [&](V v) { return hn::Mul(v, hn::Set(d, 0x01010101)); };
  const V column_bits = bytes(hn::BitCast(d, hn::Set(du, 0xFF) >> unsigned_of(minus(hn::Set(d, 8), width))));
  const auto row_bits = [&](V first_rows) {  // of 0 … 4 rows; shifts of 32 bits are none
    const V left_out = hn::ShiftLeft<3>(minus(hn::Set(d, 4), first_rows));
    const auto half = hn::ShiftRight<1>(left_out);
    return hn::BitCast(d, (hn::Set(du, 0xFFFFFFFF) >> unsigned_of(half)) >> unsigned_of(half));
  };
  const V four = hn::Set(d, 4);
  const V upper_rows = hn::Min(height, four), lower_rows = hn::Sub(height, upper_rows);
  const V inside[2] = {hn::AndNot(outside[0], hn::And(column_bits, row_bits(upper_rows))),
                       hn::AndNot(outside[1], hn::And(column_bits, row_bits(lower_rows)))};
  const auto covers = hn::And(hn::And(small, hn::Gt(area, zero)), hn::Ne(hn::Or(inside[0], inside[1]), zero));

  // The anchor (rule 6).
  V ax = t.x[0], ay = t.y[0], az = t.z[0];
  for (int i = 1; i < 3; ++i) {
    const auto above = hn::Or(hn::Lt(t.y[i], ay), hn::And(hn::Eq(t.y[i], ay), hn::Lt(t.x[i], ax)));
    ax = hn::IfThenElse(above, t.x[i], ax);
    ay = hn::IfThenElse(above, t.y[i], ay);
    az = hn::IfThenElse(above, t.z[i], az);
  }
  const auto cell_sample = [&](V px) { return sample(hn::And(px, hn::Set(d, -kDepthCell))); };
  const std::uint32_t covering = mask_bits(covers);
  const Selection select(covers);
  const int at = out.count;
  const auto keep = [&](V v, std::int32_t* list) { hn::StoreU(select(v), d, list + at); };
  keep(counting_from(name), out.name);
  keep(box.x0, out.x0), keep(box.y0, out.y0);
  keep(inside[0], out.rows[0]), keep(inside[1], out.rows[1]);
  keep(t.payload, out.payload);
  keep(dx1, out.dx1), keep(dx2, out.dx2), keep(dy1, out.dy1), keep(dy2, out.dy2);
  keep(minus(t.z[1], t.z[0]), out.dz1), keep(minus(t.z[2], t.z[0]), out.dz2);
  keep(area, out.area);
  keep(minus(cell_sample(box.x0), ax), out.from_x), keep(minus(cell_sample(box.y0), ay), out.from_y);
  keep(az, out.anchor_z);
  out.count += std::popcount(covering);
  return covering;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

#endif
