// From model space to the screen.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "edgewise/scene.h"
#include "frontend/clip.h"
#include "frontend/double_pair.h"

namespace edgewise {

// The view volume of a camera. Throws std::invalid_argument if a value of the camera is out of range.
ViewVolume view_volume(const Camera& camera, int width_px, int height_px);

// The camera of a scene that has no matrices, for code that knows only cameras. Throws std::invalid_argument
// if it has.
const Camera& camera_of(const Scene& scene);

// Rotates world-space vectors into view space.
glm::dmat3 to_camera_frame(const Camera& camera);

// World directions → x and y in pixels times w, and w. A point has the same, relative to the camera.
glm::dmat3 pixels_of(const Camera& camera, int width_px, int height_px);

// Throws std::invalid_argument if an instance's matrix is not finite or not affine.
void check(const Instance& instance);

// The transform and the view volume of a camera, or of matrices, for one image size.
struct View {
  // All throw std::invalid_argument if a value of the camera is out of range, or matrices cannot be used.
  // `fine`: for positions with more than 8 subpixel bits.
  View(const Camera& camera, int width_px, int height_px, bool fine = false);
  View(const CameraMatrices& matrices, int width_px, int height_px, bool fine = false);
  View(const Scene& scene, int width_px, int height_px, bool fine = false);

  ViewVolume volume;
  ViewDepth depth;  // if z is w
  // World space → x and y in pixels times w, and w, is pixels · (position - origin) + at_origin.
  glm::dmat3 pixels;
  glm::dvec3 origin;
  glm::dvec3 at_origin{0.0};
  // If z is not w: its linear part and its value at the origin. Depth is z / w.
  bool has_z = false;
  glm::dvec4 z{0.0};
  // If w is the same everywhere: from the origin, in the middle of the near plane, to the middle of the far
  // plane. Along this axis, only z changes. Otherwise 0.
  glm::dvec3 axis{0.0};
  // If it is fine, all of it: world space → x and y in pixels times w, z, and w.
  std::optional<PairMatrix> to_pixels;
};

// Model space → pixels times w, and w, the distance along the view direction (rule 10). A point in the view,
// which is the camera's position if z is w, is subtracted from a vertex before anything else is rounded.
struct ScreenTransform {
  // `model` is an instance's model_matrix(). If the view is fine, the elements of `exact` and z are those of
  // the product of the camera's and the instance's matrices, rounded once.
  ScreenTransform(const View& view, const glm::dmat4& model);

  // In double: all vertices if the view is fine, otherwise those of triangles that must be clipped.
  ClipVertex operator()(glm::vec3 position) const;

  glm::dvec3 origin;    // near that point in model space; unless the view is fine, floats
  glm::dmat4x3 exact;   // position - origin → x, y, w
  glm::mat4x3 rounded;  // the same, within the range of float
  // As in View; position - origin → z and w, in double.
  bool has_z;
  glm::dvec4 z{0.0}, w{0.0};
};

}  // namespace edgewise
