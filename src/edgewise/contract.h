// The numeric contract. This file states each rule once, with its derivation. Other files cite rules by
// number.
//
// Backends compute with integers. Integer addition stays associative even when it wraps, so a backend may
// step, tile, vectorise or thread in any order and still write the same bits. Floats end in the front end. A
// backend may use floats only where it shows that rounding cannot change a decision.
//
// The z3 solver proves the claims about all inputs: tests/proofs, run by scripts/prove.
//
// Sources: fill rule, snapping and sample positions follow the D3D11.3 functional specification, section 3.4
// (rasterization rules); edge functions are those of Pineda, "A Parallel Algorithm for Polygon
// Rasterization", 1988.
#pragma once

#include "edgewise/cxx20.h"

#include <algorithm>
#include <cstdint>

#include "edgewise/screen_triangle.h"

namespace edgewise::contract {

__extension__ using int128 = __int128;

// Rule 1, screen space. y points down, and pixel (0, 0) is top left. Each pixel has one sample, at its
// centre. Positions are integers in units of 2^-15 px, and names of such numbers end in _q15: the sample of
// pixel p is at 2^15 p + 2^14.
//
// Rule 2, snapping. x and y are rounded half to even to 4 … 15 fraction bits, the subpixel bits; the lower of
// the 15 bits are 0. Facing, coverage and depth use only the snapped positions.
inline constexpr int kFineBits = 15;
inline constexpr std::int32_t kPixel_q15 = 1 << kFineBits;
inline constexpr std::int32_t kHalf_q15 = kPixel_q15 / 2;

constexpr std::int32_t sample_q15(std::int32_t pixel) {
  return pixel * kPixel_q15 + kHalf_q15;
}

// Rule 3, guard band. |x|, |y| <= 2^29 (16384 px). The front end clips geometry beyond the band, so the
// difference of two coordinates is at most 2^30. The largest image is the largest one whose samples all lie
// inside the band.
inline constexpr std::int32_t kGuard_q15 = 1 << 29;
inline constexpr std::int32_t kMaxImageSide = kGuard_q15 / kPixel_q15;
static_assert(kMaxImageSide == 16384 && sample_q15(kMaxImageSide - 1) < kGuard_q15);

// Rule 4, edge function and fill rule. For the edge from p to q of a triangle of positive area
//   E(s) = a (s.x - p.x) + b (s.y - p.y),  a = p.y - q.y,  b = q.x - p.x
// is >= 0 on the inner side. A sample exactly on an edge belongs to the triangle only if that edge is a left
// edge (a > 0) or a top edge (a = 0, b > 0). On any other edge, a bias of -1 turns E = 0 into "outside". So
// the inside test is E + bias >= 0 for all three edges. Bound: |a|, |b| <= 2^30 and |s - p| <= 2^30 on each
// axis, hence |E| <= 2^61.
struct Edge {
  std::int32_t a, b;
  std::int64_t c;  // bias - a p.x - b p.y

  // The biased edge value at a pixel's sample, in 2^-30 px^2.
  constexpr std::int64_t at(std::int32_t px, std::int32_t py) const {
    return std::int64_t{a} * sample_q15(px) + std::int64_t{b} * sample_q15(py) + c;
  }
};
inline constexpr std::int64_t kMaxEdge_q30 = std::int64_t{1} << 61;
static_assert(2 * (std::int64_t{2} * kGuard_q15) * (std::int64_t{2} * kGuard_q15) == kMaxEdge_q30);

constexpr bool is_top_left(std::int32_t a, std::int32_t b) {
  return a > 0 || (a == 0 && b > 0);
}

// Rule 5, tile shortcut. A step to the next sample changes E by 2^15 a or 2^15 b, and floor((E + 2^15 k) /
// 2^15) = floor(E / 2^15) + k. So a backend may add the bias, shift the value right by 15 once, and then step
// it by a and b: its sign stays that of the full value. The bias must be added before the shift. In a tile of
// up to 64 x 64 px that the edge crosses, the shifted value stays within 64 (|a| + |b|) of zero, so int32
// lanes suffice below 1024 px. Where all positions have `n` zero bits below, a backend may drop them and
// shift by 15 - n. With 8 subpixel bits, 64 (|a| + |b|) is then at most 2^30, and int32 lanes always suffice.
inline constexpr int kMaxTile = 64;
static_assert((std::int64_t{kMaxTile} * 2 * (std::int64_t{2} * kGuard_q15) >> (kFineBits - 8)) <=
              std::int64_t{1} << 30);

// Rule 6, depth. A vertex has z in [kDepthHead, kDepthHead + kDepthRange]. The front end maps depth 0 and 1
// to the ends of this range and rounds half to even. A stream states its depths. A scene's depth follows from
// the float distance w along the view direction:
//   depth = far (w - near) / ((far - near) w)
// With matrices, the factor far / (far - near) is read from the projection. It is 1 for an infinite far
// plane. If they are no usual perspective (camera.h), depth is z / w. Inside a triangle, depth is the plane
// through its vertices, in fixed point with wrap-around:
//   gx, gy   = floor(2^16 dz/dpx), floor(2^16 dz/dpy)           per pixel step, 16 fraction bits, mod 2^64
//   middle   = floor(plane at the sample (32, 32) of the pixel's 64 x 64 cell + 1/2)        mod 2^32
//   z(x, y)  = middle + (x mod 64 - 32) zx + (y mod 64 - 32) zy,  zx = floor(gx / 2^16 + 1/2)    mod 2^32
// The plane is anchored at the topmost vertex (the leftmost of several), so the order of the vertices changes
// no bit. Backends step from a cell's first sample, whose depth is base = middle - 32 (zx + zy).
//
// Error at a sample inside the triangle, in units: gx and gy are off by less than 2^-16 each over at most
// 2^15 px, middle rounds by 1/2, and up to 32 steps on each axis are off by at most 1/2 each. The sum is
// under 2 (1/2) + 1/2 + 64 (1/2) < 34. At least 128 units stay free at both ends of the 31 bits. So no drawn
// depth wraps, and each is below kDepthClear: the background never wins.
//
// The range is a multiple of 4, so it has 29 significant bits. Its product with a float (24 bits) is exact in
// a double (53 bits), so the front end rounds the depth of a stream only once.
//
// The cells are fixed in the image. A triangle that is moved by whole pixels keeps its samples. It keeps its
// depths only if it moves by multiples of 64 px; else they may change by two errors, under 2 * 34 units.
inline constexpr int kDepthCell = 64;
inline constexpr std::uint32_t kDepthHead = 128;
inline constexpr std::uint32_t kDepthClear = 0x7FFFFFFF;
inline constexpr std::uint32_t kDepthRange = kDepthClear - 2 * kDepthHead - 3;
inline constexpr std::uint32_t kDepthError = 34;
static_assert(kDepthHead > kDepthError && kDepthCell == kMaxTile);
static_assert(kDepthRange % 4 == 0 && kDepthRange < std::uint32_t{1} << 31);

// Contract units → depth from 0 (near) to 1 (far), rounded in the caller's mode. The background becomes 1.
constexpr double depth01(std::uint32_t depth) {
  return std::clamp((static_cast<double>(depth) - kDepthHead) / kDepthRange, 0.0, 1.0);
}
static_assert(depth01(kDepthHead) == 0 && depth01(kDepthHead + kDepthRange) == 1 &&
              depth01(kDepthClear) == 1);

// The fraction bits of a plane's value: those of a gradient, and of a position.
inline constexpr int kPlaneBits = 16 + kFineBits;

// The depth plane of a triangle (rule 6).
struct DepthPlane {
  std::uint64_t gx, gy;  // 48.16 fixed point per pixel, wrapped
  std::uint64_t origin;  // 2^31 (base of the cell at pixel (0, 0) + 1/2) before it is rounded down, wrapped
  std::uint32_t zx, zy;  // gx, gy rounded to whole units

  // Depth at a cell's first pixel. Both coordinates must be multiples of kDepthCell.
  constexpr std::uint32_t base(std::int32_t cell_px, std::int32_t cell_py) const {
    return static_cast<std::uint32_t>((origin + gx * (static_cast<std::uint64_t>(cell_px) << kFineBits) +
                                       gy * (static_cast<std::uint64_t>(cell_py) << kFineBits)) >>
                                      kPlaneBits);
  }
  // Depth at a pixel's sample.
  constexpr std::uint32_t at(std::int32_t px, std::int32_t py) const {
    const std::int32_t x = px % kDepthCell, y = py % kDepthCell;
    return base(px - x, py - y) + static_cast<std::uint32_t>(x) * zx + static_cast<std::uint32_t>(y) * zy;
  }
};

// floor(2^31 n / area) mod 2^64, for |n| <= 2^61 and 0 < area <= 2^60. Both are twice the area of a triangle
// inside a box, which is at most the area of the box. While the double quotient stays below 2^51, it is
// within two units of the exact quotient. The remainder then corrects it exactly: its true size is a few
// areas, below 2^63, so computing it modulo 2^64 loses nothing.
inline std::uint64_t gradient(std::int64_t n, std::int64_t area) {
  const double quotient = static_cast<double>(n) * 0x1p31 / static_cast<double>(area);
  if (quotient > -0x1p51 && quotient < 0x1p51) {
    auto g = static_cast<std::int64_t>(quotient);
    auto rest = static_cast<std::int64_t>((static_cast<std::uint64_t>(n) << kPlaneBits) -
                                          static_cast<std::uint64_t>(g) * static_cast<std::uint64_t>(area));
    for (; rest < 0; rest += area) --g;
    for (; rest >= area; rest -= area) ++g;
    return static_cast<std::uint64_t>(g);
  }
  const int128 wide = static_cast<int128>(n) * (std::int64_t{1} << kPlaneBits);
  int128 g = wide / area;
  if (g * area > wide) --g;
  return static_cast<std::uint64_t>(g);
}

// Rule 7, depth test. The smaller depth wins. Of triangles with equal depth, the one submitted first wins.
//
// Rule 8, payload. The winner's 32-bit payload is copied. A backend never interprets it.
//
// Rule 9, no contraction. Everything is built with -ffp-contract=off (no fused multiply-add), so the front
// end's floats, and the double estimate above, are the same on every machine.

// Rules 10 and 11 bound the errors of a scene's positions (camera.h) and of barycentric coordinates
// (barycentrics.h), which floats hold.

// Twice the signed area, in 2^-30 px^2. Positive is clockwise on the y-down screen, which is the
// front.
constexpr std::int64_t signed_area(const ScreenTriangle& t) {
  return std::int64_t{t.x_q15[1] - t.x_q15[0]} * (t.y_q15[2] - t.y_q15[0]) -
         std::int64_t{t.y_q15[1] - t.y_q15[0]} * (t.x_q15[2] - t.x_q15[0]);
}

// The pixels whose samples lie in a triangle's bounding box, clipped to an image: columns x0 … x1 - 1 and
// rows y0 … y1 - 1. Samples on the box's right and lower sides are left out: by the fill rule (4) they never
// belong to this triangle.
struct PixelBox {
  std::int32_t x0, y0, x1, y1;
  constexpr bool empty() const { return x0 >= x1 || y0 >= y1; }
};

constexpr PixelBox pixel_box(const ScreenTriangle& t, std::int32_t width, std::int32_t height) {
  const auto [min_x, max_x] = std::minmax({t.x_q15[0], t.x_q15[1], t.x_q15[2]});
  const auto [min_y, max_y] = std::minmax({t.y_q15[0], t.y_q15[1], t.y_q15[2]});
  // First sample at or after a coordinate: ceil((c - 2^14) / 2^15).
  const auto first = [](std::int32_t c) { return (c + kHalf_q15 - 1) >> kFineBits; };
  return {std::max(first(min_x), 0), std::max(first(min_y), 0), std::min(first(max_x), width),
          std::min(first(max_y), height)};
}

// A triangle whose vertices are ordered so that its area is positive.
struct Oriented {
  std::int32_t x[3], y[3];  // 2^-15 px
  std::int64_t z[3];        // contract units
  std::int64_t area;        // twice the area, in 2^-30 px^2; 0: the triangle draws nothing
};

constexpr Oriented orient(const ScreenTriangle& t) {
  const std::int64_t area = signed_area(t);
  const int second = area >= 0 ? 1 : 2, third = 3 - second;
  return {{t.x_q15[0], t.x_q15[second], t.x_q15[third]},
          {t.y_q15[0], t.y_q15[second], t.y_q15[third]},
          {t.z[0], t.z[second], t.z[third]},
          area >= 0 ? area : -area};
}

// The edge from vertex i to the next one (rule 4).
constexpr Edge make_edge(const Oriented& t, int i) {
  const int j = i == 2 ? 0 : i + 1;
  const std::int32_t a = t.y[i] - t.y[j], b = t.x[j] - t.x[i];
  return {a, b, (is_top_left(a, b) ? 0 : -1) - std::int64_t{a} * t.x[i] - std::int64_t{b} * t.y[i]};
}

// What makes a cell's base middle - 32 (zx + zy) instead of the plane at its first sample, as 2^31 units:
// 32 (gx / 2^16 - zx) and the same for y. `fractions` is the sum of the lower 16 bits of gx + 2^15 and
// gy + 2^15.
constexpr std::uint64_t middle_shift(std::uint64_t fractions) {
  return (fractions - 0x10000) * (kDepthCell / 2 * kPixel_q15);
}

// The depth plane (rule 6) of a triangle. Its area must not be zero.
inline DepthPlane make_depth(const Oriented& t) {
  const std::int64_t dz1 = t.z[1] - t.z[0], dz2 = t.z[2] - t.z[0];
  DepthPlane d;
  d.gx = gradient(dz1 * (t.y[2] - t.y[0]) - dz2 * (t.y[1] - t.y[0]), t.area);
  d.gy = gradient(dz2 * (t.x[1] - t.x[0]) - dz1 * (t.x[2] - t.x[0]), t.area);
  const std::uint64_t rounded_x = d.gx + 0x8000, rounded_y = d.gy + 0x8000;
  d.zx = static_cast<std::uint32_t>(rounded_x >> 16);
  d.zy = static_cast<std::uint32_t>(rounded_y >> 16);
  int top = 0;
  for (int i = 1; i < 3; ++i)
    if (t.y[i] < t.y[top] || (t.y[i] == t.y[top] && t.x[i] < t.x[top])) top = i;
  d.origin = (static_cast<std::uint64_t>(t.z[top]) << kPlaneBits) + (std::uint64_t{1} << (kPlaneBits - 1)) +
             d.gx * static_cast<std::uint64_t>(std::int64_t{kHalf_q15} - t.x[top]) +
             d.gy * static_cast<std::uint64_t>(std::int64_t{kHalf_q15} - t.y[top]) +
             middle_shift((rounded_x & 0xFFFF) + (rounded_y & 0xFFFF));
  return d;
}

}  // namespace edgewise::contract
