// Scores coverage: compares a method's pixel runs with those of a truth.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "lab/coverage/coverage.h"

namespace edgewise::lab {

// A truth's pixels of one picture, computed once for all methods.
struct CoverageTruth {
  Window window;
  std::vector<Run> runs;      // sorted
  std::uint64_t covered = 0;  // their pixels
};
CoverageTruth coverage_of(const SourceTruth& source, Window window, int threads);
CoverageTruth snapped_coverage(const CoverageInput& input, Window window, int threads);
CoverageTruth float_coverage(const CoverageInput& input, Window window, int threads);

// The sum over all edges of all triangles: the larger of the numbers of sample rows and sample columns that
// the edge crosses inside the window. Error rates are per 10^6 crossings, since a long edge has more chances
// to be wrong.
std::uint64_t edge_crossings(const SourceTruth& source, Window window);
std::uint64_t edge_crossings(std::span<const FloatTriangle> triangles, Window window);
// Of one edge, in px.
double crossings_of(glm::dvec2 from, glm::dvec2 to, Window window);
// The largest side of the triangles' bounding boxes, for comparison with CoveragePromise::max_side_px.
float largest_side_px(std::span<const FloatTriangle> triangles);

// The pixels that a method draws in a window.
struct DrawnRuns {
  // `drawn` may be in any order; a pixel drawn twice for one triangle is one pair.
  DrawnRuns(std::vector<Run> drawn, Window window);
  DrawnRuns(const CoverageMethod& method, const CoverageInput& input, Window window);
  // With CoverageScene::sources in place of the scene's triangles; as they are if there are none.
  DrawnRuns of_sources(std::span<const std::uint32_t> sources) const;

  std::vector<Run> runs;            // sorted, each (triangle, pixel) pair once
  std::uint64_t out_of_bounds = 0;  // pixels drawn outside the window
};

struct CoverageScore {
  std::uint64_t missing = 0, extra = 0;  // (triangle, pixel) pairs only in the truth; only of the method
  std::uint64_t out_of_bounds = 0;       // not counted as extra
  std::uint64_t out_of_box = 0;          // extra pairs whose pixel does not touch the triangle's bounding box
  double worst_px = 0.0;                 // largest ErrorDistance::at() of a wrong pair

  std::uint64_t errors() const { return missing + extra; }
  bool operator==(const CoverageScore&) const = default;
};
CoverageScore score_coverage(const CoverageTruth& truth, const DrawnRuns& drawn, const SourceTruth& source);
CoverageScore score_coverage(const CoverageTruth& truth, const DrawnRuns& drawn,
                             std::span<const FloatTriangle> triangles);

// What a scene is judged by: its own truth, or that of its floats, which `floats` holds.
const SourceTruth& source_of(const CoverageScene& scene, const FloatSource& floats);

// Judges coverage methods on a scene from its source on. The scene must outlive it.
class SourceJudge {
 public:
  SourceJudge(const CoverageScene& scene, int threads);
  SourceJudge(const SourceJudge&) = delete;
  const SourceTruth& source() const { return source_; }
  const CoverageTruth& truth() const { return exact_ ? *exact_ : floats_; }
  const CoverageTruth& floats() const { return floats_; }  // of the positions that the methods get
  DrawnRuns of_sources(const DrawnRuns& drawn) const { return drawn.of_sources(scene_.sources); }
  CoverageScore score(const DrawnRuns& drawn) const {
    return score_coverage(truth(), of_sources(drawn), source_);
  }

 private:
  const CoverageScene& scene_;
  FloatSource by_floats_;
  const SourceTruth& source_;
  CoverageTruth floats_;
  std::optional<CoverageTruth> exact_;
};

constexpr double per_million(std::uint64_t count, std::uint64_t crossings) {
  return crossings == 0 ? 0.0 : 1e6 * static_cast<double>(count) / static_cast<double>(crossings);
}

// Calls on_run(run, missing) for every run of wrong pixels; `missing` is false if they are extra. Both inputs
// must be sorted.
void for_each_difference(std::span<const Run> truth, std::span<const Run> drawn,
                         const std::function<void(const Run&, bool missing)>& on_run);

// How far a wrong sample lies from the edges and the bounding box of a triangle's outline. An edge without
// length counts as distance 0.
class ErrorDistance {
 public:
  explicit ErrorDistance(std::span<const glm::dvec3> outline);
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
  };
  std::vector<Line> lines_;
  double low_x_, low_y_, high_x_, high_y_;
};

}  // namespace edgewise::lab
