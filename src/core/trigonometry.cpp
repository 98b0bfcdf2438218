#include "core/trigonometry.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

namespace edgewise {

namespace {

__extension__ using uint128 = unsigned __int128;
__extension__ using int128 = __int128;

// quarter_turns · pi/2 + angle + rest, where |angle| <= pi/4, and rest is what angle's rounding leaves.
struct Reduced {
  unsigned quarter_turns;  // modulo 4
  double angle, rest;
};

// The first 320 bits of 2/pi after 64 zeros.
constexpr std::uint64_t kTwoOverPi[] = {
    0, 0xA2F9836E4E441529, 0xFC2757D1F534DDC0, 0xDB6295993C439041, 0xFE5163ABDEBBC561, 0xB7246E3A424DD2E0};
constexpr std::uint64_t kHalfPi = 0xC90FDAA22168C234;  // pi/2 · 2^63

// Payne and Hanek, "Radian reduction for trigonometric functions", 1983: of 2/pi, only those bits are
// multiplied whose products are not whole turns.
Reduced reduced(double angle) {
  const double magnitude = std::abs(angle);
  if (magnitude < std::numbers::pi / 4) return {0, angle, 0.0};
  if (!(magnitude < 0x1p128)) return {0, std::numeric_limits<double>::quiet_NaN(), 0.0};
  const int exponent = std::ilogb(magnitude) - 52;  // -53 … 75
  const auto integer = static_cast<std::uint64_t>(std::ldexp(magnitude, -exponent));
  // The bit at `first` stands for 2 · integer quarter turns, and those before it for whole turns.
  const unsigned first = static_cast<unsigned>(exponent + 62), word = first / 64, shift = first % 64;
  const auto bits = [&](unsigned i) {
    const std::uint64_t high = kTwoOverPi[word + i] << shift;
    return shift == 0 ? high : high | kTwoOverPi[word + i + 1] >> (64 - shift);
  };
  // The upper 128 of 192 bits: two of whole quarter turns, 126 of a fraction.
  const uint128 low = uint128{integer} * bits(2), middle = uint128{integer} * bits(1);
  const uint128 turns = (uint128{integer * bits(0)} << 64) + middle + (low >> 64);
  // The fraction from -1/2 to 1/2, times 2^128. Its magnitude exceeds 2^66: no double is nearer to a multiple
  // of pi/2 (Muller, "Elementary Functions", 2016, section 11).
  const auto fraction = static_cast<int128>(turns << 2);
  const uint128 distance = fraction < 0 ? -static_cast<uint128>(fraction) : static_cast<uint128>(fraction);
  const int zeros = std::countl_zero(static_cast<std::uint64_t>(distance >> 64));
  const auto leading = static_cast<std::uint64_t>(distance << zeros >> 64);
  const auto product = static_cast<std::uint64_t>(uint128{leading} * kHalfPi >> 64);
  constexpr std::uint64_t kRest = 0x7FF;  // what does not fit a double
  const double unit = std::ldexp((fraction < 0) != (angle < 0.0) ? -1.0 : 1.0, -63 - zeros);
  const unsigned rounded = static_cast<unsigned>(turns >> 126) + (fraction < 0 ? 1 : 0);
  return {(angle < 0.0 ? 0u - rounded : rounded) % 4, unit * static_cast<double>(product & ~kRest),
          unit * static_cast<double>(product & kRest)};
}

template <std::size_t kTerms>
double polynomial(const double (&coefficients)[kTerms], double x) {
  double sum = 0.0;
  for (std::size_t i = kTerms; i-- > 0;) sum = coefficients[i] + x * sum;
  return sum;
}

// Taylor's series; what is left out is below 2^-58 of the result. As in FreeBSD's msun (k_sin.c, k_cos.c),
// the last addition adds a small part, which is rounded, to a large one, which is exact.
double sine_of(const Reduced& r) {
  constexpr double kTerms[] = {
      -1.0 / 6,          1.0 / 120,           -1.0 / 5'040,          1.0 / 362'880,
      -1.0 / 39'916'800, 1.0 / 6'227'020'800, -1.0 / 1.307674368e12, 1.0 / 3.55687428096e14};
  const double square = r.angle * r.angle;
  return r.angle + (square * r.angle * polynomial(kTerms, square) + r.rest * (1.0 - 0.5 * square));
}
double cosine_of(const Reduced& r) {
  constexpr double kTerms[] = {1.0 / 24,
                               -1.0 / 720,
                               1.0 / 40'320,
                               -1.0 / 3'628'800,
                               1.0 / 479'001'600,
                               -1.0 / 87'178'291'200,
                               1.0 / 2.0922789888e13};
  const double square = r.angle * r.angle, half = 0.5 * square, first = 1.0 - half;
  return first + ((1.0 - first - half) + (square * square * polynomial(kTerms, square) - r.angle * r.rest));
}

// The sine of an angle and a number of quarter turns.
double sine_after(unsigned quarter_turns, const Reduced& r) {
  const double result = quarter_turns % 2 == 0 ? sine_of(r) : cosine_of(r);
  return quarter_turns % 4 < 2 ? result : -result;
}

}  // namespace

double sine(double angle) {
  const Reduced r = reduced(angle);
  return sine_after(r.quarter_turns, r);
}

double cosine(double angle) {
  const Reduced r = reduced(angle);
  return sine_after(r.quarter_turns + 1, r);
}

double tangent(double angle) {
  const Reduced r = reduced(angle);
  return sine_after(r.quarter_turns, r) / sine_after(r.quarter_turns + 1, r);
}

double arctangent(double y, double x) {
  const double across = std::abs(y), along = std::abs(x);
  if (across == 0.0 && along == 0.0) return 0.0;
  double t = std::min(across, along) / std::max(across, along);   // of an angle up to pi/4
  for (int i = 0; i < 3; ++i) t /= 1.0 + std::sqrt(1.0 + t * t);  // of half the angle
  // Taylor's series; what is left out is below 2^-57 of the result.
  constexpr double kTerms[] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15};
  const double square = t * t, angle = 8.0 * (t + t * square * polynomial(kTerms, square));
  const double from_axis = across > along ? std::numbers::pi / 2 - angle : angle;
  const double magnitude = x < 0.0 ? std::numbers::pi - from_axis : from_axis;
  return y < 0.0 ? -magnitude : magnitude;
}

glm::dmat3 rotation(glm::dvec3 axis, double angle) {
  const double c = cosine(angle), s = sine(angle);
  const glm::dvec3 unit = glm::normalize(axis), part = (1.0 - c) * unit;
  return {c + part.x * unit.x,          part.x * unit.y + s * unit.z, part.x * unit.z - s * unit.y,
          part.y * unit.x - s * unit.z, c + part.y * unit.y,          part.y * unit.z + s * unit.x,
          part.z * unit.x + s * unit.y, part.z * unit.y - s * unit.x, c + part.z * unit.z};
}

}  // namespace edgewise
