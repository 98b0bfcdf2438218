#include "lab/truth/truth.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/parallel.h"

namespace edgewise::lab {

namespace {

__extension__ using Wide = __int128;

// Twice the signed area of (o, a, b), in the arithmetic of T.
template <typename T>
T cross(const T& ox, const T& oy, const T& ax, const T& ay, const T& bx, const T& by) {
  return T((ax - ox) * (by - oy)) - T((ay - oy) * (bx - ox));
}

// Depth at s of the plane through three vertices, each weighted by the area opposite to it.
template <typename T>
T plane(const T (&x)[3], const T (&y)[3], const T (&z)[3], const T& sx, const T& sy) {
  const T w0 = cross(x[1], y[1], x[2], y[2], sx, sy), w1 = cross(x[2], y[2], x[0], y[0], sx, sy),
          w2 = cross(x[0], y[0], x[1], y[1], sx, sy);
  return T(T(w0 * z[0]) + T(w1 * z[1]) + T(w2 * z[2])) / cross(x[0], y[0], x[1], y[1], x[2], y[2]);
}

template <typename T, typename From>
T plane_of(const From (&x)[3], const From (&y)[3], const double (&z)[3], double sx, double sy) {
  const T xs[3] = {T(x[0]), T(x[1]), T(x[2])}, ys[3] = {T(y[0]), T(y[1]), T(y[2])},
          zs[3] = {T(z[0]), T(z[1]), T(z[2])};
  return plane(xs, ys, zs, T(sx), T(sy));
}

int sign_of(Wide v) {
  return (v > 0) - (v < 0);
}

int snapped_side(const ScreenTriangle& t, int from, int to, Wide sx, Wide sy) {
  return sign_of(
      cross(Wide{t.x_q15[from]}, Wide{t.y_q15[from]}, Wide{t.x_q15[to]}, Wide{t.y_q15[to]}, sx, sy));
}

int float_side(const UnsnappedTriangle& t, int from, int to, double sx, double sy) {
  const double px = double{t.x_px[from]}, py = double{t.y_px[from]}, qx = double{t.x_px[to]},
               qy = double{t.y_px[to]};
  const Ball estimate = cross(Ball(px), Ball(py), Ball(qx), Ball(qy), Ball(sx), Ball(sy));
  if (const int sign = estimate.sign(); sign != 0) return sign;
  return sgn(cross(mpq_class(px), mpq_class(py), mpq_class(qx), mpq_class(qy), mpq_class(sx), mpq_class(sy)));
}

constexpr double sample_px(int pixel) {
  return pixel + 0.5;
}

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

// The covered pixels of a row, as [first, second). Along a row each edge accepts the pixels on one side of a
// position. The crossing in double is only a guess for that position; the exact rule decides.
template <typename Truth>
std::pair<int, int> covered_in_row(const Truth& truth, int y, int low, int high) {
  for (int i = 0; i < 3 && low < high; ++i) {
    const int lean = truth.rule().lean(i), next = (i + 1) % 3;
    if (lean == 0) {
      if (!truth.accepts(i, low, y)) return {low, low};
      continue;
    }
    const double slope = (truth.x_px(next) - truth.x_px(i)) / (truth.y_px(next) - truth.y_px(i));
    const double crossing = truth.x_px(i) + (sample_px(y) - truth.y_px(i)) * slope + 0.5;
    const int guess =
        crossing > low ? (crossing < high ? static_cast<int>(std::floor(crossing)) : high) : low;
    const bool wanted = lean > 0;
    const int change = first_where(low, high, guess, [&](int x) { return truth.accepts(i, x, y) == wanted; });
    (wanted ? low : high) = change;
  }
  return {low, std::max(low, high)};
}

struct Box {
  int x0, y0, x1, y1;
};

// The candidate pixels: those inside the window that overlap the triangle's bounding box.
template <typename Truth>
Box box_of(const Truth& truth, Window window) {
  const auto [low_x, high_x] = std::minmax({truth.x_px(0), truth.x_px(1), truth.x_px(2)});
  const auto [low_y, high_y] = std::minmax({truth.y_px(0), truth.y_px(1), truth.y_px(2)});
  const auto clip = [](double v, int low, int high) {
    return static_cast<int>(std::clamp(v, static_cast<double>(low), static_cast<double>(high)));
  };
  return {clip(std::floor(low_x), window.x0, window.x1()), clip(std::floor(low_y), window.y0, window.y1()),
          clip(std::ceil(high_x), window.x0, window.x1()), clip(std::ceil(high_y), window.y0, window.y1())};
}

// Calls emit(y, x0, x1) for each covered run, from the top down.
template <typename Truth, typename Emit>
void for_each_run(const Truth& truth, Window window, Emit&& emit) {
  if (truth.facing() == 0) return;
  const Box box = box_of(truth, window);
  for (int y = box.y0; y < box.y1; ++y) {
    const auto [begin, end] = covered_in_row(truth, y, box.x0, box.x1);
    if (begin < end) emit(y, begin, end);
  }
}

SnappedTruth truth_of(const ScreenTriangle& t) {
  return SnappedTruth(t);
}
FloatTruth truth_of(const FloatTriangle& t) {
  return FloatTruth(t.at);
}

// A cheap test before the exact truth: whether the triangle's bounding box reaches these rows.
template <typename Y>
bool reaches_rows(const Y (&y)[3], double units_per_px, Window rows) {
  const auto [low, high] = std::minmax({y[0], y[1], y[2]});
  return static_cast<double>(high) >= rows.y0 * units_per_px &&
         static_cast<double>(low) <= rows.y1() * units_per_px;
}
bool reaches_rows(const ScreenTriangle& t, Window rows) {
  return reaches_rows(t.y_q15, 32768.0, rows);
}
bool reaches_rows(const FloatTriangle& t, Window rows) {
  return reaches_rows(t.at.y_px, 1.0, rows);
}

template <typename Triangle>
std::vector<Run> all_runs(std::span<const Triangle> triangles, Window window, int threads) {
  constexpr std::size_t kTrianglesPerTask = 1024;
  const std::size_t tasks = (triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
  std::vector<std::vector<Run>> runs_of(tasks);
  parallel_for(threads, static_cast<int>(tasks), [&](int task) {
    const auto t = static_cast<std::size_t>(task);
    for (std::size_t i = t * kTrianglesPerTask; i < std::min(triangles.size(), (t + 1) * kTrianglesPerTask);
         ++i)
      for_each_run(truth_of(triangles[i]), window, [&](int y, int begin, int end) {
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

template <typename Triangle>
class VisibleTriangleFinder {
 public:
  VisibleTriangleFinder(std::span<const Triangle> triangles, Window window)
      : triangles_(triangles),
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
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (!reaches_rows(triangles_[i], band)) continue;
      const auto truth = truth_of(triangles_[i]);
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
          const bool close = depth.error <= 0x1p-41 * std::abs(depth.value);
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
    return truth.depth(x, y) < truth_of(triangles_[visible_id]).depth(x, y);
  }

  std::span<const Triangle> triangles_;
  VisibleTriangles result_;
};

}  // namespace

SnappedTruth::SnappedTruth(const ScreenTriangle& triangle)
    : triangle_(triangle),
      rule_(triangle.y_q15, snapped_side(triangle, 0, 1, triangle.x_q15[2], triangle.y_q15[2])) {}

bool SnappedTruth::accepts(int edge, int px, int py) const {
  return rule_.accepts(edge, snapped_side(triangle_, edge, (edge + 1) % 3, Wide{px} * 32768 + 16384,
                                          Wide{py} * 32768 + 16384));
}

bool SnappedTruth::covers(int px, int py) const {
  return facing() != 0 && accepts(0, px, py) && accepts(1, px, py) && accepts(2, px, py);
}

mpq_class SnappedTruth::depth(int px, int py) const {
  const double z[3] = {double(triangle_.z[0]), double(triangle_.z[1]), double(triangle_.z[2])};
  return plane_of<mpq_class>(triangle_.x_q15, triangle_.y_q15, z, sample_px(px) * 32768,
                             sample_px(py) * 32768);
}

Ball SnappedTruth::depth_estimate(int px, int py) const {
  const double z[3] = {double(triangle_.z[0]), double(triangle_.z[1]), double(triangle_.z[2])};
  return plane_of<Ball>(triangle_.x_q15, triangle_.y_q15, z, sample_px(px) * 32768, sample_px(py) * 32768);
}

FloatTruth::FloatTruth(const UnsnappedTriangle& triangle)
    : triangle_(triangle),
      rule_(triangle.y_px, float_side(triangle, 0, 1, double{triangle.x_px[2]}, double{triangle.y_px[2]})) {}

bool FloatTruth::accepts(int edge, int px, int py) const {
  return rule_.accepts(edge, float_side(triangle_, edge, (edge + 1) % 3, sample_px(px), sample_px(py)));
}

bool FloatTruth::covers(int px, int py) const {
  return facing() != 0 && accepts(0, px, py) && accepts(1, px, py) && accepts(2, px, py);
}

mpq_class FloatTruth::depth(int px, int py) const {
  const double z[3] = {double{triangle_.z01[0]}, double{triangle_.z01[1]}, double{triangle_.z01[2]}};
  return plane_of<mpq_class>(triangle_.x_px, triangle_.y_px, z, sample_px(px), sample_px(py));
}

Ball FloatTruth::depth_estimate(int px, int py) const {
  const double z[3] = {double{triangle_.z01[0]}, double{triangle_.z01[1]}, double{triangle_.z01[2]}};
  return plane_of<Ball>(triangle_.x_px, triangle_.y_px, z, sample_px(px), sample_px(py));
}

std::vector<Run> covered_runs(std::span<const ScreenTriangle> triangles, Window window, int threads) {
  return all_runs(triangles, window, threads);
}
std::vector<Run> covered_runs(std::span<const FloatTriangle> triangles, Window window, int threads) {
  return all_runs(triangles, window, threads);
}
VisibleTriangles exact_visible_triangles(std::span<const ScreenTriangle> triangles, Window window,
                                         int threads) {
  return VisibleTriangleFinder(triangles, window).run(threads);
}
VisibleTriangles exact_visible_triangles(std::span<const FloatTriangle> triangles, Window window,
                                         int threads) {
  return VisibleTriangleFinder(triangles, window).run(threads);
}

}  // namespace edgewise::lab
