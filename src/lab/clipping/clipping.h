// What becomes of triangles that reach out of the view: from behind the eye to beyond the guard band.
//
// Every method hands screen triangles to the same exact backend, so that what differs is clipping alone. The
// truth needs no clipping: a sample's ray hits a triangle where its three homogeneous edge functions agree
// with the triangle's orientation (Olano and Greer, "Triangle scan conversion using 2D homogeneous
// coordinates", 1997), and the pixel is covered if that happens between the near and the far plane. All signs
// are exact.
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

// One mesh, one instance that does not move it, and the camera at the origin with yaw and pitch 0.
struct ClippingScene {
  Scene scene;
  Size size;
  bool cull_back = false;

  const Mesh& mesh() const { return scene.meshes.front(); }
};

// What a method draws into; keeps its memory between draws.
struct ClippingFrame {
  explicit ClippingFrame(Size size);

  Framebuffer picture;  // payload: index of the triangle, or kNoTriangle
  std::unique_ptr<Backend> backend;
  Frontend frontend;
  Clipper clipper;
  std::vector<ClipVertex> vertices;
  std::vector<ScreenTriangle> triangles;
  // Of one draw. What a C program would have written anywhere, or shown as noise, is caught and counted.
  std::uint64_t not_a_number = 0;  // triangles dropped because a division gave NaN or infinity
  std::uint64_t out_of_range = 0;  // vertices clamped to the guard band or to the depth range
};

struct ClippingMethod {
  MethodInfo info;
  // The timed part: transform, clip, project, draw.
  void (*draw)(const ClippingScene& scene, ClippingFrame& frame);
  // The promise: if no vertex of a scene lies on one of these sides (frontend/clip.h, Outside; but for near
  // and far, of what those two planes leave of a triangle), and no edge across the screen has both its ends
  // farther out than reach_px, the picture is right but for hairline differences and near ties.
  std::uint16_t fails_on;
  double reach_px;
};

// Ours first.
std::span<const ClippingMethod> clipping_methods();

class ClippingOracle;  // lab/clipping/truth.h
struct ClippingTruth {
  std::vector<std::uint32_t> visible;  // row by row
  std::shared_ptr<const ClippingOracle> oracle;
};
// The scene must outlive it.
ClippingTruth clipping_truth(const ClippingScene& scene, int threads = 1);

// A difference is hairline if the truth is what the method shows at a place within kHairlinePx of the sample:
// snapping moves edges by up to sqrt(2) / 512 px, and a cut vertex is rounded once more.
inline constexpr double kHairlinePx = 1.0 / 64;
// A near tie is a wrong owner whose true depth is no farther from the right one's: the front end's depth is a
// float, which near 1 has steps of 2^-24, and is rounded four times on its way, to half a step each: 2^-23 a
// triangle.
inline constexpr double kDepthTie01 = 0x1p-22;
// How far out both ends of an edge across the screen may lie. Floats place them to 2^-24 of that distance,
// and what lies between moves as much; hairline is 2^-6 px. So 2^18, if nothing else is rounded.
inline constexpr double kReachPx = 1 << 18;
// A camera rounds a vertex before anything is cut: matrix, products, sums, and the scaling to pixels. Eight
// last places are allowed for it.
inline constexpr double kCameraReachPx = kReachPx / 8;

struct ClippingScore {
  std::uint64_t covered = 0;  // pixels, in truth
  std::uint64_t hairline = 0;
  // Pixels whose difference is more than hairline:
  std::uint64_t missing = 0, extra = 0, wrong_triangle = 0;
  std::uint64_t depth_ties = 0;  // of the wrong owners
  std::uint64_t wrong_depth =
      0;  // the owner is right; its depth is none that it has within kHairlinePx, by 2^-20
  // Where the owner is right: the largest error of the distance that the depth stands for, as a fraction of
  // the distances from the triangle's nearest vertex to its farthest.
  double worst_distance = 0;
  std::uint64_t differs_from_ours = 0;               // pixels with another owner than the first method has
  std::uint64_t not_a_number = 0, out_of_range = 0;  // as in ClippingFrame
  std::uint64_t broken = 0;  // wrong pixels, beyond hairline, that the promise rules out

  std::uint64_t wrong() const { return missing + extra + wrong_triangle + wrong_depth; }
};
ClippingScore score(const ClippingMethod& method, const ClippingScene& scene, const ClippingTruth& truth);

// The smallest scenes.
struct ClippingCase {
  std::string_view name, idea;
  ClippingScene (*make)();
};
std::span<const ClippingCase> clipping_cases();

// A triangle with one vertex outside in direction 0 … 25: left, in or right, times above, in or below, times
// behind the near plane, in or beyond the far plane, without the one that is in. Back faces are culled;
// `reversed` turns the triangle into one.
inline constexpr int kOutsideDirections = 26;
ClippingScene outside_direction(int direction, bool reversed);
// A floor that passes under the eye, seen with a near plane at this distance.
ClippingScene floor_through_eye(float near_z);

// Thin triangles across the screen, both long edges of which have their ends this far out on either side.
ClippingScene far_slivers(double reach_px, int count);

}  // namespace edgewise::lab
