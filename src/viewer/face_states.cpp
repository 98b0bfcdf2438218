#include "viewer/face_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace edgewise::viewer {

namespace {

struct Kind {
  char letter;
  std::string_view name;
};
// All rare states share the kind "not drawable".
constexpr std::array kKinds{Kind{'a', "active"},
                            Kind{'c', "clipped"},
                            Kind{'b', "culled by facing"},
                            Kind{'o', "outside"},
                            Kind{'-', "culled with their object or part"},
                            Kind{'x', "not drawable"}};

char letter_of(TriangleState state) {
  switch (state) {
    case TriangleState::active:
      return 'a';
    case TriangleState::clipped:
      return 'c';
    case TriangleState::culled:
      return 'b';
    case TriangleState::outside:
      return 'o';
    case TriangleState::outside_with_mesh:
      return '-';
    default:
      return 'x';
  }
}

glm::dvec3 centre_of(const Mesh& mesh, std::size_t triangle, bool quad) {
  const auto corner = [&](std::size_t t, int k) { return glm::dvec3(mesh.positions[mesh.triangles[t][k]]); };
  const glm::dvec3 three = corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2);
  return quad ? (three + corner(triangle + 1, 2)) / 4.0 : three / 3.0;
}

}  // namespace

std::vector<FaceState> face_states(const Scene& scene, std::span<const TriangleState> states) {
  std::vector<FaceState> faces;
  std::size_t id = 0;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes.at(scene.instances[i].mesh);
    const glm::dmat4 model = model_matrix(scene.instances[i]);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t, ++id) {
      if (mesh.has_flag(t, kSecondHalf)) {
        faces.back().state = std::max(faces.back().state, states[id]);
        continue;
      }
      const bool quad = t + 1 < mesh.triangles.size() && mesh.has_flag(t + 1, kSecondHalf);
      const glm::dvec3 centre(model * glm::dvec4(centre_of(mesh, t, quad), 1.0));
      faces.push_back({i, centre, states[id], mesh.has_flag(t, kTwoSided)});
    }
  }
  return faces;
}

char letter_of(const FaceState& face) {
  const char letter = letter_of(face.state);
  return face.two_sided && letter != '-' ? static_cast<char>(letter - 'a' + 'A') : letter;
}

std::string letters_of(std::span<const FaceState> faces) {
  std::string words;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i > 0 && faces[i].instance != faces[i - 1].instance) words += ' ';
    words += letter_of(faces[i]);
  }
  return words;
}

std::string summary_of(std::span<const FaceState> faces) {
  std::string text;
  for (const auto& [letter, name] : kKinds) {
    const auto count = std::count_if(faces.begin(), faces.end(), [letter = letter](const FaceState& face) {
      return letter_of(face.state) == letter;
    });
    if (count > 0) text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", letter, count, name);
  }
  if (std::any_of(faces.begin(), faces.end(), [](const FaceState& face) { return face.two_sided; }))
    text += "; capitals: two-sided";
  return text;
}

}  // namespace edgewise::viewer
