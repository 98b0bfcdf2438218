#include "viewer/face_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace edgewise::viewer {

namespace {

struct Kind {
  TriangleState state;
  char letter;
  std::string_view name;
};
// The last kind stands for all rare states.
constexpr std::array kKinds{Kind{TriangleState::active, 'a', "active"},
                            Kind{TriangleState::clipped, 'c', "clipped"},
                            Kind{TriangleState::culled, 'b', "culled by facing"},
                            Kind{TriangleState::outside, 'o', "outside"},
                            Kind{TriangleState::outside_with_mesh, '-', "culled with their object or part"},
                            Kind{TriangleState::not_finite, 'x', "not drawable"}};

char letter_of(TriangleState state) {
  const auto kind = std::ranges::find(kKinds, state, &Kind::state);
  return kind == kKinds.end() ? kKinds.back().letter : kind->letter;
}

// The mean of the corners of triangles begin … end - 1.
glm::dvec3 centre_of(const Mesh& mesh, std::size_t begin, std::size_t end) {
  glm::dvec3 sum(0.0);
  for (std::size_t t = begin; t < end; ++t)
    for (int k = 0; k < 3; ++k) sum += glm::dvec3(mesh.positions[mesh.triangles[t][k]]);
  return sum / static_cast<double>(3 * (end - begin));
}

}  // namespace

std::vector<FaceState> face_states(const Scene& scene, std::span<const TriangleState> states) {
  std::vector<FaceState> faces;
  std::size_t id = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const glm::dmat4 model = model_matrix(mesh, instance);
    for (std::size_t begin = 0, end = 0; begin < mesh.triangles.size(); begin = end) {
      TriangleState state = states[id];
      do {
        state = std::max(state, states[id++]);
      } while (++end < mesh.triangles.size() && mesh.has_flag(end, kSameFace));
      const glm::dvec3 centre(model * glm::dvec4(centre_of(mesh, begin, end), 1.0));
      faces.push_back({centre, state, mesh.has_flag(begin, kTwoSided)});
    }
  }
  return faces;
}

char letter_of(const FaceState& face) {
  const char letter = letter_of(face.state);
  return face.two_sided && letter != '-' ? static_cast<char>(letter - 'a' + 'A') : letter;
}

std::string summary_of(std::span<const FaceState> faces) {
  std::string text;
  for (const auto& [state, letter, name] : kKinds) {
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
