// Clipping methods: what to do with triangles that leave the view, from behind the camera to beyond the guard
// band.
//
// All methods pass screen triangles to the same exact backend, so that they differ in clipping only. The
// truth needs no clipping: a sample's ray hits a triangle if the three homogeneous edge functions have the
// sign of the triangle's orientation (Olano and Greer, "Triangle scan conversion using 2D homogeneous
// coordinates", 1997). The pixel is covered if the hit lies between the near and the far plane. All signs are
// exact.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/frontend.h"
#include "edgewise/scene.h"
#include "frontend/clip.h"
#include "lab/method.h"

namespace edgewise::lab {

// One mesh, and one instance with the identity transform.
struct ClippingScene {
  Scene scene;
  Size size;
  bool cull_back = false;

  const Mesh& mesh() const { return scene.meshes.front(); }
};

// The draw target of a method; keeps its memory between draws.
struct ClippingFrame {
  explicit ClippingFrame(Size size);

  Framebuffer picture;  // payload: index of the triangle, or kNoTriangle
  std::unique_ptr<Backend> backend;
  Frontend frontend;
  Clipper clipper;
  ViewVolume view{};
  std::vector<ClipVertex> vertices;
  std::vector<ScreenTriangle> triangles;
};

struct ClippingMethod {
  MethodInfo info;
  // The timed part: transform, clip, project, draw.
  void (*draw)(const ClippingScene& scene, ClippingFrame& frame);
  // The promise: the picture is right except for hairline differences and depth ties within tolerance, if no
  // vertex lies on one of these sides (frontend/clip.h, Outside) and no edge that may cross the screen has
  // both ends farther out than reach_px. Sides other than near and far are those of the triangle clipped by
  // these two planes.
  std::uint16_t fails_on;
  double reach_px;
  bool anywhere = true;         // false: the promise holds only for a camera at the origin
  double far_over_near = 1e30;  // the promise holds up to this ratio
};

// Ours first. The table is in methods.cpp.
std::span<const ClippingMethod> clipping_methods();

class ClippingOracle;  // lab/clipping/truth.h
struct ClippingTruth {
  std::vector<std::uint32_t> visible;  // row by row: a triangle's index, or kNoTriangle
  std::shared_ptr<const ClippingOracle> oracle;
};
// The scene must outlive the result.
ClippingTruth clipping_truth(const ClippingScene& scene, int threads = 1);

// A difference is hairline if the truth shows the method's triangle at a point within kHairlinePx of the
// sample: snapping moves edges by up to sqrt(2) / 512 px, and a cut vertex is rounded once more.
inline constexpr double kHairlinePx = 1.0 / 64;
// A wrong triangle is a depth tie within tolerance if its true depth differs from the right one's by at most
// this. A method's depth is a float, with steps of 2^-24 near 1, and is rounded four times by half a step:
// 2^-23 per triangle. Ours is finer.
inline constexpr double kDepthTie01 = 0x1p-22;
// How far out both ends of an edge that crosses the screen may lie, for methods that cut edges in float.
// Floats round the ends by 2^-24 of that distance, and the edge between them moves as much. Hairline is 2^-6
// px, so the bound is 2^18 px if nothing else is rounded.
inline constexpr double kReachPx = 1 << 18;
// The same for ours, which cuts edges in double. The bound is the largest that is tested.
inline constexpr double kDoubleReachPx = double{1ULL << 40};

struct ClippingScore {
  std::uint64_t covered = 0;  // pixels covered in truth
  std::uint64_t hairline = 0;
  // Pixels that differ by more than hairline:
  std::uint64_t missing = 0, extra = 0, wrong_triangle = 0;
  std::uint64_t depth_ties = 0;  // depth ties within tolerance, among wrong_triangle
  std::uint64_t wrong_depth =
      0;  // right triangle, but no depth that it has within kHairlinePx, by more than 2^-20
  std::uint64_t broken = 0;  // wrong pixels, beyond hairline, that the promise rules out

  std::uint64_t wrong() const { return missing + extra + wrong_triangle + wrong_depth; }
};
ClippingScore score(const ClippingMethod& method, const ClippingScene& scene, const ClippingTruth& truth);

// Small scenes on which methods fail.
struct ClippingCase {
  std::string_view name;
  ClippingScene (*make)();
};
std::span<const ClippingCase> clipping_cases();

// A triangle with one vertex outside the view in direction 0 … 25: {left, inside, right} × {above, inside,
// below} × {before the near plane, inside, beyond the far plane} without the one that is inside on all axes.
// Back faces are culled; with `reversed` the triangle is one.
inline constexpr int kOutsideDirections = 26;
ClippingScene outside_direction(int direction, bool reversed);
// A floor that passes under the camera, with the near plane at this distance, and a wall.
ClippingScene floor_through_eye(float near_z);
// A floor of square tiles, and the camera 2 above it, both moved by (away, 0, -away). Floats hold the moved
// tiles exactly for multiples of 16 up to 2^27, and whole numbers up to 2^23.
ClippingScene floor_far_from_origin(double away);

// Thin triangles across the screen. The ends of both long edges lie this far outside, on opposite sides.
ClippingScene far_slivers(double reach_px, int count);

}  // namespace edgewise::lab
