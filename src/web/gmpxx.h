// Takes the place of GMP, which WebAssembly lacks, where the sign of a cross product is asked for. A
// `long double` has 113 bits there. If coordinates are multiples of 2^-32 px below 2^12 px, their differences
// have 45 bits, so products and the sum of two are exact. The exact depths of lab/truth/truth.h need more
// bits. The page never computes them, so a quotient, which only they need, ends the program.
#pragma once

#include <compare>

struct mpq_class {
  long double value;
  mpq_class(long double v) : value(v) {}  // NOLINT: as GMP's
  double get_d() const { return static_cast<double>(value); }
  friend mpq_class operator+(mpq_class a, mpq_class b) { return a.value + b.value; }
  friend mpq_class operator-(mpq_class a, mpq_class b) { return a.value - b.value; }
  friend mpq_class operator*(mpq_class a, mpq_class b) { return a.value * b.value; }
  friend mpq_class operator/(mpq_class, mpq_class) { __builtin_trap(); }
  friend auto operator<=>(const mpq_class&, const mpq_class&) = default;
};
inline int sgn(mpq_class a) {
  return (a.value > 0) - (a.value < 0);
}
