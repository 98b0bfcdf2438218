// Cracks: samples at an edge that two triangles of one surface share, which neither of them draws, or both.
// They are counted at the edge, whatever lies behind it or in front.
//
// Two corners are copies of one vertex if their x and y agree within 2^-10 px each, a quarter of our snapping
// grid, and their depths within 2^-20 of the range. Where the copies at a shared edge differ, exact
// arithmetic alone would allow a hole or an overlap there, which is seen like any other. The truth therefore
// moves them together before anything is rounded: to the least by x, then y, then depth, in any order of
// triangles. It then covers each sample at the edge once, and a sample that neither triangle draws is a gap,
// and one that both draw a double hit, whether rounding or the copies' difference causes it.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lab/coverage/score.h"

namespace edgewise::lab {

// Whether two triangles have copies of one vertex, or two outlines.
bool touch(const UnsnappedTriangle& a, const UnsnappedTriangle& b);
bool touch(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b);

// Which triangles of a picture adjoin. Two triangles share an edge if they lie on opposite sides of it and
// both have copies of its two vertices. If an edge has more than two triangles, the k-th on one side shares
// it with the k-th on the other, in submission order. Equal copies come before others.
//
// At a T-junction a vertex lies on an edge, so the triangles on both sides adjoin without sharing it:
// unshared edges that run along one another within 2^-10 px, in opposite directions, and whose depths agree
// within 2^-20 of the range.
class Surface {
 public:
  explicit Surface(std::span<const FloatTriangle> triangles);
  Surface(const Surface&) = delete;

  // The triangle on the other side of a shared edge; kNoTriangle if the edge is not shared.
  std::uint32_t across(std::uint32_t triangle, int edge) const {
    return across_[3 * triangle + edge_of(edge)];
  }
  bool has_t_junctions() const { return !t_junctions_.empty(); }
  // The triangles along the other side of an edge at T-junctions, as the second of each pair.
  std::span<const std::pair<std::uint32_t, std::uint32_t>> along(std::uint32_t triangle, int edge) const;
  // With the copies at shared edges moved together, if that moved any.
  std::span<const FloatTriangle> triangles() const { return triangles_; }
  bool moved() const { return !moved_.empty(); }
  // The edge nearest to a sample; at a tie one that is not shared.
  int nearest_edge(std::uint32_t triangle, int px, int py) const;

  // Whether two triangles share a vertex and do not overlap: there each lies outside the other's angle.
  bool side_by_side(std::uint32_t a, std::uint32_t b) const;

  // The sum over all shared edges: the larger of the numbers of sample rows and sample columns that the edge
  // crosses inside the window.
  std::uint64_t crossings(Window window) const;

 private:
  static std::size_t edge_of(int edge) { return static_cast<std::size_t>(edge); }
  void find_shared_edges();
  bool find_t_junctions();

  std::span<const FloatTriangle> triangles_;
  std::vector<FloatTriangle> moved_;  // empty if all copies are equal
  std::vector<std::int8_t> facing_;
  std::vector<std::uint32_t> across_;  // three per triangle
  // (3 triangle + edge, triangle along it), sorted
  std::vector<std::pair<std::uint32_t, std::uint32_t>> t_junctions_;
};

struct Sample {
  std::int32_t y, x;  // pixel
  auto operator<=>(const Sample&) const = default;
};

// Each list has a sample once per triangle that covers it.
struct Cracks {
  // A sample that a triangle covers, by exact coverage of the positions that the method itself uses.
  std::vector<Sample> gaps;         // drawn by no triangle of the surface that reaches it
  std::vector<Sample> double_hits;  // drawn by the triangle and by another one that shares an edge with it
  // The same at T-junctions, by exact coverage of the positions before snapping: snapping moves the vertex
  // off the edge, in every method that snaps.
  std::vector<Sample> t_gaps, t_double_hits;
  // Pixels of two triangles that share a vertex and overlap only after rounding: it turned one of them over,
  // or moved an outline across the other. Exact methods draw both.
  std::vector<Sample> folds;

  std::uint64_t at_shared_edges() const { return gaps.size() + double_hits.size(); }
  std::uint64_t at_t_junctions() const { return t_gaps.size() + t_double_hits.size(); }
};

// Coverage before and after rounding, both sorted. See Cracks::folds.
std::vector<Sample> folds_of(const Surface& surface, std::span<const Run> before, std::span<const Run> after);

// Rounds half to even. Rounding a float to a coarser grid gives a float.
double rounded_to(double px, int subpixel_bits);
std::vector<FloatTriangle> rounded_to(std::span<const FloatTriangle> triangles, int subpixel_bits);

// Holds a picture's surface, and the exact coverage of its positions rounded to any number of subpixel bits.
// All functions may be called from several threads.
class CrackJudge {
 public:
  // `floats` is the float truth of the triangles; both must outlive this object.
  CrackJudge(std::span<const FloatTriangle> triangles, const CoverageTruth& floats);

  const Surface& surface() const { return surface_; }
  // `snap_bits` as in CoveragePromise.
  Cracks find(const DrawnRuns& drawn, std::optional<int> snap_bits) const;

 private:
  struct Rounded {
    std::once_flag once;
    std::vector<Run> runs;
    std::vector<Sample> folds;
  };
  const Rounded& rounded(int bits) const;

  Surface surface_;
  Window window_;
  std::vector<Run> moved_runs_;  // empty if no copy was moved
  std::span<const Run> runs_;    // the truth before rounding
  mutable std::array<Rounded, kMostSnapBits + 1> rounded_;
};

}  // namespace edgewise::lab
