// A scene in the camera's frame: what the laboratory's facing and clipping methods take.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/clipping/clipping.h"
#include "lab/facing/facing.h"

namespace edgewise::lab {

// One mesh seen from the origin along -z. Each triangle has its own three vertices; triangles keep their
// order of submission.
ClippingScene in_view_space(const Scene& scene, Size size);

// Whether each triangle faces the eye, as the method says. `seen` is a scene in view space.
std::vector<std::uint8_t> fronts_of(const FacingMethod& method, const ClippingScene& seen);

glm::vec3 line_of_sight(const Camera& camera);
// Turns vectors of the world into the camera's frame.
glm::dmat3 to_camera_frame(const Camera& camera);

}  // namespace edgewise::lab
