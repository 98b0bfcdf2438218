// Visibility methods: painter's orders and depth buffers, scored against the true view-space planes.
//
// Every method draws the same snapped triangles with the same exact coverage (rules 2 and 4), so that they
// differ in visibility only. There are two truths. That of the source is the exact projection of the scene's
// vertices, or the unsnapped positions of a scene that is given on the screen. The other one is on the
// snapped positions. Both use rationals: 1 / view_z is linear on the screen. The nearest plane is visible; at
// a tie the earlier triangle. Unlike exact_visible_triangles() (lab/truth/truth.h) they use unrounded
// distances instead of the front end's depths, since the methods differ in how they round depth.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"
#include "lab/method.h"
#include "lab/projection/truth.h"

namespace edgewise::lab {

struct VisibilityTriangle {
  // Its z is the front end's depth (rule 6), of view_z as a float. Its payload is the id of the triangle in
  // VisibilityScene::truth that it comes from.
  ScreenTriangle screen;
  float x_px[3], y_px[3];  // before snapping
  double view_z[3];        // distance along the view direction, near … far
};

// A polygon, as a fan of triangles around the first vertex. Each triangle after the first adds one vertex,
// its third.
struct VisibilityFace {
  std::uint32_t first, count;  // into VisibilityScene::triangles; count >= 1
};

struct VisibilityScene {
  int width, height;  // px
  double near_z, far_z;
  std::vector<VisibilityTriangle> triangles;
  std::vector<VisibilityFace> faces;                  // cover all triangles, in order; painters sort them
  std::shared_ptr<const SceneTruth> truth = nullptr;  // null: the scene is given on the screen
};

// The draw target of a method; keeps its memory between draws. A method uses the depth buffer of its format
// only.
struct VisibilityFrame {
  std::vector<std::uint32_t> visible;  // row by row: index of the triangle, or kNoTriangle
  std::vector<std::uint16_t> depth16;
  std::vector<std::uint32_t> depth32;
  std::vector<float> depth_float;
  std::vector<double> key;           // painters: a sort key per face
  std::vector<std::uint32_t> order;  // painters: the sorted faces
};

// Depths are compared in "depth01": 0 at the near plane, 1 at the far plane, linear on the screen.
struct VisibilityMethod {
  MethodInfo info;
  // The timed part: clear, cover, decide.
  void (*draw)(const VisibilityScene& scene, VisibilityFrame& frame);

  // For depth buffers, else null: the depth01 that the frame holds at a pixel; and the promise: an upper
  // bound of the error of a triangle's depth01.
  double (*stored01)(const VisibilityFrame& frame, std::size_t pixel);
  double (*bound01)(const VisibilityTriangle& triangle, const VisibilityScene& scene);

  // For methods without a depth buffer, the promise: whether triangle `drawn` may wrongly occlude `truth`,
  // the nearest.
  bool (*may_occlude)(const VisibilityScene& scene, std::uint32_t drawn, std::uint32_t truth) = nullptr;
};

// Ours first. The table is in methods.cpp.
std::span<const VisibilityMethod> visibility_methods();

// The exact visible triangle of each pixel or kNoTriangle, row by row, in both truths. That of the source is
// an id if the scene has a `truth`, otherwise an index.
struct TrueVisibleTriangles {
  std::vector<std::uint32_t> snapped, source;
};
TrueVisibleTriangles true_visible_triangles(const VisibilityScene& scene);
std::vector<std::uint32_t> snapped_visible_triangles(const VisibilityScene& scene);

// The score against one truth.
struct VisibilityScore {
  std::uint64_t covered = 0;         // pixels that a triangle covers in truth
  std::uint64_t wrong_triangle = 0;  // pixels that show another triangle than the true one
  // Stored depths outside the drawn triangle's depth range by more than 2^-16, at pixels that this triangle
  // covers in truth.
  std::uint64_t out_of_range = 0;
};
struct VisibilityScores {
  VisibilityScore snapped, source;
  // Promises concern the snapped positions, the methods' only input. wrong_triangle pixels against that truth
  // that are depth ties within tolerance: the two depths differ by at most the sum of both triangles' bounds.
  std::uint64_t depth_ties = 0;
  // Pixels that break a promise: the drawn triangle does not cover the pixel; its depth errs by more than
  // bound01; or it is the wrong one, and neither a depth tie within tolerance nor, without a depth buffer,
  // allowed by may_occlude.
  std::uint64_t broken = 0;
};
VisibilityScores score(const VisibilityMethod& method, const VisibilityScene& scene,
                       const TrueVisibleTriangles& visible);

// Small scenes on which methods fail.
struct VisibilityCase {
  std::string_view name;
  VisibilityScene (*make)();
};
std::span<const VisibilityCase> visibility_cases();

// For sweeps: two planes `separation` apart, tilted about `distance`. In the upper half of the view the
// farther one is submitted first, in the lower half the nearer one, so that no order of submission is
// favoured. From left to right their distance changes by 2 tilt distance.
VisibilityScene two_planes(double distance, double separation, double near_z, double far_z,
                           double tilt = 0.1);
// For sweeps: thin triangles in many directions, whose distance changes across their width. `aspect` is
// length over horizontal width, at most 2^17: thinner triangles have no area.
VisibilityScene slivers(double aspect, double nearest = 10, double farthest = 50);
// The front end's triangles of a scene, together with the true distances of their vertices.
VisibilityScene visibility_scene(const Scene& scene, Size size, Cull cull = Cull::none);
// The same for triangles that the front end has made already. Payloads must be ids, in ascending order.
VisibilityScene visibility_scene(std::span<const ScreenTriangle> triangles,
                                 std::span<const UnsnappedTriangle> unsnapped, const Scene& scene, Size size);

}  // namespace edgewise::lab
