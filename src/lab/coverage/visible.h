// What a coverage method's picture shows: whose each pixel is, and how exact its depth. Coverage alone does
// not say that: a lost pixel of a hidden triangle costs nothing, and a plane of depths that is evaluated in
// floats may let the wrong triangle win.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/coverage/coverage.h"

namespace edgewise::lab {

struct VisibleTriangleScore {
  // Pixels that do not show their exact owner, or show one where there is none; against each truth.
  std::uint64_t wrong_snapped = 0, wrong_floats = 0;
  // Of the backends' wrong_snapped, those whose depth is farther from the owner's than rule 6 lets both be.
  std::uint64_t unexplained = 0;
  // Error of the depth where the owner is right, against the truth of the positions that it was computed
  // from: for the backends the snapped ones, in units of rule 6, 2^-31 of the range; for all others those
  // before, in the last place that a float has at the exact depth, or at 2^-8 where that is nearer to 0.
  double max_ulp = 0.0, rms_ulp = 0.0;

  bool operator==(const VisibleTriangleScore&) const = default;
};

// Knows the exact owners in a picture, by both truths.
class VisibleTriangleJudge {
 public:
  VisibleTriangleJudge(const CoverageInput& input, Size size, int threads);
  VisibleTriangleScore score(const CoverageMethod& method) const;

 private:
  std::uint64_t unexplained(const Canvas& canvas) const;

  Size size_;
  std::vector<FloatTriangle> floats_;  // their payloads are their indices, from 1
  std::vector<ScreenTriangle> snapped_;
  VisibleTriangles by_grid_, by_floats_;
};

}  // namespace edgewise::lab
