// Ball arithmetic (van der Hoeven, "Ball arithmetic", 2010): a double and a bound on its error. Decides most
// signs and comparisons without rationals.
//
// Rounding to nearest leaves |fl(v) - v| <= 2^-53 |fl(v)| + 2^-1074; the last term is for underflow.
// Computing a bound rounds a few times; a factor of 1 + 2^-50 covers that.
#pragma once

#include <cmath>
#include <limits>

namespace edgewise::lab {

struct Ball {
  double value, error;

  Ball(double v = 0.0, double e = 0.0) : value(v), error(e) {}  // NOLINT: a number is a ball

  // 1 or -1; 0 if the error bound leaves the sign open.
  int sign() const { return std::abs(value) > error ? (value > 0.0 ? 1 : -1) : 0; }

  friend Ball operator+(const Ball& a, const Ball& b) {
    return rounded(a.value + b.value, a.error + b.error);
  }
  friend Ball operator-(const Ball& a, const Ball& b) {
    return rounded(a.value - b.value, a.error + b.error);
  }
  friend Ball operator*(const Ball& a, const Ball& b) {
    return rounded(a.value * b.value,
                   std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error);
  }
  // |x / y - a / b| = |b (x - a) - a (y - b)| / |y b|, for x and y in the balls around a and b.
  friend Ball operator/(const Ball& a, const Ball& b) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double quotient = a.value / b.value, least = std::abs(b.value) - b.error;
    if (!(least > std::abs(b.value) * 0x1p-20) || !std::isfinite(quotient)) return {0.0, kInfinity};
    return rounded(quotient, (a.error + std::abs(quotient) * b.error) / least);
  }

 private:
  static Ball rounded(double v, double e) {
    return {v, (e + 0x1p-53 * std::abs(v) + 0x1p-1074) * (1.0 + 0x1p-50)};
  }
};

}  // namespace edgewise::lab
