// Small scenes on which facing methods fail.
#include "lab/facing/facing.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/random.h"
#include "core/trigonometry.h"

namespace edgewise::lab {

namespace {

void add(FacingScene& scene, std::initializer_list<glm::vec3> polygon) {
  for (const glm::vec3 position : polygon) scene.positions.push_back(position);
  scene.add_face(scene.positions.size() - polygon.size());
}

// The camera at the origin looks along +z. Faces are clockwise from outside.
FacingScene box_beside_the_axis() {
  FacingScene scene;
  const auto v = [](int x, int y, int z) {
    return glm::vec3(x != 0 ? 2.5f : 1.5f, y != 0 ? 0.5f : -0.5f, z != 0 ? 4.5f : 3.5f);
  };
  add(scene,
      {v(0, 0, 1), v(0, 0, 0), v(0, 1, 0), v(0, 1, 1)});  // normal (-1, 0, 0): visible although its n.z is 0
  add(scene, {v(1, 0, 0), v(1, 0, 1), v(1, 1, 1), v(1, 1, 0)});
  add(scene, {v(0, 0, 1), v(1, 0, 1), v(1, 0, 0), v(0, 0, 0)});
  add(scene, {v(0, 1, 0), v(1, 1, 0), v(1, 1, 1), v(0, 1, 1)});
  add(scene, {v(0, 0, 0), v(1, 0, 0), v(1, 1, 0), v(0, 1, 0)});
  add(scene, {v(1, 0, 1), v(0, 0, 1), v(0, 1, 1), v(1, 1, 1)});
  return scene;
}

FacingScene box_orthographic() {
  FacingScene scene = box_beside_the_axis();
  scene.view.perspective = false;
  scene.view.focal_px = 32.0f;
  return scene;
}

// An arrowhead whose second vertex is the notch: its first three vertices have the wrong orientation.
FacingScene notch_second() {
  FacingScene scene;
  add(scene, {{-1.0f, 1.0f, 4.0f}, {0.0f, 0.25f, 4.0f}, {1.0f, 1.0f, 4.0f}, {0.0f, -1.0f, 4.0f}});
  return scene;
}

constexpr double kTilt = 0.5235987755982988;  // 30 degrees

constexpr std::array kCases = {
    // A box whose visible side has n.z = 0.
    FacingCase{"box_beside_the_axis", box_beside_the_axis},
    FacingCase{"box_orthographic", box_orthographic},
    FacingCase{"tilted_perspective", [] { return tilted_faces(kTilt, true, 1000, 1); }},
    FacingCase{"tilted_orthographic", [] { return tilted_faces(kTilt, false, 1000, 1); }},
    FacingCase{"edge_on", [] { return edge_on_faces(true, 2000, 2); }},
    FacingCase{"edge_on_orthographic", [] { return edge_on_faces(false, 2000, 2); }},
    FacingCase{"polygons", [] { return polygons(Shape::regular, 500, 5); }},
    FacingCase{"irregular_polygons", [] { return polygons(Shape::irregular, 500, 6); }},
    FacingCase{"bent_polygons", [] { return polygons(Shape::bent, 500, 7); }},
    FacingCase{"notch_second", notch_second},
};

glm::vec3 unit_vector(Random& random) {
  for (;;) {
    const float z = random.uniform(-1, 1), y = random.uniform(-1, 1);
    const glm::vec3 v(random.uniform(-1, 1), y, z);
    const float square = glm::dot(v, v);
    if (square > 0.01f && square <= 1.0f) return v / std::sqrt(square);
  }
}

// Two unit vectors at a right angle.
std::pair<glm::vec3, glm::vec3> random_plane(Random& random) {
  const glm::vec3 normal = unit_vector(random);
  const glm::vec3 u = glm::normalize(glm::cross(normal, unit_vector(random)));
  return {u, glm::cross(normal, u)};
}

}  // namespace

std::span<const FacingCase> facing_cases() {
  return kCases;
}

FacingScene tilted_faces(double tilt, bool perspective, std::size_t count, std::uint64_t seed) {
  FacingScene scene;
  FacingView& view = scene.view;
  view.perspective = perspective;
  const auto across = static_cast<float>(sine(tilt)), along = static_cast<float>(cosine(tilt));
  constexpr float kRadius = 1.0f;
  // Keeps the arc at the same place on the screen for every tilt.
  view.focal_px = perspective ? 128.0f * along : 14.0f;
  const int side = 1 + static_cast<int>(2 * (128 * across + 64));
  view.size = {side, side};
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    // A direction within 90 degrees of (1, 0) in the picture.
    glm::vec2 around = random.direction();
    around.x = std::abs(around.x);
    const glm::vec3 centre = random.uniform(8.0f, 10.0f) * glm::vec3(across * around, along);
    const auto [u, v] = random_plane(random);
    add(scene, {centre + kRadius * u, centre + kRadius * (-0.5f * u + 0.866f * v),
                centre + kRadius * (-0.5f * u - 0.866f * v)});
  }
  return scene;
}

FacingScene polygons(Shape shape, std::size_t count, std::uint64_t seed) {
  constexpr float kDistance = 6.0f, kTurn = 6.2831853f;
  FacingScene scene;
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const auto corners = static_cast<std::uint32_t>(3 + i % 5);
    const float centre_y = random.uniform(-5.0f, 5.0f);
    const glm::vec3 centre(random.uniform(-5.0f, 5.0f), centre_y, kDistance);
    const auto [u, v] = random_plane(random);
    const glm::vec3 normal = glm::cross(u, v);
    for (std::uint32_t k = 0; k < corners; ++k) {
      const float astray = shape == Shape::regular ? 0.0f : random.uniform(-0.4f, 0.4f);
      const float radius = shape == Shape::regular ? 1.0f : random.uniform(0.25f, 1.0f);
      const float lift = shape == Shape::bent ? random.uniform(-0.5f, 0.5f) : 0.0f;
      const float turn = kTurn * (static_cast<float>(k) + astray) / static_cast<float>(corners);
      scene.positions.push_back(centre + radius * (cosine(turn) * u + sine(turn) * v) + lift * normal);
    }
    scene.add_face(scene.positions.size() - corners);
  }
  return scene;
}

FacingScene edge_on_faces(bool perspective, std::size_t count, std::uint64_t seed) {
  FacingScene scene;
  FacingView& view = scene.view;
  view.perspective = perspective;
  view.eye = {0.3f, -0.7f, 0.1f};
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const float sample_y = static_cast<float>(random.below(128)) - 63.5f;
    const glm::vec2 sample(static_cast<float>(random.below(128)) - 63.5f, sample_y);
    const glm::vec2 along = random.direction();
    const auto at = [&](float reach_px) {
      const float w = random.uniform(1.0f, 4.0f);
      const glm::vec2 p = (sample + reach_px * along) / view.focal_px * (perspective ? w : 1.0f);
      return view.eye + glm::vec3(p, w);
    };
    const glm::vec3 a = at(random.uniform(-60, -20)), b = at(random.uniform(20, 60)),
                    c = at(random.uniform(-20, 20));
    add(scene, {a, b, c});
  }
  return scene;
}

}  // namespace edgewise::lab
