// Trigonometric functions with the same bits on every machine. Those of libm differ in the last bit between
// libraries, and between processors with and without FMA. Here, a result follows from additions,
// multiplications, divisions and square roots, which IEEE 754 rounds in one way only.
//
// Angles are in radians, below 2^128 like those of all floats; beyond, the results are NaN. The overloads for
// float round the double's result once more. -0 counts as +0: sine(-0) is +0,
// unlike libm's.
#pragma once

#include <glm/glm.hpp>

namespace edgewise {

// Within 0.85 units in the last place.
double sine(double angle);
double cosine(double angle);
// Within 2.5 units.
double tangent(double angle);
// The angle from the x axis to (x, y), from -pi to pi, within 6 units. 0 for (0, 0).
double arctangent(double y, double x);

inline float sine(float angle) {
  return static_cast<float>(sine(double{angle}));
}
inline float cosine(float angle) {
  return static_cast<float>(cosine(double{angle}));
}
inline float tangent(float angle) {
  return static_cast<float>(tangent(double{angle}));
}

// Counter-clockwise, seen from the axis's tip. The axis may have any length but 0.
glm::dmat3 rotation(glm::dvec3 axis, double angle);

}  // namespace edgewise
