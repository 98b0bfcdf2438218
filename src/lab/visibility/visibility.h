// Who owns a pixel: the painter's orders and the depth buffers, measured against the true view-space planes.
//
// Every method draws the same snapped triangles with the same exact coverage (rules 2 and 4), so that what
// differs is visibility alone. There are two truths, on the snapped positions and on those before snapping.
// Both are rational: 1 / view_z is linear on the screen, the vertices' coordinates and distances are exact,
// and the nearest plane wins; a tie keeps the earlier triangle. Neither rounds a distance as
// exact_visible_triangles() does (lab/truth.h), since how depth is rounded is what the methods differ in.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"
#include "lab/method.h"
#include "lab/truth.h"

namespace edgewise::lab {

struct VisibilityTriangle {
  ScreenTriangle screen;   // z: the depth (rule 6) that the front end makes of view_z, in float
  float x_px[3], y_px[3];  // before snapping
  double view_z[3];        // distance along the view direction, near … far
};

// A polygon, as a fan of triangles that share their first vertex; of the next one on, only the third is new.
struct VisibilityFace {
  std::uint32_t first, count;  // into VisibilityScene::triangles; count >= 1
};

struct VisibilityScene {
  int width, height;  // px
  double near_z, far_z;
  std::vector<VisibilityTriangle> triangles;
  std::vector<VisibilityFace> faces;  // all triangles, in order: painters sort these
};

// What a method draws into; keeps its memory between draws. A method uses the one depth buffer of its format.
struct VisibilityFrame {
  std::vector<std::uint32_t> visible;  // row by row: index of the triangle, or kNoTriangle
  std::vector<std::uint16_t> depth16;
  std::vector<std::uint32_t> depth32;
  std::vector<float> depth_float;
  std::vector<double> key;           // the painter's, a face's
  std::vector<std::uint32_t> order;  // the painter's, of faces
};

// Depths are compared in "depth01": 0 at the near plane, 1 at the far plane, linear on the screen.
struct VisibilityMethod {
  MethodInfo info;
  // The timed part: clear, cover, decide.
  void (*draw)(const VisibilityScene& scene, VisibilityFrame& frame);

  // Only where a depth is kept, else null: the depth01 that the frame holds at a pixel; the format's step
  // there; and the promise: how far a triangle's depth01 may be from the truth.
  long double (*stored01)(const VisibilityFrame& frame, std::size_t pixel);
  long double (*ulp01)(long double depth01);
  double (*bound01)(const VisibilityTriangle& triangle, const VisibilityScene& scene);

  // Only where none is kept: the promise, whether triangle `drawn` may hide `truth`, the nearest.
  bool (*may_occlude)(const VisibilityScene& scene, std::uint32_t drawn, std::uint32_t truth) = nullptr;
};

std::span<const VisibilityMethod> visibility_methods();

// The exact owner of each pixel, row by row, in both truths.
struct TrueVisibleTriangles {
  std::vector<std::uint32_t> snapped, floats;
};
TrueVisibleTriangles true_visible_triangles(const VisibilityScene& scene);

// Against one truth.
struct VisibilityScore {
  std::uint64_t covered = 0;         // pixels that a triangle covers, in truth
  std::uint64_t wrong_triangle = 0;  // pixels with another owner than the true one
  // Of the depths kept, each against the plane of the triangle that the method says it belongs to, where that
  // triangle covers the pixel in truth:
  std::uint64_t out_of_range = 0;  // pixels outside that triangle's own depths by more than 2^-16
  double max_ulp = 0, rms_ulp = 0;
};
struct VisibilityScores {
  VisibilityScore snapped, floats;
  // Methods know the snapped positions only, and so do their promises. Of the wrong owners against that
  // truth, those whose depth lies no farther from the right one's than both triangles' bounds:
  std::uint64_t depth_ties = 0;
  // Promises broken: a pixel owned by a triangle that does not cover it, a depth beyond bound01, or a wrong
  // owner that is no near tie though depths are kept, or one that may not hide the right one.
  std::uint64_t broken = 0;
};
VisibilityScores score(const VisibilityMethod& method, const VisibilityScene& scene,
                       const TrueVisibleTriangles& visible);

// The smallest scenes.
struct VisibilityCase {
  std::string_view name, idea;
  VisibilityScene (*make)();
};
std::span<const VisibilityCase> visibility_cases();

// Sweeps. Two planes `separation` apart, tilted about `distance`: in the upper half of the view the farther
// one is submitted first, in the lower half the nearer one, so that no order of submission is favoured.
VisibilityScene two_planes(double distance, double separation, double near_z, double far_z);
// Thin triangles in many directions, from distance 10 to 50 across their width; aspect is length over
// (horizontal) width, at most 2^17: thinner ones have no area.
VisibilityScene slivers(double aspect);
// What the front end makes of a scene, beside the true distances.
VisibilityScene visibility_scene(const Scene& scene, Size size, Cull cull = Cull::none);
// The same of what was made of it already: payloads are ids, which ascend.
VisibilityScene visibility_scene(std::span<const ScreenTriangle> triangles,
                                 std::span<const UnsnappedTriangle> unsnapped, const Scene& scene, Size size);

}  // namespace edgewise::lab
