// How wrong a coverage is: a method's runs against a truth's.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lab/coverage/coverage.h"

namespace edgewise::lab {

// What a truth says of one picture; made once, compared with many methods.
struct CoverageTruth {
  Window window;
  std::vector<Run> runs;            // sorted
  std::vector<std::uint32_t> hits;  // how many triangles cover each pixel, row by row
  std::uint64_t covered = 0;        // their sum
};
CoverageTruth snapped_coverage(const CoverageInput& input, Window window, int threads);
CoverageTruth float_coverage(const CoverageInput& input, Window window, int threads);

// For each edge of each triangle, the number of sample rows or of sample columns that it crosses inside the
// window, whichever is more; summed. Errors are counted per 10^6 of these, since a long edge has more chances
// to be wrong.
std::uint64_t edge_crossings(std::span<const FloatTriangle> triangles, Window window);

struct CoverageScore {
  std::uint64_t triangles = 0, covered = 0;  // covered: (triangle, pixel) pairs, in truth
  std::uint64_t missing = 0, extra = 0;      // such pairs in truth only, by the method only
  std::uint64_t gaps = 0;                    // cracks between neighbours; see gaps()
  std::uint64_t double_hits = 0;  // pixels that at most one covers in truth, and that are drawn twice or more
  std::uint64_t out_of_bounds = 0;  // pixels drawn outside the window; counted here only
  std::uint64_t out_of_box = 0;     // extra pairs whose pixel does not touch the triangle's bounding box
  double worst_px =
      0.0;  // largest distance of a wrong pair's sample from the nearest line of an edge, or the box

  std::uint64_t errors() const { return missing + extra; }
  bool operator==(const CoverageScore&) const = default;
};
// `runs` need not be sorted; a pixel drawn twice for one triangle is one pair, but two hits. `reach_px`: see
// gaps().
CoverageScore score_coverage(const CoverageTruth& truth, std::vector<Run> runs,
                             std::span<const FloatTriangle> triangles, double reach_px);
CoverageScore score_coverage(const CoverageTruth& truth, const CoverageMethod& method,
                             const CoverageInput& input);

constexpr double per_million(std::uint64_t count, std::uint64_t crossings) {
  return crossings == 0 ? 0.0 : 1e6 * static_cast<double>(count) / static_cast<double>(crossings);
}

// Calls on_run(run, missing) for every stretch of wrong pixels: missing, or else extra. Both inputs are
// sorted.
void for_each_difference(std::span<const Run> truth, std::span<const Run> drawn,
                         const std::function<void(const Run&, bool missing)>& on_run);

// A gap is a pixel that one triangle covers in truth and nobody draws, though its sample lies farther inside
// the union of the triangles than `reach_px`, by which the method may move an edge: so a pixel that is lost
// where an outline moved is missing, and no gap. Watertight methods leave none where neighbours share
// vertices. Indices into `hits`.
std::vector<std::size_t> gaps(const CoverageTruth& truth, std::span<const std::uint32_t> hits,
                              std::span<const FloatTriangle> triangles, double reach_px);

// What is published excuses nobody for more than rounding to whole pixels does, so that a sloppier promise
// hides no crack. A tighter one counts in full: such a method loses nothing else so near the outline, and the
// cracks of the smallest scenes run up to theirs.
inline constexpr double kMostReach_px = 0.71;  // above sqrt(1/2)
inline double gap_reach_px(const CoverageMethod& method) {
  return std::min(method.promise.reach_px, kMostReach_px);
}

// Hits at each pixel of the window, row by row; for pictures of errors. What lies outside is left out.
std::vector<std::uint32_t> hits_of(std::span<const Run> runs, Window window);

// How far a wrong sample is from where it could be doubted. An edge without length has no line, and no
// distance.
class ErrorDistance {
 public:
  explicit ErrorDistance(const UnsnappedTriangle& triangle);
  // From the nearest line through an edge, or from the bounding box if that is farther; within 1e-11 px below
  // 4096 px.
  double at(int px, int py) const;
  // Whether a pixel's square does not even touch the bounding box.
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
