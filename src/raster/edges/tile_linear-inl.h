// Linear functions of the pixel position: the tile kernel's edge functions and depths.
#include <hwy/highway.h>

#include <cstdint>

#include "core/lanes-inl.h"
#include "raster/simd/triangle_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_LINEAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_LINEAR_INL_H
#undef EDGEWISE_TILE_LINEAR_INL_H
#else
#define EDGEWISE_TILE_LINEAR_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

constexpr int kBlockSide = 4;  // px; the kernel draws and rejects in blocks of 4 x 4 px

constexpr std::int32_t wrap(std::uint32_t v) {
  return static_cast<std::int32_t>(v);
}

// Linear functions of the pixel position, one per triangle of a batch.
template <typename Value>
struct Linear {
  Value x[kBatch], y[kBatch];  // steps per pixel
  Value first[kBatch];         // at the first pixel of block (bx0, by0)
  Value most[kBatch];          // the largest value in that block: first + rise
  Value rise[kBatch];          // the largest value in a block less that at its first pixel
  Value range[kBatch];         // the largest value in a block less the smallest
};

// A triangle's box in a tile, extended to whole blocks, so that an edge that accepts it accepts every lane
// that is tested. From the tile's first pixel, px.
struct BlockBox {
  int left, top;
  int last_x, last_y;  // the box's last pixel, from its first
};

inline void set_linear(Linear<std::int32_t>& f, int k, std::int32_t x, std::int32_t y, std::int32_t first) {
  const auto up = [](std::int32_t step) { return step > 0 ? static_cast<std::uint32_t>(step) : 0u; };
  const auto down = [](std::int32_t step) { return step < 0 ? 0u - static_cast<std::uint32_t>(step) : 0u; };
  const std::uint32_t rise = (kBlockSide - 1) * (up(x) + up(y)),
                      fall = (kBlockSide - 1) * (down(x) + down(y));
  f.x[k] = x, f.y[k] = y, f.first[k] = first, f.most[k] = wrap(static_cast<std::uint32_t>(first) + rise);
  f.rise[k] = wrap(rise), f.range[k] = wrap(rise + fall);
}

#if HWY_TARGET != HWY_SCALAR

// Half a vector of triangles, one per 64-bit lane. In V32 only the lower half of each 64-bit lane counts.
struct HalfLinear {
  V32 x, y, first;
};

// BlockBox for half a vector of triangles.
struct BlockBoxLanes {
  V32 left, top, last_x, last_y;
};
HWY_INLINE V both(V32 left, V32 right) {
  return hn::ConcatEven(D{}, right, left);
}

HWY_INLINE V32 thrice(V32 v) {
  static_assert(kBlockSide - 1 == 3);
  return hn::Add(v, hn::Add(v, v));
}

HWY_INLINE void store_linear(const HalfLinear& left, const HalfLinear& right, Linear<std::int32_t>& f,
                             int k) {
  const D d;
  const V x = both(left.x, right.x), y = both(left.y, right.y), first = both(left.first, right.first);
  const V rise = thrice(hn::Add(hn::Max(x, hn::Zero(d)), hn::Max(y, hn::Zero(d))));
  hn::Store(x, d, f.x + k), hn::Store(y, d, f.y + k), hn::Store(first, d, f.first + k);
  hn::Store(rise, d, f.rise + k), hn::Store(hn::Add(first, rise), d, f.most + k);
  hn::Store(thrice(hn::Add(hn::Abs(x), hn::Abs(y))), d, f.range + k);
}

#endif

// Vectors of kLanes values of a linear function, in wrapping int32.
struct Int32Arithmetic {
  using Value = std::int32_t;
  using Vector = V;
  static HWY_INLINE V set(Value v) { return hn::Set(D{}, v); }
  static HWY_INLINE V load(const Value* at) { return hn::Load(D{}, at); }
  static HWY_INLINE void store(V v, Value* at) { hn::Store(v, D{}, at); }
  static HWY_INLINE V add(V a, V b) { return hn::Add(a, b); }
  static HWY_INLINE V subtract(V a, V b) { return hn::Sub(a, b); }
  static HWY_INLINE V times(V count, Value step) { return hn::Mul(count, hn::Set(D{}, step)); }
  static HWY_INLINE V four_times(V v) { return hn::ShiftLeft<2>(v); }
  // The sign bit is set where a value is negative.
  static HWY_INLINE V outside(V e0, V e1, V e2) { return hn::Or(hn::Or(e0, e1), e2); }
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
