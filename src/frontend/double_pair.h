// Numbers of about 106 bits, as sums of two doubles (T. J. Dekker, "A floating-point technique for extending
// the available precision", 1971). A result is off by less than 2^-100 of its operands' absolute values, or
// of their product. If a number is too large for that, it has the precision of a double.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace edgewise {

class DoublePair {
 public:
  DoublePair() = default;  // uninitialized; glm needs it to be trivial
  DoublePair(double value) : high_(value), low_(0.0) {}
  explicit operator double() const { return high_; }

  friend DoublePair operator+(DoublePair a, DoublePair b) {
    const double sum = a.high_ + b.high_, from_b = sum - a.high_, from_a = sum - from_b;
    return {sum, (a.high_ - from_a) + (b.high_ - from_b) + (a.low_ + b.low_)};
  }
  friend DoublePair operator*(DoublePair a, DoublePair b) {
    const double product = a.high_ * b.high_;
    const Halves x(a.high_), y(b.high_);
    const double rest = x.low * y.low - (product - x.high * y.high - x.high * y.low - x.low * y.high);
    return {product, rest + (a.high_ * b.low_ + a.low_ * b.high_)};
  }
  DoublePair& operator+=(DoublePair b) { return *this = *this + b; }

 private:
  // Of 26 bits each, so that their products are exact.
  struct Halves {
    explicit Halves(double v) {
      const double scaled = 134217729.0 * v;  // 2^27 + 1
      high = scaled - (scaled - v), low = v - high;
    }
    double high, low;
  };
  DoublePair(double high, double low) : high_(high + low), low_(low - (high_ - high)) {
    if (!std::isfinite(low_)) high_ = high, low_ = 0.0;
  }

  double high_, low_;  // high is the sum rounded to double
};

using PairMatrix = glm::tmat4x4<DoublePair>;

}  // namespace edgewise
