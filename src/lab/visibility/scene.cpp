// Adds the true distances to the front end's triangles of a scene. The front end transforms positions to
// distances in float; the true distances are transformed in double.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "frontend/transform.h"
#include "frontend/view.h"
#include "lab/source_triangles.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

namespace {

class SourceTriangle {
 public:
  SourceTriangle(const ScreenTransform& to_screen, const Mesh& mesh, std::size_t triangle) {
    for (int i = 0; i < 3; ++i) {
      const glm::vec3 p = mesh.positions[mesh.triangles[triangle][i]];
      const glm::vec3 v = transform(to_screen, p);
      const float inverse_w = 1.0f / v.z;
      seen_[i] = {v.x * inverse_w, v.y * inverse_w};
      const ClipVertex exact = to_screen(p);
      corner_[i] = {exact.x, exact.y, exact.w};
    }
  }
  double distance(glm::vec2 seen) const {
    for (int i = 0; i < 3; ++i)
      if (seen == seen_[i]) return corner_[i].z;
    return on_plane(seen.x, seen.y);
  }

 private:
  // A vertex that clipping made lies on the plane of the corners. For weights with sum(weight corner) = (x,
  // y, 1), the sum of the weights is 1 / distance.
  double on_plane(double x_px, double y_px) const {
    const glm::dvec3 weights = glm::inverse(corner_) * glm::dvec3(x_px, y_px, 1.0);
    const double distance = 1.0 / (weights.x + weights.y + weights.z);
    const auto [nearest, farthest] = std::minmax({corner_[0].z, corner_[1].z, corner_[2].z});
    // An exactly edge-on triangle has no such weights, and covers nothing.
    return std::isfinite(distance) ? std::clamp(distance, nearest, farthest) : farthest;
  }

  glm::vec2 seen_[3];  // the front end's corners, px
  glm::dmat3 corner_;  // x w, y w, w
};

}  // namespace

VisibilityScene visibility_scene(std::span<const ScreenTriangle> triangles,
                                 std::span<const UnsnappedTriangle> unsnapped, const Scene& scene,
                                 Size size) {
  const double near_z = camera_of(scene).near_z, far_z = scene.camera.far_z;
  VisibilityScene result{size.width, size.height, near_z, far_z, {}, {}};
  result.triangles.reserve(triangles.size());
  SourceTriangles sources(scene);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const UnsnappedTriangle& at = unsnapped[i];
    VisibilityTriangle t{triangles[i], {}, {}, {}};
    const auto [instance, mesh, index] = sources.at(triangles[i].payload);
    const ScreenTransform to_screen({scene.camera, size.width, size.height}, model_matrix(mesh, instance));
    const SourceTriangle source(to_screen, mesh, index);
    for (int k = 0; k < 3; ++k) {
      t.x_px[k] = at.x_px[k];
      t.y_px[k] = at.y_px[k];
      t.view_z[k] = std::clamp(source.distance({at.x_px[k], at.y_px[k]}), near_z, far_z);
    }
    result.faces.push_back({static_cast<std::uint32_t>(i), 1});
    result.triangles.push_back(t);
  }
  return result;
}

VisibilityScene visibility_scene(const Scene& scene, Size size, Cull cull) {
  Frontend frontend;
  const auto triangles = frontend.run(scene, {.width = size.width,
                                              .height = size.height,
                                              .cull = cull,
                                              .shade = false,
                                              .payload = Payload::id,
                                              .keep_unsnapped = true});
  VisibilityScene result = visibility_scene(triangles, frontend.unsnapped(), scene, size);
  result.truth = std::make_shared<SceneTruth>(scene, size, cull);
  return result;
}

}  // namespace edgewise::lab
