// Scans an image for what triangles cover, by a truth: a class of one triangle, with
//   facing()            1 front (clockwise), -1 back, 0 if it draws nothing
//   sides()             the number of its conditions: each accepts the samples on one side of a line
//   lean(i)             the side of line i on which they lie: 1 right, -1 left, 0 if the line is horizontal
//   accepts(i, px, py)  exact
//   crossing(i, py)     where line i crosses the samples of a row, px; a guess
//   box(window)         the candidate pixels
//   depth(px, py), depth_estimate(px, py), and kDepthError, the error to which the estimate counts as known
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "lab/truth/truth.h"

namespace edgewise::lab {

// The smallest k in [low, high] with holds(k); high if there is none below it. `holds` must be monotone:
// false, then true. A correct guess saves the binary search.
template <typename Predicate>
int first_where(int low, int high, int guess, Predicate&& holds) {
  guess = std::clamp(guess, low, high);
  if (guess < high && !holds(guess))
    low = guess + 1;
  else if (guess > low && holds(guess - 1))
    high = guess - 1;
  else
    return guess;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (holds(middle))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// The covered pixels of a row, as [first, second). Along a row each side accepts the pixels on one side of a
// position. The crossing is only a guess for that position; the exact rule decides.
template <typename Truth>
std::pair<int, int> covered_in_row(const Truth& truth, int y, int low, int high) {
  for (std::size_t i = 0; i < truth.sides() && low < high; ++i) {
    const int lean = truth.lean(i);
    if (lean == 0) {
      if (!truth.accepts(i, low, y)) return {low, low};
      continue;
    }
    const double crossing = truth.crossing(i, y) + 0.5;
    const int guess =
        crossing > low ? (crossing < high ? static_cast<int>(std::floor(crossing)) : high) : low;
    const bool wanted = lean > 0;
    const int change = first_where(low, high, guess, [&](int x) { return truth.accepts(i, x, y) == wanted; });
    (wanted ? low : high) = change;
  }
  return {low, std::max(low, high)};
}

// Calls emit(y, x0, x1) for each covered run, from the top down.
template <typename Truth, typename Emit>
void for_each_run(const Truth& truth, Window window, Emit&& emit) {
  if (truth.facing() == 0) return;
  const PixelBounds box = truth.box(window);
  for (int y = box.y0; y < box.y1; ++y) {
    const auto [begin, end] = covered_in_row(truth, y, box.x0, box.x1);
    if (begin < end) emit(y, begin, end);
  }
}

// truth_of(i) is the truth of triangle i of `triangles`.
template <typename TruthOf>
std::vector<Run> all_runs(std::size_t triangles, TruthOf&& truth_of, Window window, int threads) {
  constexpr std::size_t kTrianglesPerTask = 1024;
  const std::size_t tasks = (triangles + kTrianglesPerTask - 1) / kTrianglesPerTask;
  std::vector<std::vector<Run>> runs_of(tasks);
  parallel_for(threads, static_cast<int>(tasks), [&](int task) {
    const auto t = static_cast<std::size_t>(task);
    for (std::size_t i = t * kTrianglesPerTask; i < std::min(triangles, (t + 1) * kTrianglesPerTask); ++i)
      for_each_run(truth_of(i), window, [&](int y, int begin, int end) {
        runs_of[t].push_back({static_cast<std::uint32_t>(i), y, begin, end});
      });
  });
  std::size_t count = 0;
  for (const auto& some : runs_of) count += some.size();
  std::vector<Run> runs;
  runs.reserve(count);
  for (const auto& some : runs_of) runs.insert(runs.end(), some.begin(), some.end());
  return runs;
}

// reaches_rows(i, window) is a cheap test before truth_of(i).
template <typename TruthOf, typename ReachesRows>
class VisibleTriangleFinder {
 public:
  VisibleTriangleFinder(std::size_t triangles, TruthOf truth_of, ReachesRows reaches_rows, Window window)
      : triangles_(triangles),
        truth_of_(truth_of),
        reaches_rows_(reaches_rows),
        result_{window, std::vector(pixels(window), kNoTriangle),
                std::vector(pixels(window), std::numeric_limits<double>::infinity())} {}

  VisibleTriangles run(int threads) && {
    constexpr int kRows = 16;
    const Window& window = result_.window;
    parallel_for(threads, (window.height + kRows - 1) / kRows, [&](int band) {
      const int y0 = window.y0 + band * kRows;
      find({window.width, std::min(kRows, window.y1() - y0), window.x0, y0});
    });
    return std::move(result_);
  }

 private:
  static std::size_t pixels(Window w) {
    return static_cast<std::size_t>(w.width) * static_cast<std::size_t>(w.height);
  }

  void find(Window band) {
    std::vector<Ball> nearest(pixels(band), Ball(0.0));
    for (std::size_t i = 0; i < triangles_; ++i) {
      if (!reaches_rows_(i, band)) continue;
      const auto truth = truth_of_(i);
      for_each_run(truth, band, [&](int y, int begin, int end) {
        for (int x = begin; x < end; ++x) {
          const auto in_band = static_cast<std::size_t>(y - band.y0) * static_cast<std::size_t>(band.width) +
                               static_cast<std::size_t>(x - band.x0);
          const std::size_t at = in_band + static_cast<std::size_t>(band.y0 - result_.window.y0) *
                                               static_cast<std::size_t>(band.width);
          const Ball depth = truth.depth_estimate(x, y);
          if (!wins(truth, depth, result_.triangle[at], nearest[in_band], x, y)) continue;
          nearest[in_band] = depth;
          result_.triangle[at] = static_cast<std::uint32_t>(i);
          const bool close = depth.error <= std::max(0x1p-41 * std::abs(depth.value), truth.kDepthError);
          result_.depth[at] = close ? depth.value : truth.depth(x, y).get_d();
        }
      });
    }
  }

  template <typename Truth>
  bool wins(const Truth& truth, const Ball& depth, std::uint32_t visible_id, const Ball& nearest, int x,
            int y) const {
    if (visible_id == kNoTriangle) return true;
    if (const int sign = (depth - nearest).sign(); sign != 0) return sign < 0;
    return truth.depth(x, y) < truth_of_(visible_id).depth(x, y);
  }

  std::size_t triangles_;
  TruthOf truth_of_;
  ReachesRows reaches_rows_;
  VisibleTriangles result_;
};

}  // namespace edgewise::lab
