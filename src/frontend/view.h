// From model space to the screen.
#pragma once

#include <glm/glm.hpp>

#include "edgewise/scene.h"
#include "frontend/clip.h"

namespace edgewise {

// The view volume of a camera. Throws std::invalid_argument if a value of the camera is out of range.
ViewVolume view_volume(const Camera& camera, int width_px, int height_px);

// Rotates world-space vectors into view space.
glm::dmat3 to_camera_frame(const Camera& camera);

// World directions → x and y in pixels times w, and w. A point has the same, relative to the camera.
glm::dmat3 pixels_of(const Camera& camera, int width_px, int height_px);

// Model space → pixels times w, and w, the distance along the view direction (rule 10). The camera is
// subtracted from a vertex before anything else is rounded.
struct ScreenTransform {
  // `pixels` is that of a camera at `eye`, `model` an instance's matrix.
  ScreenTransform(const glm::dmat3& pixels, glm::dvec3 eye, const glm::dmat4& model);
  // Requires a camera that view_volume() accepts.
  ScreenTransform(const Camera& camera, const Instance& instance, int width_px, int height_px);

  // In double, for the vertices of triangles that must be clipped. z is w.
  ClipVertex operator()(glm::vec3 position) const;

  glm::vec3 origin;     // the camera's position in model space, as far as floats represent it
  glm::dmat4x3 exact;   // position - origin → x, y, w
  glm::mat4x3 rounded;  // the same, within the range of float
};

// World space → pixels and depth in [0, 1], all times w. In double, for labels and outlines. Throws
// std::invalid_argument if a value of the camera is out of range.
glm::dmat4 screen_matrix(const Camera& camera, int width_px, int height_px);

}  // namespace edgewise
