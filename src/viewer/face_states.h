// What became of each face of a scene: told by the front end of its triangles, shown as a letter.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "edgewise/frontend.h"
#include "edgewise/scene.h"

namespace edgewise::viewer {

struct FaceState {
  std::size_t instance;
  glm::vec3 centre;  // in the world
  TriangleState state;
  bool two_sided;
};

// Instance by instance, in the order of their triangles. Of the halves of a face of four vertices the one
// that came further counts. `states` must be those of all triangles of the scene.
std::vector<FaceState> face_states(const Scene& scene, std::span<const TriangleState> states);

char letter_of(const FaceState& face);  // a capital if it is two-sided
// A word for each instance with a letter for each of its faces.
std::string letters_of(std::span<const FaceState> faces);
// How many there are of each kind, with its letter.
std::string summary_of(std::span<const FaceState> faces);

}  // namespace edgewise::viewer
