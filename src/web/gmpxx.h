// Takes the place of GMP, which WebAssembly lacks. A `long double` has 113 bits there, and a coordinate of
// the page is a multiple of 2^-32 px below 2^12 px. So products of two differences are exact, and so is the
// sign of their difference.
#pragma once

#include <compare>

struct mpq_class {
  long double value;
  mpq_class(long double v) : value(v) {}  // NOLINT: as GMP's
  double get_d() const { return static_cast<double>(value); }
  friend mpq_class operator+(mpq_class a, mpq_class b) { return a.value + b.value; }
  friend mpq_class operator-(mpq_class a, mpq_class b) { return a.value - b.value; }
  friend mpq_class operator*(mpq_class a, mpq_class b) { return a.value * b.value; }
  friend mpq_class operator/(mpq_class a, mpq_class b) { return a.value / b.value; }
  friend auto operator<=>(const mpq_class&, const mpq_class&) = default;
};
inline int sgn(mpq_class a) {
  return (a.value > 0) - (a.value < 0);
}
