// The state of each face of a scene (active, clipped, culled, …), from the front end's triangle states, as
// letters.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "edgewise/frontend.h"
#include "edgewise/scene.h"

namespace edgewise::viewer {

struct FaceState {
  glm::dvec3 centre;  // in the world
  TriangleState state;
  bool two_sided;
};

// The faces of all instances, in the order of their triangles. A face gets the latest state of its
// triangles. `states` holds one state per triangle of the scene.
std::vector<FaceState> face_states(const Scene& scene, std::span<const TriangleState> states);

char letter_of(const FaceState& face);  // capital for a two-sided face
// The number of faces of each kind, with its letter.
std::string summary_of(std::span<const FaceState> faces);

}  // namespace edgewise::viewer
