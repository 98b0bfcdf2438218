#include "lab/coverage/score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace edgewise::lab {

namespace {

std::uint64_t length(const Run& run) {
  return static_cast<std::uint64_t>(run.x1 - run.x0);
}

CoverageTruth truth_from(std::vector<Run> runs, Window window) {
  CoverageTruth truth{window, std::move(runs), {}, 0};
  truth.hits = hits_of(truth.runs, window);
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

using Position = std::pair<float, float>;

Position vertex(const UnsnappedTriangle& t, int i) {
  return {t.x_px[i], t.y_px[i]};
}

// The larger of the numbers of sample rows and sample columns that the segment crosses inside the window.
double crossings_of(Position from, Position to, Window w) {
  const double x = double{from.first}, y = double{from.second}, dx = double{to.first} - x,
               dy = double{to.second} - y;
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

bool share_a_vertex(const UnsnappedTriangle& a, const UnsnappedTriangle& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (vertex(a, i) == vertex(b, j)) return true;
  return false;
}

// Counts pixels that at most one triangle covers in truth, but that are in the runs of two neighbours, or
// twice in those of one triangle. Each triangle is compared with the last kRemembered ones at its pixel, so
// that the cost stays linear where overflow lets hundreds of triangles cover a pixel.
std::uint64_t count_double_hits(const CoverageTruth& truth, std::span<const std::uint32_t> hits,
                                std::span<const Run> runs, std::span<const FloatTriangle> triangles) {
  constexpr std::uint32_t kRemembered = 8, kNone = std::numeric_limits<std::uint32_t>::max();
  struct Suspect {
    std::uint32_t triangles[kRemembered], seen = 0;
    bool twice = false;
  };
  std::vector<Suspect> suspects;
  std::vector<std::uint32_t> suspect_of(hits.size(), kNone);
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i] >= 2 && truth.hits[i] <= 1) {
      suspect_of[i] = static_cast<std::uint32_t>(suspects.size());
      suspects.emplace_back();
    }
  if (suspects.empty()) return 0;  // of most methods, the runs need no look
  std::uint64_t count = 0;
  const Window w = truth.window;
  for (const Run& run : runs) {
    const std::uint32_t* const row =
        &suspect_of[static_cast<std::size_t>(run.y - w.y0) * static_cast<std::size_t>(w.width)];
    for (int x = run.x0; x < run.x1; ++x) {
      if (row[x - w.x0] == kNone) continue;
      Suspect& suspect = suspects[row[x - w.x0]];
      if (suspect.twice) continue;
      for (std::uint32_t i = 0; i < std::min(suspect.seen, kRemembered) && !suspect.twice; ++i)
        suspect.twice = share_a_vertex(triangles[suspect.triangles[i]].at, triangles[run.triangle].at);
      count += suspect.twice;
      suspect.triangles[suspect.seen++ % kRemembered] = run.triangle;
    }
  }
  return count;
}

}  // namespace

CoverageTruth snapped_coverage(const CoverageInput& input, Window window, int threads) {
  return truth_from(covered_runs(input.snapped, window, threads), window);
}

CoverageTruth float_coverage(const CoverageInput& input, Window window, int threads) {
  return truth_from(covered_runs(input.floats, window, threads), window);
}

std::uint64_t edge_crossings(std::span<const FloatTriangle> triangles, Window window) {
  double crossings = 0.0;
  for (const auto& [t, payload] : triangles)
    for (int i = 0; i < 3; ++i) crossings += crossings_of(vertex(t, i), vertex(t, (i + 1) % 3), window);
  return static_cast<std::uint64_t>(crossings);
}

std::uint64_t shared_edge_crossings(std::span<const FloatTriangle> triangles, Window window) {
  using ScreenEdge = std::pair<Position, Position>;
  std::vector<ScreenEdge> edges;
  edges.reserve(3 * triangles.size());
  for (const auto& [t, payload] : triangles)
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax({vertex(t, i), vertex(t, (i + 1) % 3)});  // by value
      edges.emplace_back(a, b);
    }
  std::sort(edges.begin(), edges.end());
  double crossings = 0.0;
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    if (next - edge > 1) crossings += crossings_of(edge->first, edge->second, window);
    edge = next;
  }
  return static_cast<std::uint64_t>(crossings);
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

std::vector<std::uint32_t> hits_of(std::span<const Run> runs, Window w) {
  std::vector<std::uint32_t> hits(static_cast<std::size_t>(w.width) * static_cast<std::size_t>(w.height), 0);
  for (const Run& run : runs) {
    if (run.y < w.y0 || run.y >= w.y1()) continue;
    std::uint32_t* row = &hits[static_cast<std::size_t>(run.y - w.y0) * static_cast<std::size_t>(w.width)];
    for (int x = std::max(run.x0, w.x0); x < std::min(run.x1, w.x1()); ++x) ++row[x - w.x0];
  }
  return hits;
}

ErrorDistance::ErrorDistance(const UnsnappedTriangle& t) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double dx = double{t.x_px[j]} - double{t.x_px[i]}, dy = double{t.y_px[j]} - double{t.y_px[i]};
    const double length = std::hypot(dx, dy), scale = length > 0.0 ? 1.0 / length : 0.0;
    lines_[i] = {double{t.x_px[i]}, double{t.y_px[i]}, -dy * scale, dx * scale};
  }
  const auto [low_x, high_x] = std::minmax({t.x_px[0], t.x_px[1], t.x_px[2]});
  const auto [low_y, high_y] = std::minmax({t.y_px[0], t.y_px[1], t.y_px[2]});
  low_x_ = double{low_x}, low_y_ = double{low_y}, high_x_ = double{high_x}, high_y_ = double{high_y};
}

double ErrorDistance::at(int px, int py) const {
  const double sx = px + 0.5, sy = py + 0.5;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Line& line : lines_)
    nearest = std::min(nearest, std::abs((sx - line.x) * line.normal_x + (sy - line.y) * line.normal_y));
  return std::max({nearest, low_x_ - sx, sx - high_x_, low_y_ - sy, sy - high_y_});
}

CoverageScore score_coverage(const CoverageTruth& truth, std::vector<Run> runs,
                             std::span<const FloatTriangle> triangles, double reach_px) {
  CoverageScore score{.triangles = triangles.size(), .covered = truth.covered};
  score.out_of_bounds = cut(runs, truth.window);
  const auto hits = hits_of(runs, truth.window);
  score.gaps = gaps(truth, hits, triangles, reach_px).size();
  score.double_hits = count_double_hits(truth, hits, runs, triangles);
  if (!std::is_sorted(runs.begin(), runs.end())) std::sort(runs.begin(), runs.end());
  for_each_difference(truth.runs, joined(std::move(runs)), [&](const Run& run, bool missing) {
    (missing ? score.missing : score.extra) += length(run);
    const ErrorDistance distance(triangles[run.triangle].at);
    for (int x = run.x0; x < run.x1; ++x) {
      score.worst_px = std::max(score.worst_px, distance.at(x, run.y));
      if (!missing) score.out_of_box += distance.off_box(x, run.y);
    }
  });
  return score;
}

CoverageScore score_coverage(const CoverageTruth& truth, const CoverageMethod& method,
                             const CoverageInput& input) {
  std::vector<Run> runs;
  method.runs(input, truth.window, runs);
  return score_coverage(truth, std::move(runs), input.floats, gap_reach_px(method));
}

}  // namespace edgewise::lab
