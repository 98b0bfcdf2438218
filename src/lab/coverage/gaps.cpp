// Distinguishes cracks from moved outlines: an undrawn sample is a gap if the triangles together contain all
// points of a ring around it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lab/coverage/score.h"

namespace edgewise::lab {

namespace {

// The ring's points are the corners of a polygon around the circle whose radius is the reach. For a reach of
// 0 the ring is still wide enough that doubles separate inside from outside: they err by 1e-9 px below 2^20
// px.
constexpr int kPoints = 16;
constexpr std::uint32_t kAllPoints = (1u << kPoints) - 1;
constexpr double kTolerance_px = 1e-9, kLeastReach_px = 1e-8;

class Ring {
 public:
  explicit Ring(double reach_px)
      : radius_((reach_px + kLeastReach_px) / std::cos(std::numbers::pi / kPoints)) {
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2 * std::numbers::pi * i / kPoints;
      x_[static_cast<std::size_t>(i)] = radius_ * std::cos(angle);
      y_[static_cast<std::size_t>(i)] = radius_ * std::sin(angle);
    }
  }
  double radius() const { return radius_; }

  // A bit per point that lies inside all three lines, given the centre's distance inside each.
  template <typename Lines>
  std::uint32_t inside(const Lines& lines, const std::array<double, 3>& depth_px) const {
    const double least = std::min({depth_px[0], depth_px[1], depth_px[2]});
    if (least < -radius_) return 0;
    if (least > radius_) return kAllPoints;
    std::uint32_t points = 0;
    for (std::size_t k = 0; k < kPoints; ++k) {
      bool in = true;
      for (std::size_t i = 0; i < 3; ++i)
        in &= depth_px[i] + lines[i].normal_x * x_[k] + lines[i].normal_y * y_[k] >= -kTolerance_px;
      points |= std::uint32_t{in} << k;
    }
    return points;
  }

 private:
  double radius_;
  std::array<double, kPoints> x_{}, y_{};
};

// A triangle as three lines, their unit normals pointing inwards.
class Inside {
 public:
  explicit Inside(const UnsnappedTriangle& t) {
    for (std::size_t i = 0; i < 3; ++i) x_[i] = double{t.x_px[i]}, y_[i] = double{t.y_px[i]};
    const double area = (x_[1] - x_[0]) * (y_[2] - y_[0]) - (y_[1] - y_[0]) * (x_[2] - x_[0]);
    has_area_ = area != 0.0;
    if (!has_area_) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const double dx = x_[j] - x_[i], dy = y_[j] - y_[i];
      const double scale = std::copysign(1.0 / std::hypot(dx, dy), area);
      lines_[i] = {-dy * scale, dx * scale};
    }
  }
  bool has_area() const { return has_area_; }
  std::pair<double, double> columns() const { return std::minmax({x_[0], x_[1], x_[2]}); }
  std::pair<double, double> rows() const { return std::minmax({y_[0], y_[1], y_[2]}); }

  std::uint32_t points(const Ring& ring, double sx, double sy) const {
    std::array<double, 3> depth_px;
    for (std::size_t i = 0; i < 3; ++i)
      depth_px[i] = (sx - x_[i]) * lines_[i].normal_x + (sy - y_[i]) * lines_[i].normal_y;
    return ring.inside(lines_, depth_px);
  }

 private:
  struct Line {
    double normal_x, normal_y;
  };
  std::array<double, 3> x_{}, y_{};
  std::array<Line, 3> lines_{};
  bool has_area_ = false;
};

// Undrawn samples, sorted by rows, so that a triangle visits only those in its bounding box.
class LostSamples {
 public:
  LostSamples(const CoverageTruth& truth, std::span<const std::uint32_t> hits) : window_(truth.window) {
    std::size_t pixel = 0;
    for (int y = window_.y0; y < window_.y1(); ++y) {
      row_.push_back(list_.size());
      for (int x = window_.x0; x < window_.x1(); ++x, ++pixel)
        if (truth.hits[pixel] == 1 && hits[pixel] == 0) list_.push_back({x, 0, pixel});
    }
    row_.push_back(list_.size());
  }
  bool none() const { return list_.empty(); }

  void meet(const Inside& triangle, const Ring& ring) {
    const auto [left, right] = triangle.columns();
    const auto [top, bottom] = triangle.rows();
    const double reach = ring.radius(), leftmost = left - reach;
    const int first = row_at(std::ceil(top - reach - 0.5)),
              end = row_at(std::floor(bottom + reach - 0.5) + 1);
    for (int row = first; row < end; ++row) {
      const auto begin = list_.begin() + static_cast<std::ptrdiff_t>(row_[static_cast<std::size_t>(row)]),
                 stop = list_.begin() + static_cast<std::ptrdiff_t>(row_[static_cast<std::size_t>(row) + 1]);
      if (begin == stop) continue;
      auto sample = std::partition_point(begin, stop, [&](const Sample& s) { return s.x + 0.5 < leftmost; });
      for (; sample != stop && sample->x + 0.5 <= right + reach; ++sample)
        sample->points |= triangle.points(ring, sample->x + 0.5, window_.y0 + row + 0.5);
    }
  }

  std::vector<std::size_t> enclosed() const {
    std::vector<std::size_t> pixels;
    for (const Sample& sample : list_)
      if (sample.points == kAllPoints) pixels.push_back(sample.pixel);
    return pixels;
  }

 private:
  struct Sample {
    int x;
    std::uint32_t points;  // a bit per ring point that some triangle contains
    std::size_t pixel;
  };
  int row_at(double y) const {
    return static_cast<int>(std::clamp(y - window_.y0, 0.0, static_cast<double>(window_.height)));
  }

  Window window_;
  std::vector<Sample> list_;
  std::vector<std::size_t> row_;  // where each row begins in the list
};

}  // namespace

std::vector<std::size_t> gaps(const CoverageTruth& truth, std::span<const std::uint32_t> hits,
                              std::span<const FloatTriangle> triangles, double reach_px) {
  LostSamples lost(truth, hits);
  if (lost.none()) return {};
  const Ring ring(reach_px);
  for (const FloatTriangle& triangle : triangles)
    if (const Inside inside(triangle.at); inside.has_area()) lost.meet(inside, ring);
  return lost.enclosed();
}

}  // namespace edgewise::lab
