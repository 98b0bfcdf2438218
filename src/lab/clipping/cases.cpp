// Small scenes on which clipping methods fail.
#include <algorithm>
#include <array>
#include <initializer_list>

#include "core/random.h"
#include "lab/clipping/clipping.h"

namespace edgewise::lab {

namespace {

// The camera looks along -z; the image's height is 1 at distance 1.
ClippingScene view(float near_z) {
  ClippingScene s{{}, {64, 48}};
  s.scene.meshes.resize(1);
  s.scene.instances.resize(1);
  s.scene.camera.fov_y = 0.9272952f;  // 2 atan(1 / 2)
  s.scene.camera.near_z = near_z;
  s.scene.camera.far_z = 50.0f;
  return s;
}

void add(ClippingScene& s, std::initializer_list<glm::vec3> polygon) {
  Mesh& mesh = s.scene.meshes.front();
  const auto first = static_cast<unsigned>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), polygon);
  for (unsigned i = 2; i < polygon.size(); ++i) {
    mesh.triangles.emplace_back(first, first + i - 1, first + i);
    mesh.colours.push_back(rgb(200, 200, 200));
  }
}

void add_wall(ClippingScene& s, float z, float half) {
  add(s, {{-half, half, -z}, {half, half, -z}, {half, -half, -z}, {-half, -half, -z}});
}

ClippingScene in_view() {
  ClippingScene s = view(0.1f);
  add(s, {{-0.4f, 0.3f, -1.0f}, {2.0f, 0.1f, -6.0f}, {-0.7f, -1.2f, -3.0f}});
  add(s, {{-2.1f, 1.3f, -7.0f}, {0.6f, 0.4f, -1.5f}, {0.1f, -0.9f, -2.0f}});
  return s;
}

ClippingScene vertex_at_eye_plane() {
  ClippingScene s = view(0.1f);
  add(s, {{-1.0f, -0.5f, -3.0f}, {1.0f, -0.5f, -3.0f}, {0.25f, -0.5f, 0.0f}});
  add(s, {{-1.0f, 1.0f, -3.0f}, {1.0f, 1.0f, -3.0f}, {0.0f, 0.0f, 0.0f}});
  return s;
}

ClippingScene quads_before_near() {
  ClippingScene s = view(0.1f);
  add_wall(s, 2.0f, 0.9f);
  add_wall(s, 0.03f, 0.005f);
  add_wall(s, 0.06f, 0.02f);
  return s;
}

ClippingScene over_the_screens_edges() {
  ClippingScene s = view(0.1f);
  s.size = {128, 96};
  Random random(5);
  for (int i = 0; i < 150; ++i) {
    const auto corner = [&] {
      const float distance = random.uniform(2.0f, 20.0f);
      const float y = random.uniform(-0.9f, 0.9f);
      return distance * glm::vec3(random.uniform(-1.2f, 1.2f), y, -1.0f);
    };
    add(s, {corner(), corner(), corner()});
  }
  return s;
}

// A point given by its screen position and its w.
struct ScreenPoint {
  double x_px, y_px, w;
};

glm::vec3 unproject(const ClippingScene& s, ScreenPoint p) {
  const double scale = p.w / s.size.height;  // of view(): height 1 at distance 1
  return glm::vec3(
      glm::dvec3((p.x_px - s.size.width / 2.0) * scale, (s.size.height / 2.0 - p.y_px) * scale, -p.w));
}

// Thin triangles on the grid of 1/256 px that leave the screen far on both sides and cross a row of samples
// on it. If they are cut at the screen's edges and snapped again, they cross the row elsewhere or never.
ClippingScene along_the_rows() {
  ClippingScene s = view(0.1f);
  s.size = {128, 128};  // so that floats represent the positions exactly
  for (int i = 0; i < 15; ++i) {
    const double row = 8.5 + 8 * i, reach = 8192, rise = (i + 2) / 256.0, crossing = 64;
    add(s, {unproject(s, {crossing - reach, row - rise, 2}), unproject(s, {crossing + reach, row + rise, 2}),
            unproject(s, {crossing + reach, row + rise + 6, 2})});
  }
  return s;
}

// w runs from 1 to 10; half of the road's projection lies outside the screen.
ClippingScene road_from_the_side() {
  ClippingScene s = view(0.1f);
  s.size = {128, 96};
  add(s, {unproject(s, {-100, 10, 1}), unproject(s, {100, 40, 10}), unproject(s, {100, 56, 10}),
          unproject(s, {-100, 86, 1})});
  return s;
}

ClippingScene beyond_the_guard_band() {
  ClippingScene s = view(0.1f);
  add(s, {{-300.0f, -90.0f, -0.3f}, {0.5f, 1.0f, -4.0f}, {400.0f, 10.0f, -0.4f}});
  add(s, {{0.1f, -500.0f, -0.2f}, {0.2f, 700.0f, -0.5f}, {3.0f, 0.2f, -9.0f}});
  return s;
}

// w - z is at most near (far - w) / far, less than what floats of w distinguish.
ClippingScene wall_at_900() {
  ClippingScene s = view(2e-4f);
  s.scene.camera.far_z = 1000.0f;
  s.scene.camera.yaw = 0.3f;
  for (int row = -8; row < 8; ++row)
    for (int column = -8; column < 8; ++column) {
      const float x = 50.0f * static_cast<float>(column), y = 50.0f * static_cast<float>(row);
      add(s, {{x, y + 50, -900}, {x + 50, y + 50, -900}, {x + 50, y, -900}, {x, y, -900}});
    }
  return s;
}

ClippingScene beyond_far() {
  ClippingScene s = view(0.1f);
  add(s, {{-2.0f, -2.0f, -5.0f}, {2.0f, -2.0f, -5.0f}, {3.0f, 40.0f, -120.0f}});
  return s;
}

constexpr std::array kCases = {
    // Nothing to clip except at the screen's edges: all methods are right.
    ClippingCase{"in_view", in_view},
    ClippingCase{"floor_behind_eye", [] { return floor_through_eye(0.1f); }},
    // Vertices with w = 0.
    ClippingCase{"vertex_at_eye_plane", vertex_at_eye_plane},
    ClippingCase{"quads_before_near", quads_before_near},
    ClippingCase{"over_the_screens_edges", over_the_screens_edges},
    ClippingCase{"along_the_rows", along_the_rows},
    ClippingCase{"road_from_the_side", road_from_the_side},
    ClippingCase{"far_slivers", [] { return far_slivers(240'000, 100); }},
    ClippingCase{"beyond_the_guard_band", beyond_the_guard_band},
    ClippingCase{"beyond_far", beyond_far},
    ClippingCase{"far_from_origin", [] { return floor_far_from_origin(131'072); }},
    ClippingCase{"far_over_near", wall_at_900},
};

}  // namespace

std::span<const ClippingCase> clipping_cases() {
  return kCases;
}

ClippingScene outside_direction(int direction, bool reversed) {
  const int index = direction < 13 ? direction : direction + 1;  // 13 is inside on all axes
  const int right = index % 3 - 1, up = index / 3 % 3 - 1, away = index / 9 - 1;
  ClippingScene s = view(0.5f);
  s.cull_back = true;
  const float distance = away < 0 ? -1.5f : away > 0 ? 80.0f : 3.0f;
  const float reach = std::max(distance, 3.0f);
  const glm::vec3 out(static_cast<float>(right) * 2.0f * reach + 0.2f,
                      static_cast<float>(up) * 1.7f * reach + 0.1f, -distance);
  // The other two vertices, chosen so that the triangle is never edge-on.
  const float low = up == 0 ? -0.8f : 0.0f;
  const glm::vec3 a = right != 0 ? glm::vec3(0.1f, 0.9f, -4.0f) : glm::vec3(-1.1f, low - 0.3f, -4.0f);
  const glm::vec3 b = right != 0 ? glm::vec3(-0.2f, -1.0f, -3.5f) : glm::vec3(1.2f, low + 0.2f, -3.5f);
  // The sign of the homogeneous determinant is the winding, also for vertices behind the camera; down is -y.
  const bool front = glm::dot(glm::dvec3(a), glm::cross(glm::dvec3(b), glm::dvec3(out))) > 0;
  if (front != reversed)
    add(s, {a, b, out});
  else
    add(s, {b, a, out});
  return s;
}

ClippingScene floor_far_from_origin(double away) {
  ClippingScene s = view(1.0f / 1024);
  s.size = {128, 96};
  Camera& camera = s.scene.camera;
  camera.position = {away, 2.0, -away};
  camera.yaw = 0.54f, camera.pitch = -0.26f, camera.far_z = 1000.0f;
  constexpr int kTiles = 12;
  for (int row = -kTiles; row < kTiles; ++row)
    for (int column = -kTiles; column < kTiles; ++column) {
      const auto corner = [&](int x, int z) {
        return glm::vec3(glm::dvec3(away + 16.0 * x, 0.0, 16.0 * z - away));
      };
      add(s, {corner(column, row), corner(column, row + 1), corner(column + 1, row + 1),
              corner(column + 1, row)});
    }
  return s;
}

ClippingScene far_slivers(double reach_px, int count) {
  ClippingScene s = view(0.1f);
  s.size = {128, 96};
  Random random(8);
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 along(random.direction()), across(-along.y, along.x);
    const double middle_y = random.uniform(0, 96);
    const glm::dvec2 middle(random.uniform(0, 128), middle_y);
    const double width_px = random.uniform(4, 12);
    const auto at = [&](double along_px, double across_px) {
      const glm::dvec2 p = middle + along_px * along + across_px * across;
      return unproject(s, {p.x, p.y, random.uniform(0.5f, 2.0f)});
    };
    const glm::vec3 a = at(-reach_px, 0), b = at(reach_px, 0), c = at(reach_px, width_px);
    add(s, {a, b, c});
  }
  return s;
}

ClippingScene floor_through_eye(float near_z) {
  ClippingScene s = view(near_z);
  add(s, {{-4.0f, -1.0f, -20.0f}, {4.0f, -1.0f, -20.0f}, {3.0f, -1.0f, 5.0f}, {-3.0f, -1.0f, 6.0f}});
  add_wall(s, 10.0f, 1.5f);
  return s;
}

}  // namespace edgewise::lab
