#include "lab/view_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <stdexcept>

#include "edgewise/frontend.h"

namespace edgewise::lab {
namespace {

constexpr Size kSize{160, 90};

Scene two_instances() {
  Scene scene;
  scene.meshes.push_back({.positions = {{0, 2, 0}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
                          .triangles = {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}},
                          .colours = {1, 2, 3, 4}});
  const glm::dmat4 sheared(1, 0, .5, 0, .25, 1, 0, 0, 0, 0, -1, 0, .5, .25, -1, 1);
  scene.instances = {{.angle = 0.5f, .translation = {1e5, 0.5, -1e5}}, {.matrix = sheared}};
  (*scene.instances[1].matrix)[3] += glm::dvec4(1e5, 0, -1e5, 0);
  return scene;
}

// Off the centre, with pixels that are not square, and y down.
CameraMatrices computer_vision(double far_z) {
  const glm::dmat3 k(90, 0, 0, 3, 120, 0, 70, 50, 1);
  const glm::dmat4 view(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, -1e5, 1, -1e5 + 6, 1);
  return {view, intrinsics_projection(k, kSize.width, kSize.height, 0.5, 0.3, far_z)};
}

TEST(WithCamera, ShowsWhatTheMatricesShow) {
  for (const double far_z : {20.0, std::numeric_limits<double>::infinity()}) {
    Scene scene = two_instances();
    if (far_z == 20.0) {  // the same, of a mesh far from 0
      const glm::dvec3 origin(4e6, -3e6, 5e6);
      for (Instance& instance : scene.instances)
        instance.matrix = glm::translate(model_matrix({}, instance), -origin);
      scene.meshes[0].origin = origin;
    }
    scene.matrices = computer_vision(far_z);
    const Drawable seen = with_camera(scene, kSize);
    EXPECT_FALSE(std::get<Scene>(seen).matrices);
    const FrontendOptions options{.width = kSize.width, .height = kSize.height, .cull = Cull::none};
    Frontend by_matrices, by_camera;
    const auto a = by_matrices.run(scene, options), b = by_camera.run(seen, options);
    ASSERT_EQ(a.size(), 8u);
    ASSERT_EQ(b.size(), a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(std::abs(a[i].x_q15[k] - b[i].x_q15[k]), 128);
        EXPECT_LE(std::abs(a[i].y_q15[k] - b[i].y_q15[k]), 128);
        EXPECT_LE(std::abs(static_cast<std::int64_t>(a[i].z[k]) - b[i].z[k]), 1 << 9);  // 2^-22
      }
  }
}

TEST(WithCamera, RefusesAParallelProjection) {
  Scene scene = two_instances();
  scene.matrices = {glm::dmat4(1.0), orthographic_projection(-1, 1, -1, 1, 0, 10)};
  EXPECT_THROW(with_camera(scene, kSize), std::invalid_argument);
}

}  // namespace
}  // namespace edgewise::lab
