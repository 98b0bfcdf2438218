// Projections of every convention show a marker where it is known to lie.
#include "edgewise/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "message_of.h"
#include "support.h"

namespace edgewise {
namespace {

constexpr int kWidth = 200, kHeight = 100;
constexpr double kAspect = 2, kFov = std::numbers::pi / 2, kNear = 1, kFar = 9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const glm::dvec3 kEye(1, 2, 3);

// Views from kEye along the world's -z. x points right, and
const glm::dmat4 kZBack = glm::translate(glm::dmat4(1.0), -kEye),            // y up, z backwards
    kZForward = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 1, -1)) * kZBack,  // y up, z forward
    kYDown = glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, -1)) * kZBack;    // y down, z forward

// Where the marker's vertices lie: px and depth in [0, 1].
struct Seen {
  double x_px, y_px, depth;
};

// A triangle whose vertices lie to the right of, above and before the camera by (1, 1/2, 4), (2, 1/2, 4) and
// (1, -1, 2).
void expect_marker(const CameraMatrices& matrices, const Seen (&seen)[3], const std::string& what,
                   double tolerated_units = 2) {
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  for (const glm::dvec3 v : {glm::dvec3(1, 0.5, -4), {2, 0.5, -4}, {1, -1, -2}})
    mesh.positions.emplace_back(kEye + v);
  mesh.triangles = {{0, 1, 2}};
  mesh.colours = {0};
  scene.instances.emplace_back();
  scene.matrices = matrices;
  const auto shown = testing::run(scene, {.width = kWidth, .height = kHeight, .cull = Cull::back});
  ASSERT_EQ(shown.triangles.size(), 1u) << what;
  const ScreenTriangle& t = shown.triangles[0];
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(t.x_q15[k], contract::kPixel_q15 * seen[k].x_px) << what << ", vertex " << k;
    EXPECT_EQ(t.y_q15[k], contract::kPixel_q15 * seen[k].y_px) << what << ", vertex " << k;
    EXPECT_NEAR(t.z[k], contract::kDepthHead + contract::kDepthRange * seen[k].depth, tolerated_units)
        << what << ", vertex " << k;
  }
}

// 90 degrees, so a slope of 1 is 50 px.
constexpr Seen kPerspective[] = {{112.5, 43.75, 27.0 / 32}, {125, 43.75, 27.0 / 32}, {125, 75, 9.0 / 16}};
constexpr Seen kInfinitelyFar[] = {{112.5, 43.75, 0.75}, {125, 43.75, 0.75}, {125, 75, 0.5}};
// 2 units right, 1 unit up.
constexpr Seen kParallel[] = {{150, 25, 3.0 / 8}, {200, 25, 3.0 / 8}, {150, 100, 1.0 / 8}};

TEST(CameraMatrices, ShowAMarkerAlikeInEveryPerspectiveConvention) {
  const glm::dmat4 p = glm::perspectiveRH_ZO(kFov, kAspect, kNear, kFar);
  expect_marker({kZBack, p}, kPerspective, "right-handed Direct3D");
  expect_marker({kZBack, projection_from(kDirect3d, p)}, kPerspective, "kDirect3d");
  expect_marker({kZForward, glm::perspectiveLH_ZO(kFov, kAspect, kNear, kFar)}, kPerspective, "Direct3D");
  expect_marker({kZBack, glm::frustumRH_ZO(-2.0, 2.0, -1.0, 1.0, kNear, kFar)}, kPerspective, "frustum");
  expect_marker({kZBack, projection_from(kOpenGl, glm::perspectiveRH_NO(kFov, kAspect, kNear, kFar))},
                kPerspective, "OpenGL");
  expect_marker({kZForward, projection_from(kOpenGl, glm::perspectiveLH_NO(kFov, kAspect, kNear, kFar))},
                kPerspective, "left-handed OpenGL");
  const glm::dmat4 y_down = glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, 1));
  expect_marker({kZBack, projection_from(kVulkan, y_down * p)}, kPerspective, "Vulkan");
  expect_marker(
      {kZBack, projection_from({.reversed = true}, glm::perspectiveRH_ZO(kFov, kAspect, kFar, kNear))},
      kPerspective, "reversed");
  expect_marker({kZBack, projection_from({.z_from_minus_w = true, .y_down = true, .reversed = true},
                                         y_down * glm::perspectiveRH_NO(kFov, kAspect, kFar, kNear))},
                kPerspective, "reversed, -w to w, y down");
  expect_marker({kZBack, perspective_projection(kFov, kAspect, kNear, kFar)}, kPerspective, "ours");
  expect_marker({kZBack, 3.0 * p}, kPerspective, "w is thrice the distance");
  expect_marker({glm::scale(glm::dmat4(1.0), glm::dvec3(2)) * kZBack,
                 perspective_projection(kFov, kAspect, 2 * kNear, 2 * kFar)},
                kPerspective, "a view in half units");
  expect_marker({glm::dmat4(1.0), p * kZBack}, kPerspective, "one product", 600);
}

TEST(CameraMatrices, MayHaveNoFarPlane) {
  expect_marker({kZBack, projection_from(kOpenGl, glm::infinitePerspectiveRH(kFov, kAspect, kNear))},
                kInfinitelyFar, "OpenGL");
  expect_marker({kZBack, perspective_projection(kFov, kAspect, kNear, kInfinity)}, kInfinitelyFar, "ours");
  glm::dmat4 reversed = glm::infinitePerspectiveRH(kFov, kAspect, kNear);
  reversed[2].z = 0.0, reversed[3].z = kNear;
  expect_marker({kZBack, projection_from({.reversed = true}, reversed)}, kInfinitelyFar, "reversed");
  expect_marker({kYDown, intrinsics_projection({50, 0, 0, 0, 50, 0, 100, 50, 1}, kWidth, kHeight, 0.5, kNear,
                                               kInfinity)},
                kInfinitelyFar, "intrinsics");
}

TEST(CameraMatrices, OfComputerVisionSayWhereThePixelsCentresLie) {
  const auto of = [](double cx, double cy, double first_centre, double skew = 0) {
    const glm::dmat3 k(50, 0, 0, skew, 50, 0, cx, cy, 1);
    return CameraMatrices{kYDown, intrinsics_projection(k, kWidth, kHeight, first_centre, kNear, kFar)};
  };
  expect_marker(of(100, 50, 0.5), kPerspective, "COLMAP");
  expect_marker(of(99.5, 49.5, 0), kPerspective, "OpenCV");
  expect_marker(of(110, 45, 0.5), {{122.5, 38.75, 27.0 / 32}, {135, 38.75, 27.0 / 32}, {135, 70, 9.0 / 16}},
                "off centre");
  // A point 1 / 8 above the axis moves left by an eighth of the skew.
  expect_marker(of(100, 50, 0.5, 16),
                {{110.5, 43.75, 27.0 / 32}, {123, 43.75, 27.0 / 32}, {133, 75, 9.0 / 16}}, "skew");
}

TEST(CameraMatrices, ShowAMarkerAlikeInEveryParallelConvention) {
  const glm::dmat4 ours = orthographic_projection(-2, 2, -1, 1, kNear, kFar);
  EXPECT_EQ(ours, glm::orthoRH_ZO(-2.0, 2.0, -1.0, 1.0, kNear, kFar));
  EXPECT_EQ(orthographic_projection(-3, 5, 7, 9, -2, 6), glm::orthoRH_ZO(-3.0, 5.0, 7.0, 9.0, -2.0, 6.0));
  expect_marker({kZBack, ours}, kParallel, "ours");
  expect_marker({kZForward, glm::orthoLH_ZO(-2.0, 2.0, -1.0, 1.0, kNear, kFar)}, kParallel, "Direct3D");
  expect_marker({kZBack, projection_from(kOpenGl, glm::orthoRH_NO(-2.0, 2.0, -1.0, 1.0, kNear, kFar))},
                kParallel, "OpenGL");
  expect_marker(
      {kZBack, projection_from({.reversed = true}, glm::orthoRH_ZO(-2.0, 2.0, -1.0, 1.0, kFar, kNear))},
      kParallel, "reversed");
  expect_marker({glm::dmat4(1.0), ours * kZBack}, kParallel, "one product");
}

TEST(CameraMatrices, HelpersRefuseInvalidValues) {
  const double nan = std::nan("");
  const glm::dmat3 k(1);
  Camera tilted;
  tilted.yaw = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message_of([] { perspective_projection(1, 1, 1, 2); }), "");
  EXPECT_EQ(message_of([] { orthographic_projection(1, -1, 1, -1, -0.5, 10); }), "") << "mirrors";
  EXPECT_EQ(message_of([&] { intrinsics_projection(k, 10, 10, 0, 1, 2); }), "");
  using Call = std::function<void()>;
  for (const auto& [call, said] : std::vector<std::pair<Call, std::string>>{
           {[] { perspective_projection(0, 1, 1, 2); }, "field of view"},
           {[] { perspective_projection(3.2, 1, 1, 2); }, "field of view"},
           {[&] { perspective_projection(nan, 1, 1, 2); }, "field of view"},
           {[] { perspective_projection(1, -1, 1, 2); }, "aspect"},
           {[] { perspective_projection(1, kInfinity, 1, 2); }, "aspect"},
           {[&] { perspective_projection(1, nan, 1, 2); }, "aspect"},
           {[] { perspective_projection(1, 1, 0, 2); }, "0 < near < far, not 0 and 2"},
           {[] { perspective_projection(1, 1, 2, 2); }, "0 < near < far"},
           {[] { perspective_projection(1, 1, kInfinity, kInfinity); }, "0 < near < far"},
           {[&] { perspective_projection(1, 1, nan, 2); }, "0 < near < far"},
           {[&] { perspective_projection(1, 1, 1, nan); }, "0 < near < far"},
           {[] { orthographic_projection(1, 1, 0, 1, 0, 1); }, "three finite ranges"},
           {[] { orthographic_projection(0, 1, 0, 1, 0, kInfinity); }, "three finite ranges"},
           {[] { orthographic_projection(-1, 1, -1, 1, 10, 0.5); }, "near < far, not 10 and 0.5"},
           {[&] { orthographic_projection(-1, 1, -1, 1, nan, 0.5); }, "near < far"},
           {[&] { intrinsics_projection(k, 0, 10, 0, 1, 2); }, "at least one pixel"},
           {[&] { intrinsics_projection(k, 10, 10, nan, 1, 2); }, "must be finite"},
           {[] { intrinsics_projection(glm::dmat3(kInfinity), 10, 10, 0, 1, 2); }, "must be finite"},
           {[] { intrinsics_projection(glm::dmat3(2), 10, 10, 0, 1, 2); }, "last row"},
           {[&] { matrices_of(tilted, 1); }, "must be finite"}})
    EXPECT_NE(message_of(call).find(said), std::string::npos) << message_of(call) << ", not " << said;
}

}  // namespace
}  // namespace edgewise
