#include "lab/coverage/score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lab/projection/truth.h"

namespace edgewise::lab {

namespace {

std::uint64_t length(const Run& run) {
  return static_cast<std::uint64_t>(run.x1 - run.x0);
}

CoverageTruth truth_from(std::vector<Run> runs, Window window) {
  CoverageTruth truth{window, std::move(runs), 0};
  for (const Run& run : truth.runs) truth.covered += length(run);
  return truth;
}

// Clips runs to the window and returns the number of pixels removed.
std::uint64_t cut(std::vector<Run>& runs, Window w) {
  std::uint64_t lost = 0;
  for (Run& run : runs) {
    const std::uint64_t before = length(run);
    run.x0 = std::clamp(run.x0, w.x0, w.x1());
    run.x1 = run.y >= w.y0 && run.y < w.y1() ? std::clamp(run.x1, run.x0, w.x1()) : run.x0;
    lost += before - length(run);
  }
  if (lost > 0) std::erase_if(runs, [](const Run& run) { return run.x0 == run.x1; });
  return lost;
}

// Merges runs that overlap or touch, so that each (triangle, pixel) pair counts once.
std::vector<Run> joined(std::vector<Run> runs) {
  std::size_t count = 0;
  for (const Run& run : runs) {
    Run* last = count > 0 ? &runs[count - 1] : nullptr;
    if (last != nullptr && last->triangle == run.triangle && last->y == run.y && run.x0 <= last->x1)
      last->x1 = std::max(last->x1, run.x1);
    else
      runs[count++] = run;
  }
  runs.resize(count);
  return runs;
}

// The number of samples on one axis in (a, b], or (b, a] if b is smaller.
double samples_between(double a, double b) {
  return std::abs(std::floor(a + 0.5) - std::floor(b + 0.5));
}

}  // namespace

CoverageTruth coverage_of(const SourceTruth& source, Window window, int threads) {
  return truth_from(source.runs(window, threads), window);
}

CoverageTruth snapped_coverage(const CoverageInput& input, Window window, int threads) {
  return truth_from(covered_runs(input.snapped, window, threads), window);
}

CoverageTruth float_coverage(const CoverageInput& input, Window window, int threads) {
  return truth_from(covered_runs(input.floats, window, threads), window);
}

double crossings_of(glm::dvec2 from, glm::dvec2 to, Window w) {
  const double x = from.x, y = from.y, dx = to.x - x, dy = to.y - y;
  // The part inside the window (Liang and Barsky, 1984), as parameters of x + t dx, y + t dy.
  double begin = 0.0, end = 1.0;
  const auto clip = [&](double start, double step, double low, double high) {
    if (step == 0.0) {
      if (start < low || start > high) end = -1.0;
      return;
    }
    const double a = (low - start) / step, b = (high - start) / step;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  };
  clip(x, dx, w.x0, w.x1());
  clip(y, dy, w.y0, w.y1());
  if (begin >= end) return 0.0;
  return std::max(samples_between(x + begin * dx, x + end * dx),
                  samples_between(y + begin * dy, y + end * dy));
}

std::uint64_t edge_crossings(const SourceTruth& source, Window window) {
  double crossings = 0.0;
  for (std::uint32_t i = 0; i < source.size(); ++i) {
    const auto outline = source.outline(i);
    for (std::size_t k = 0; k < outline.size(); ++k)
      crossings += crossings_of(outline[k], outline[(k + 1) % outline.size()], window);
  }
  return static_cast<std::uint64_t>(crossings);
}

std::uint64_t edge_crossings(std::span<const FloatTriangle> triangles, Window window) {
  return edge_crossings(FloatSource(triangles), window);
}

float largest_side_px(std::span<const FloatTriangle> triangles) {
  float largest = 0.0f;
  for (const auto& [t, payload] : triangles)
    for (const auto& v : {t.x_px, t.y_px})
      largest = std::max(largest, std::max({v[0], v[1], v[2]}) - std::min({v[0], v[1], v[2]}));
  return largest;
}

void for_each_difference(std::span<const Run> truth, std::span<const Run> drawn,
                         const std::function<void(const Run&, bool missing)>& on_run) {
  // Merges the ends of both lists' runs in one row; between two neighbouring ends the lists agree or differ.
  const auto row_of = [](const Run& run) { return std::pair(run.triangle, run.y); };
  auto t = truth.begin();
  auto d = drawn.begin();
  while (t != truth.end() || d != drawn.end()) {
    const auto row =
        d == drawn.end() || (t != truth.end() && row_of(*t) <= row_of(*d)) ? row_of(*t) : row_of(*d);
    const auto in_row = [&](auto at, auto end) { return at != end && row_of(*at) == row; };
    int x = std::numeric_limits<int>::min();
    while (in_row(t, truth.end()) || in_row(d, drawn.end())) {
      constexpr int kNever = std::numeric_limits<int>::max();
      const bool has_t = in_row(t, truth.end()), has_d = in_row(d, drawn.end());
      const bool in_t = has_t && t->x0 <= x, in_d = has_d && d->x0 <= x;
      const int next_t = !has_t ? kNever
                         : in_t ? t->x1
                                : t->x0,
                next_d = !has_d ? kNever
                         : in_d ? d->x1
                                : d->x0;
      const int next = std::min(next_t, next_d);
      if (in_t != in_d) on_run({row.first, row.second, x, next}, in_t);
      x = next;
      if (has_t && t->x1 == x) ++t;
      if (has_d && d->x1 == x) ++d;
    }
  }
}

ErrorDistance::ErrorDistance(std::span<const glm::dvec3> outline) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  low_x_ = low_y_ = kInfinity, high_x_ = high_y_ = -kInfinity;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec3 &from = outline[i], &to = outline[(i + 1) % outline.size()];
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double length = std::sqrt(dx * dx + dy * dy), scale = length > 0.0 ? 1.0 / length : 0.0;
    lines_.push_back({from.x, from.y, -dy * scale, dx * scale});
    low_x_ = std::min(low_x_, from.x), low_y_ = std::min(low_y_, from.y);
    high_x_ = std::max(high_x_, from.x), high_y_ = std::max(high_y_, from.y);
  }
}

double ErrorDistance::at(int px, int py) const {
  const double sx = px + 0.5, sy = py + 0.5;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Line& line : lines_)
    nearest = std::min(nearest, std::abs((sx - line.x) * line.normal_x + (sy - line.y) * line.normal_y));
  return std::max({nearest, low_x_ - sx, sx - high_x_, low_y_ - sy, sy - high_y_});
}

DrawnRuns::DrawnRuns(std::vector<Run> drawn, Window window) : out_of_bounds(cut(drawn, window)) {
  if (!std::is_sorted(drawn.begin(), drawn.end())) std::sort(drawn.begin(), drawn.end());
  runs = joined(std::move(drawn));
}

DrawnRuns DrawnRuns::of_sources(std::span<const std::uint32_t> sources) const {
  DrawnRuns drawn = *this;
  if (sources.empty()) return drawn;
  for (Run& run : drawn.runs) run.triangle = sources[run.triangle];
  std::sort(drawn.runs.begin(), drawn.runs.end());  // the pieces of a clipped triangle have one source
  drawn.runs = joined(std::move(drawn.runs));
  return drawn;
}

DrawnRuns::DrawnRuns(const CoverageMethod& method, const CoverageInput& input, Window window)
    : DrawnRuns(
          [&] {
            std::vector<Run> drawn;
            method.runs(input, window, drawn);
            return drawn;
          }(),
          window) {}

CoverageScore score_coverage(const CoverageTruth& truth, const DrawnRuns& drawn, const SourceTruth& source) {
  CoverageScore score{.out_of_bounds = drawn.out_of_bounds};
  for_each_difference(truth.runs, drawn.runs, [&](const Run& run, bool missing) {
    (missing ? score.missing : score.extra) += length(run);
    const ErrorDistance distance(source.outline(run.triangle));
    for (int x = run.x0; x < run.x1; ++x) {
      score.worst_px = std::max(score.worst_px, distance.at(x, run.y));
      if (!missing) score.out_of_box += distance.off_box(x, run.y);
    }
  });
  return score;
}

CoverageScore score_coverage(const CoverageTruth& truth, const DrawnRuns& drawn,
                             std::span<const FloatTriangle> triangles) {
  return score_coverage(truth, drawn, FloatSource(triangles));
}

const SourceTruth& source_of(const CoverageScene& scene, const FloatSource& floats) {
  return scene.truth ? static_cast<const SourceTruth&>(*scene.truth) : floats;
}

SourceJudge::SourceJudge(const CoverageScene& scene, int threads)
    : scene_(scene),
      by_floats_(scene.floats),
      source_(source_of(scene, by_floats_)),
      floats_(float_coverage(scene.input(), scene.window(), threads)) {
  if (scene.truth) exact_ = coverage_of(source_, scene.window(), threads);
}

}  // namespace edgewise::lab
