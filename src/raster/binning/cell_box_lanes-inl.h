// Converts pixel boxes to cell boxes, in vectors, and finds the candidate cells of boxes up to 2 x 2 cells.
#include <hwy/highway.h>

#include <cstdint>

#include "edgewise/contract.h"
#include "raster/binning/cell_boxes.h"
#include "raster/simd/record_lanes-inl.h"
#include "raster/simd/rule_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_CELL_BOX_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_CELL_BOX_LANES_INL_H
#undef EDGEWISE_CELL_BOX_LANES_INL_H
#else
#define EDGEWISE_CELL_BOX_LANES_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The cells of 2 x 2 cell boxes that no edge rejects: bit column + 2 row. `centre`: the cells' common corner.
//
// An edge rejects a cell if its value is negative in the whole part of the box in that cell. Floats suffice.
// A cell that is kept needlessly does no harm, since the tile kernel tests again. No candidate is rejected:
// factors are exact (rule 3), and where p + q >= 0, p >= -q also holds for the rounded p and q.
// Static, so that callers know which registers it keeps.
static HWY_NOINLINE V candidates_of_four(const RecordLanes& t, V centre_x, V centre_y) {
  const D d;
  const hn::RebindToFloat<D> df;
  using F = hn::Vec<decltype(df)>;
  const auto set = [&](float v) { return hn::Set(df, v); };
  const auto relative = [&](V v, V centre) { return hn::ConvertTo(df, hn::Sub(v, centre)); };
  F x[3], y[3];
  for (int i = 0; i < 3; ++i) x[i] = relative(t.x[i], centre_x), y[i] = relative(t.y[i], centre_y);
  const F left = relative(least(t.x), centre_x), right = relative(most(t.x), centre_x);
  const F top = relative(least(t.y), centre_y), bottom = relative(most(t.y), centre_y);
  const F area = hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])),
                         hn::Mul(hn::Sub(y[1], y[0]), hn::Sub(x[2], x[0])));
  const F flip = hn::And(area, hn::SignBit(df));
  F largest[4];  // per cell, the least of the three edges' largest values
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    const F a = hn::Xor(hn::Sub(y[i], y[j]), flip), b = hn::Xor(hn::Sub(x[j], x[i]), flip);
    const auto rises_x = hn::Gt(a, hn::Zero(df)), rises_y = hn::Gt(b, hn::Zero(df));
    const float half = kHalf;
    const F across[2] = {hn::Mul(a, hn::Sub(hn::IfThenElse(rises_x, set(-half), left), x[i])),
                         hn::Mul(a, hn::Sub(hn::IfThenElse(rises_x, right, set(half)), x[i]))};
    const F down[2] = {hn::Mul(b, hn::Sub(hn::IfThenElse(rises_y, set(-half), top), y[i])),
                       hn::Mul(b, hn::Sub(hn::IfThenElse(rises_y, bottom, set(half)), y[i]))};
    for (int cell = 0; cell < 4; ++cell) {
      const F value = hn::Add(across[cell % 2], down[cell / 2]);
      largest[cell] = i == 0 ? value : hn::Min(largest[cell], value);
    }
  }
  const F zero = hn::Zero(df);
  const auto unsure = hn::Eq(area, zero);  // the orientation is unknown: keep all
  V candidates = hn::Zero(d);
  for (int cell = 0; cell < 4; ++cell) {
    const auto kept = hn::RebindMask(d, hn::Or(unsure, hn::Ge(largest[cell], zero)));
    candidates = hn::Or(candidates, hn::IfThenElseZero(kept, hn::Set(d, 1 << cell)));
  }
  return candidates;
}

// Lanes with an empty box store unspecified values.
HWY_INLINE void store_cell_boxes(const RecordLanes& t, const BoxLanes& box, const CellGrid& grid, int at,
                                 CellBoxes& out) {
  const D d;
  const V one = hn::Set(d, 1);
  const auto column = [&](V x) { return hn::ShiftRightSame(x, grid.cell_w_log2); };
  const auto row = [&](V y) { return hn::ShiftRightSame(y, grid.cell_h_log2); };
  const V column0 = column(box.x0), column1 = column(hn::Sub(box.x1, one));
  const V row0 = row(box.y0), row1 = row(hn::Sub(box.y1, one));
  const auto both = [](V x, V y) { return hn::Or(x, hn::ShiftLeft<16>(y)); };  // 16 bits each
  hn::StoreInterleaved2(both(column0, row0), both(column1, row1), d,
                        reinterpret_cast<std::int32_t*>(out.box + at));

  const V columns = hn::Sub(column1, column0), rows = hn::Sub(row1, row0);  // less one
  const auto wide = hn::Eq(columns, one), high = hn::Eq(rows, one), four = hn::And(wide, high);
  const auto bits = [&](hn::Mask<D> where, int cells) {
    return hn::IfThenElseZero(where, hn::Set(d, cells));
  };
  V candidates = hn::Or(one, hn::Or(bits(wide, 0b0010), bits(high, 0b0100)));
  if (!hn::AllFalse(d, four)) {
    const auto end = [&](V cell, int log2) {
      return hn::ShiftLeft<kSubBits>(hn::ShiftLeftSame(hn::Add(cell, one), log2));
    };
    const V in_four = candidates_of_four(t, end(column0, grid.cell_w_log2), end(row0, grid.cell_h_log2));
    candidates = hn::IfThenElse(four, in_four, candidates);
  }
  const auto large = hn::Gt(hn::Or(columns, rows), one);
  hn::Store(hn::IfThenZeroElse(large, candidates), d, out.candidate_cells + at);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

#endif
