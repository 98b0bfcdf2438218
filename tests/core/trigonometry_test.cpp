// The trigonometric functions against MPFR, over the whole range of arguments.
#include "core/trigonometry.h"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/random.h"

namespace edgewise {
namespace {

constexpr int kRandomArguments = 20'000;

// A number of MPFR with enough bits for an error of a small part of a unit in the last place.
class Real {
 public:
  Real() { mpfr_init2(value_, 128); }
  explicit Real(double v) : Real() { mpfr_set_d(value_, v, MPFR_RNDN); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  ~Real() { mpfr_clear(value_); }
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

// The error of `v` in units in the last place of the exact result.
double error_units(double v, Real& exact) {
  if (std::isnan(v)) return std::numeric_limits<double>::infinity();
  const double rounded = mpfr_get_d(exact.get(), MPFR_RNDN);
  mpfr_sub_d(exact.get(), exact.get(), v, MPFR_RNDN);
  const int exponent = std::max(std::ilogb(rounded), std::numeric_limits<double>::min_exponent - 1);
  return std::abs(mpfr_get_d(exact.get(), MPFR_RNDN)) / std::ldexp(1.0, exponent - 52);
}

// Between 2^low and 2^high, of either sign, with uniform exponents.
double magnitude(Random& random, int low, int high) {
  const auto exponent = low + static_cast<int>(random.below(static_cast<std::uint64_t>(high - low)));
  const double v = std::ldexp(1.0 + static_cast<double>(random.next() >> 11) * 0x1p-53, exponent);
  return random.below(2) == 0 ? v : -v;
}

// Of all sizes, more of them where angles usually are, and those next to multiples of pi/4, where the
// reduced angle is small or jumps.
std::vector<double> angles() {
  std::vector<double> all{0.0, std::numeric_limits<double>::denorm_min(), 0x1p-1000,
                          std::numeric_limits<float>::max(), std::nextafter(0x1p128, 0.0)};
  Random random(1);
  for (int i = 0; i < kRandomArguments; ++i) {
    all.push_back(magnitude(random, -1022, 128));
    all.push_back(magnitude(random, -6, 6));
    all.push_back(static_cast<float>(magnitude(random, -6, 127)));
    Real multiple;
    mpfr_const_pi(multiple.get(), MPFR_RNDN);
    mpfr_mul_ui(multiple.get(), multiple.get(), random.next() >> (random.below(54) + 10), MPFR_RNDN);
    mpfr_div_ui(multiple.get(), multiple.get(), 4, MPFR_RNDN);
    all.push_back(mpfr_get_d(multiple.get(), MPFR_RNDN));
  }
  return all;
}

double worst(double (*ours)(double), int (*theirs)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t)) {
  double most = 0.0;
  for (const double angle : angles()) {
    Real given(angle), exact;
    theirs(exact.get(), given.get(), MPFR_RNDN);
    most = std::max(most, error_units(ours(angle), exact));
  }
  return most;
}

TEST(Trigonometry, SineCosineAndTangentAreWithinTheirBounds) {
  EXPECT_LE(worst(sine, mpfr_sin), 0.85);
  EXPECT_LE(worst(cosine, mpfr_cos), 0.85);
  EXPECT_LE(worst(tangent, mpfr_tan), 2.5);
}

TEST(Trigonometry, ArctangentIsWithinItsBound) {
  double most = 0.0;
  Random random(2);
  const auto add = [&](double y, double x) {
    Real above(y), beside(x), exact;
    mpfr_atan2(exact.get(), above.get(), beside.get(), MPFR_RNDN);
    most = std::max(most, error_units(arctangent(y, x), exact));
  };
  for (int i = 0; i < kRandomArguments; ++i) {
    const double y = magnitude(random, -100, 100);
    add(y, magnitude(random, -100, 100));
    add(y, y * magnitude(random, -6, 6));
    add(y, 0.0);
    add(0.0, y);
  }
  EXPECT_LE(most, 6.0);
  EXPECT_EQ(arctangent(0.0, 0.0), 0.0);
}

TEST(Trigonometry, MinusZeroCountsAsZero) {
  for (const double result : {sine(-0.0), tangent(-0.0), arctangent(-0.0, 1.0), arctangent(-0.0, -0.0)})
    EXPECT_TRUE(result == 0.0 && !std::signbit(result));
  EXPECT_GT(arctangent(-0.0, -1.0), 3.0);
}

// Rodrigues' formula.
TEST(Trigonometry, RotationTurnsVectorsAroundTheAxis) {
  Random random(4);
  const auto any = [&] {
    return glm::dvec3{magnitude(random, -3, 3), magnitude(random, -3, 3), magnitude(random, -3, 3)};
  };
  for (int i = 0; i < kRandomArguments; ++i) {
    const glm::dvec3 axis = any(), unit = glm::normalize(axis), v = any();
    const double angle = magnitude(random, -6, 6), s = sine(angle), c = cosine(angle);
    const glm::dvec3 turned = c * v + s * glm::cross(unit, v) + (1.0 - c) * glm::dot(unit, v) * unit;
    EXPECT_LT(glm::distance(rotation(axis, angle) * v, turned), 0x1p-48 * glm::length(v));
  }
}

TEST(Trigonometry, AnglesOutOfRangeGiveNan) {
  for (const double angle : {0x1p128, -0x1p1000, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()})
    for (const double result : {sine(angle), cosine(angle), tangent(angle)})
      EXPECT_TRUE(std::isnan(result)) << angle;
}

}  // namespace
}  // namespace edgewise
