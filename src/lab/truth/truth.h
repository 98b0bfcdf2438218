// The exact truths of positions on the screen. Both apply the fill rule at each sample.
//   SnappedTruth: on the snapped positions, in 128-bit integers. Errors against it are errors of arithmetic.
//   FloatTruth:   on the positions before snapping, in doubles with an error bound, and in GMP's rationals
//   where
//                 the bound leaves a sign open. Errors against it are errors of arithmetic and of snapping.
// They share no arithmetic with edgewise/contract.h or with any backend. A scene's positions come from a
// front end, which errs before them: SceneTruth (lab/projection/truth.h) begins at the scene's vertices.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "edgewise/frontend.h"
#include "edgewise/screen_triangle.h"
#include "lab/method.h"
#include "lab/truth/ball_arithmetic.h"

namespace edgewise::lab {

// The part of the pixel plane that is drawn and compared. Images begin at (0, 0); windows elsewhere test
// coordinates far from the origin.
struct Window {
  int width, height;  // px
  int x0 = 0, y0 = 0;

  int x1() const { return x0 + width; }
  int y1() const { return y0 + height; }
};

// Pixels [x0, x1) of rows [y0, y1).
struct PixelBounds {
  int x0, y0, x1, y1;
};
// The pixels inside the window that a box touches.
PixelBounds pixels_between(double x0, double y0, double x1, double y1, Window window);

// Pixels [x0, x1) of a row, drawn for one triangle.
struct Run {
  std::uint32_t triangle;  // index
  std::int32_t y, x0, x1;
  auto operator<=>(const Run&) const = default;
};

// A sample strictly inside is covered; one on an edge is covered if the triangle lies below that edge (a top
// edge) or to the right of it (a left edge).
class FillRule {
 public:
  static constexpr double kDepthError = 0.0;  // of exact planes

  // `facing` is the sign of cross(v0, v1, v2) below: 1 is clockwise on the y-down screen.
  template <typename Y>
  FillRule(const Y (&y)[3], int facing) : facing_(facing) {
    for (int i = 0; i < 3; ++i) {
      const Y &from = y[i], &to = y[(i + 1) % 3], &third = y[(i + 2) % 3];
      // A clockwise triangle lies to the right of an edge that runs upwards.
      lean_[i] = from == to ? 0 : from > to ? facing : -facing;
      accepts_ties_[i] = lean_[i] > 0 || (lean_[i] == 0 && third > from);
    }
  }
  int facing() const { return facing_; }  // 1 front (clockwise), -1 back, 0 without area
  std::size_t sides() const { return 3; }
  // The side of an edge on which the triangle lies: 1 right, -1 left, 0 if the edge is horizontal.
  int lean(std::size_t edge) const { return lean_[edge]; }
  // `side` is the sign of cross(from, to, sample).
  bool accepts(std::size_t edge, int side) const { return side == 0 ? accepts_ties_[edge] : side == facing_; }

 private:
  int facing_, lean_[3];
  bool accepts_ties_[3];
};

// What both truths share. They have the same interface, which lab/truth/scan.h states, and x_px(vertex) and
// y_px(vertex). Edge i runs from vertex i to the next one; a pixel's sample is its centre.
template <typename Truth>
class ScreenTruth : public FillRule {
 public:
  using FillRule::FillRule;
  bool covers(int px, int py) const {
    const Truth& t = self();
    return facing() != 0 && t.accepts(0, px, py) && t.accepts(1, px, py) && t.accepts(2, px, py);
  }
  double crossing(std::size_t edge, int py) const {
    const std::size_t next = (edge + 1) % 3;
    const double x = self().x_px(edge), y = self().y_px(edge);
    return x + (py + 0.5 - y) * ((self().x_px(next) - x) / (self().y_px(next) - y));
  }
  PixelBounds box(Window window) const {
    const auto [low_x, high_x] = std::minmax({self().x_px(0), self().x_px(1), self().x_px(2)});
    const auto [low_y, high_y] = std::minmax({self().y_px(0), self().y_px(1), self().y_px(2)});
    return pixels_between(low_x, low_y, high_x, high_y, window);
  }

 private:
  const Truth& self() const { return static_cast<const Truth&>(*this); }
};

class SnappedTruth : public ScreenTruth<SnappedTruth> {
 public:
  explicit SnappedTruth(const ScreenTriangle& triangle);
  bool accepts(std::size_t edge, int px, int py) const;
  // On the exact plane, in depth units of rule 6. The triangle must have area.
  mpq_class depth(int px, int py) const;
  Ball depth_estimate(int px, int py) const;

  double x_px(std::size_t vertex) const { return triangle_.x_q15[vertex] / 32768.0; }
  double y_px(std::size_t vertex) const { return triangle_.y_q15[vertex] / 32768.0; }

 private:
  ScreenTriangle triangle_;
};

class FloatTruth : public ScreenTruth<FloatTruth> {
 public:
  // Coordinates and depths must be finite.
  explicit FloatTruth(const UnsnappedTriangle& triangle);
  // Positions in double; without depth.
  FloatTruth(const double (&x_px)[3], const double (&y_px)[3]);
  bool accepts(std::size_t edge, int px, int py) const;
  // On the exact plane, in the unit of z01. The triangle must have area.
  mpq_class depth(int px, int py) const;
  Ball depth_estimate(int px, int py) const;

  double x_px(std::size_t vertex) const { return x_[vertex]; }
  double y_px(std::size_t vertex) const { return y_[vertex]; }

 private:
  double x_[3], y_[3], z_[3] = {};
};

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFF;
// The visible triangle of each pixel, row by row: the nearest one, at a tie the earlier one, by exact
// comparison.
struct VisibleTriangles {
  Window window;
  std::vector<std::uint32_t> triangle;  // its index, or kNoTriangle
  std::vector<double> depth;            // of that triangle, within a relative error of 2^-40; else infinity

  std::uint32_t triangle_at(int x, int y) const {
    return triangle[static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(window.width) +
                    static_cast<std::size_t>(x - window.x0)];
  }
};
VisibleTriangles exact_visible_triangles(std::span<const ScreenTriangle> triangles, Window window,
                                         int threads);
VisibleTriangles exact_visible_triangles(std::span<const FloatTriangle> triangles, Window window,
                                         int threads);

// What a picture is judged against before anything is projected or rounded. Triangles are numbered as they
// were submitted.
class SourceTruth {
 public:
  virtual ~SourceTruth() = default;
  virtual std::size_t size() const = 0;  // number of triangles
  // As covered_runs() below.
  virtual std::vector<Run> runs(Window window, int threads) const = 0;
  // The corners of a triangle's visible part, in order: x and y in pixels, depth from 0 to 1, rounded to
  // double. Empty if it draws nothing.
  virtual std::vector<glm::dvec3> outline(std::uint32_t triangle) const = 0;
  virtual VisibleTriangles visible_triangles(Window window, int threads) const = 0;
};

// All covered pixels, sorted by triangle and row; a triangle has at most one run per row.
std::vector<Run> covered_runs(std::span<const ScreenTriangle> triangles, Window window, int threads);
std::vector<Run> covered_runs(std::span<const FloatTriangle> triangles, Window window, int threads);

// The truth of triangles that come with screen positions. They must outlive it.
class FloatSource final : public SourceTruth {
 public:
  explicit FloatSource(std::span<const FloatTriangle> triangles) : triangles_(triangles) {}
  std::size_t size() const override { return triangles_.size(); }
  std::vector<Run> runs(Window window, int threads) const override {
    return covered_runs(triangles_, window, threads);
  }
  std::vector<glm::dvec3> outline(std::uint32_t triangle) const override;
  VisibleTriangles visible_triangles(Window window, int threads) const override {
    return exact_visible_triangles(triangles_, window, threads);
  }

 private:
  std::span<const FloatTriangle> triangles_;
};

}  // namespace edgewise::lab
