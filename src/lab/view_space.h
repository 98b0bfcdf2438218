// Converts a scene to one mesh, the input of the laboratory's facing and clipping methods.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/clipping/clipping.h"
#include "lab/facing/facing.h"

namespace edgewise::lab {

// All instances as one mesh. Each triangle has its own three vertices, rounded to float, and its face's
// normal; triangles keep their order of submission and their flags. In view space, the camera is at the
// origin and looks along -z. Both throw std::out_of_range for an instance whose mesh the scene lacks.
ClippingScene in_world_space(const Scene& scene, Size size);
ClippingScene in_view_space(const Scene& scene, Size size);

// The method's result per triangle: 1 if it faces the camera, else 0. Methods by normals test each face once,
// the others each triangle. `seen` comes from in_view_space().
std::vector<std::uint8_t> fronts_of(const FacingMethod& method, const ClippingScene& seen);

// A drawable that shows the same without a scene's matrices, for code that knows only cameras: the camera is
// at the origin, and the instances' matrices map to its space. Near and far are rounded to float. Throws
// std::invalid_argument for matrices that are not of a usual perspective (camera.h).
Drawable with_camera(const Drawable& drawable, Size size);

glm::vec3 line_of_sight(const Camera& camera);
// The direction in the space of an instance's mesh: its product with a normal there has the sign that the
// world-space ones have, also if the instance scales or mirrors. `model`, of its matrix, has an inverse.
glm::vec3 in_mesh_space(const glm::dmat3& model, glm::dvec3 direction);

}  // namespace edgewise::lab
