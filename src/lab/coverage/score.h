// Scores coverage: compares a method's pixel runs with those of a truth.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lab/coverage/coverage.h"

namespace edgewise::lab {

// A truth's pixels of one picture, computed once for all methods.
struct CoverageTruth {
  Window window;
  std::vector<Run> runs;            // sorted
  std::vector<std::uint32_t> hits;  // how many triangles cover each pixel, row by row
  std::uint64_t covered = 0;        // their sum
};
CoverageTruth snapped_coverage(const CoverageInput& input, Window window, int threads);
CoverageTruth float_coverage(const CoverageInput& input, Window window, int threads);

// The sum over all edges of all triangles: the larger of the numbers of sample rows and sample columns that
// the edge crosses inside the window. Error rates are per 10^6 crossings, since a long edge has more chances
// to be wrong.
std::uint64_t edge_crossings(std::span<const FloatTriangle> triangles, Window window);
// The same for edges that at least two triangles share: bit-identical end points. Each such edge counts once.
std::uint64_t shared_edge_crossings(std::span<const FloatTriangle> triangles, Window window);
// The largest side of the triangles' bounding boxes, for comparison with CoveragePromise::max_side_px.
float largest_side_px(std::span<const FloatTriangle> triangles);

struct CoverageScore {
  std::uint64_t triangles = 0, covered = 0;  // covered: (triangle, pixel) pairs, in truth
  std::uint64_t missing = 0, extra = 0;      // pairs only in the truth; pairs only of the method
  std::uint64_t gaps = 0;                    // cracks between neighbours; see gaps()
  // Pixels that at most one triangle covers in truth, drawn by two neighbours (triangles with a bit-identical
  // vertex) or twice by one triangle. Where an outline moved over another object, no edge was drawn twice.
  std::uint64_t double_hits = 0;
  std::uint64_t out_of_bounds = 0;  // pixels drawn outside the window; not counted as extra
  std::uint64_t out_of_box = 0;     // extra pairs whose pixel does not touch the triangle's bounding box
  double worst_px = 0.0;            // largest ErrorDistance::at() of a wrong pair

  std::uint64_t errors() const { return missing + extra; }
  bool operator==(const CoverageScore&) const = default;
};
// `runs` may be in any order; a pixel drawn twice for one triangle is one pair, but two hits. `reach_px`: see
// gaps().
CoverageScore score_coverage(const CoverageTruth& truth, std::vector<Run> runs,
                             std::span<const FloatTriangle> triangles, double reach_px);
CoverageScore score_coverage(const CoverageTruth& truth, const CoverageMethod& method,
                             const CoverageInput& input);

constexpr double per_million(std::uint64_t count, std::uint64_t crossings) {
  return crossings == 0 ? 0.0 : 1e6 * static_cast<double>(count) / static_cast<double>(crossings);
}

// Calls on_run(run, missing) for every run of wrong pixels; `missing` is false if they are extra. Both inputs
// must be sorted.
void for_each_difference(std::span<const Run> truth, std::span<const Run> drawn,
                         const std::function<void(const Run&, bool missing)>& on_run);

// A gap is a pixel that exactly one triangle covers in truth, that is not drawn, and whose sample lies inside
// the union of the triangles by more than `reach_px`, by which the method may move an edge. A pixel lost
// where an outline moved is therefore missing, but no gap. Watertight methods leave no gaps between
// neighbours that share vertices. Returns indices into `hits`.
std::vector<std::size_t> gaps(const CoverageTruth& truth, std::span<const std::uint32_t> hits,
                              std::span<const FloatTriangle> triangles, double reach_px);

// Reported gaps use at most the reach of rounding to whole pixels, so that a method with a loose promise
// cannot hide cracks. Smaller promises are used as they are: such methods lose no other pixels that near the
// outline, and the cracks of the smallest scenes extend to it.
inline constexpr double kMostReach_px = 0.71;  // above sqrt(1/2)
inline double gap_reach_px(const CoverageMethod& method) {
  return std::min(method.promise.reach_px, kMostReach_px);
}

// Hits at each pixel of the window, row by row. Pixels outside the window are ignored.
std::vector<std::uint32_t> hits_of(std::span<const Run> runs, Window window);

// How far a wrong sample lies from the triangle's edges and bounding box. An edge without length counts as
// distance 0.
class ErrorDistance {
 public:
  explicit ErrorDistance(const UnsnappedTriangle& triangle);
  // The distance from the nearest line through an edge, or from the bounding box if that is larger; accurate
  // to 1e-11 px for coordinates below 4096 px.
  double at(int px, int py) const;
  // Whether a pixel's square does not touch the bounding box.
  bool off_box(int px, int py) const {
    return px > high_x_ || px + 1 < low_x_ || py > high_y_ || py + 1 < low_y_;
  }

 private:
  struct Line {
    double x, y, normal_x, normal_y;
  } lines_[3];
  double low_x_, low_y_, high_x_, high_y_;
};

}  // namespace edgewise::lab
