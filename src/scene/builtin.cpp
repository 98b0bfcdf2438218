// The built-in scenes, and their list at the end. To add a scene, write a function and a line in the list, or
// define scene_NAME in a file of your own and pass the file to CMake in EDGEWISE_SCENES.
#include "edgewise/builtin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/float_state.h"
#include "core/nearest_name.h"
#include "core/random.h"
#include "core/trigonometry.h"
#include "scene/streams.h"

#ifndef EDGEWISE_MORE_SCENES
#define EDGEWISE_MORE_SCENES(X)
#endif

namespace edgewise {

#define EDGEWISE_DECLARE(name) extern const SceneInfo scene_##name;
EDGEWISE_MORE_SCENES(EDGEWISE_DECLARE)

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

constexpr std::array kTwelveColours = {rgb(230, 57, 70),   rgb(244, 132, 95), rgb(255, 200, 87),
                                       rgb(233, 237, 110), rgb(144, 204, 90), rgb(54, 161, 107),
                                       rgb(64, 196, 196),  rgb(78, 150, 230), rgb(76, 92, 214),
                                       rgb(138, 86, 214),  rgb(208, 92, 200), rgb(240, 150, 180)};

std::uint32_t blend(std::uint32_t from, std::uint32_t to, float t) {
  const auto channel = [&](int shift) {
    const auto a = static_cast<float>(from >> shift & 255), b = static_cast<float>(to >> shift & 255);
    return static_cast<std::uint32_t>(a + (b - a) * t + 0.5f);
  };
  return rgb(channel(0), channel(8), channel(16));
}

// The cube of the tutorials: side 2, centred on the origin, eight vertices, twelve triangles of twelve
// colours.
Mesh cube_mesh() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  // Faces clockwise from outside: -z, +z, -x, +x, -y, +y.
  constexpr unsigned kFaces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 2, 6, 4},
                                     {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}};
  for (const auto& f : kFaces) {
    mesh.triangles.emplace_back(f[0], f[1], f[2]);
    mesh.triangles.emplace_back(f[0], f[2], f[3]);
  }
  mesh.colours.assign(kTwelveColours.begin(), kTwelveColours.end());
  return mesh;
}

// A sheet of `columns` x `rows` cells of two triangles. position(u, v) and colour(u, v) get u and v in [0,
// 1]. The front is the side from which u points right and v down.
template <typename Position, typename Colour>
Mesh sheet(unsigned columns, unsigned rows, Position&& position, Colour&& colour) {
  Mesh mesh;
  const auto fraction = [](unsigned i, unsigned n) { return static_cast<float>(i) / static_cast<float>(n); };
  for (unsigned row = 0; row <= rows; ++row)
    for (unsigned column = 0; column <= columns; ++column)
      mesh.positions.push_back(position(fraction(column, columns), fraction(row, rows)));
  for (unsigned row = 0; row < rows; ++row)
    for (unsigned column = 0; column < columns; ++column) {
      const unsigned corner = row * (columns + 1) + column, below = corner + columns + 1;
      mesh.triangles.emplace_back(corner, corner + 1, below);
      mesh.triangles.emplace_back(corner + 1, below + 1, below);
      const std::uint32_t c = colour(fraction(column, columns), fraction(row, rows));
      mesh.colours.insert(mesh.colours.end(), {c, c});
    }
  mesh.clusters = clusters_of(mesh);
  return mesh;
}

Camera camera_at(glm::vec3 position, glm::vec3 target) {
  Camera camera;
  camera.position = position;
  camera.look_at(target);
  return camera;
}

Drawable cube(const SceneRequest& request) {
  const DefaultFloatState state;
  Scene scene;
  scene.meshes.push_back(cube_mesh());
  scene.instances.push_back({.axis = {0.4f, 1.0f, 0.2f}, .angle = 0.6f + 0.8f * request.time});
  scene.camera = camera_at({0.0f, 1.2f, 4.6f}, {0.0f, 0.0f, 0.0f});
  return scene;
}

Drawable cubes(const SceneRequest& request) {
  const DefaultFloatState state;
  Scene scene;
  scene.meshes.push_back(cube_mesh());
  const float turn = 0.5f * request.time;
  for (int i = 0; i < 7; ++i) {
    const auto n = static_cast<float>(i);
    scene.instances.push_back(
        {.scale = glm::vec3(0.55f + 0.12f * static_cast<float>(i % 3)),
         .axis = {0.3f + 0.2f * n, 1.0f, 0.7f - 0.3f * n},
         .angle = 0.9f * n + turn,
         .translation = {-2.7f + 0.9f * n, 0.3f * static_cast<float>(i % 2), -0.35f * n}});
  }
  scene.camera = camera_at({-0.6f, 1.7f, 3.8f}, {-0.35f, 0.1f, -0.9f});
  return scene;
}

// The faces of a cube, subdivided and projected to a sphere: near-uniform triangles and no poles. The number
// of cells is a power of two, so the angles are symmetric, and neighbouring faces get the same bits along
// their common edge.
Drawable sphere(const SceneRequest& request) {
  const DefaultFloatState state;
  constexpr unsigned kSide = 64;  // cells: 6 * 64^2 * 2 = 49,152 triangles
  // Equal angles, not equal lengths, keep the cells similar. The ends are exactly -1 and 1.
  const auto bend = [](float t) {
    const float d = 2.0f * t - 1.0f;
    return std::abs(d) == 1.0f ? d : tangent(d * kPi / 4.0f);
  };
  Scene scene;
  const Mesh cube = cube_mesh();
  for (unsigned face = 0; face < 6; ++face) {
    const glm::uvec3 first = cube.triangles[2 * face], second = cube.triangles[2 * face + 1];
    const glm::vec3 corner = cube.positions[first[0]], right = (cube.positions[first[1]] - corner) / 2.0f,
                    down = (cube.positions[second[2]] - corner) / 2.0f, centre = corner + right + down;
    scene.meshes.push_back(sheet(
        kSide, kSide,
        [&](float u, float v) { return glm::normalize(centre + bend(u) * right + bend(v) * down); },
        [&](float u, float v) {
          const bool odd = (static_cast<int>(u * 8.0f) + static_cast<int>(v * 8.0f)) % 2 != 0;
          return odd ? kTwelveColours[2 * face] : blend(kTwelveColours[2 * face], rgb(255, 255, 255), 0.75f);
        }));
    scene.instances.push_back({.mesh = face, .axis = {0.2f, 1.0f, 0.0f}, .angle = 0.4f * request.time});
  }
  scene.camera = camera_at({0.0f, 0.7f, 2.7f}, {0.0f, 0.0f, 0.0f});
  return scene;
}

Drawable torus_knot(const SceneRequest& request) {
  const DefaultFloatState state;
  constexpr unsigned kAlong = 1024, kAround = 24;  // cells: 49,152 triangles
  constexpr float kTube = 0.32f;                   // radius
  // The (2, 3) knot on a torus of radii 1.2 and 0.5.
  const auto curve = [](float t) {
    const float radius = 1.2f + 0.5f * cosine(3.0f * t);
    return glm::vec3(radius * cosine(2.0f * t), radius * sine(2.0f * t), 0.5f * sine(3.0f * t));
  };
  Scene scene;
  scene.meshes.push_back(sheet(
      kAlong, kAround,
      [&](float u, float v) {
        // The tube's cross-section is oriented by the torus's normal, which is always perpendicular to the
        // curve.
        constexpr float kStep = 1e-2f;
        // Vertices on the seam must have the same bits on both sides.
        const float t = u == 1.0f ? 0.0f : u * 2.0f * kPi, angle = v == 1.0f ? 0.0f : v * 2.0f * kPi;
        const glm::vec3 centre = curve(t), tangent = glm::normalize(curve(t + kStep) - curve(t - kStep));
        const float outward = cosine(3.0f * t);
        const glm::vec3 normal(outward * cosine(2.0f * t), outward * sine(2.0f * t), sine(3.0f * t));
        const glm::vec3 side = glm::normalize(glm::cross(tangent, normal)), up = glm::cross(side, tangent);
        return centre + kTube * (cosine(angle) * side - sine(angle) * up);
      },
      [&](float u, float) {
        const float hue = u * 12.0f;
        const auto first = static_cast<std::size_t>(hue);
        return blend(kTwelveColours[first % 12], kTwelveColours[(first + 1) % 12],
                     hue - static_cast<float>(first));
      }));
  scene.instances.push_back({.axis = {0.3f, 1.0f, 0.0f}, .angle = 0.3f + 0.5f * request.time});
  scene.camera = camera_at({0.0f, 0.4f, 4.6f}, {0.0f, 0.0f, 0.0f});
  return scene;
}

// Instanced knots: many instances that occlude each other, with more than a million triangles.
Drawable knots(const SceneRequest& request) {
  const DefaultFloatState state;
  constexpr int kSide = 6;          // knots per row and column at scale 1
  constexpr float kSpacing = 2.6f;  // less than the width of a knot
  constexpr double kTrianglesOfKnot = 49'152;
  check_triangles(kSide * kSide * kTrianglesOfKnot * request.scale, request.scale);
  const int side = std::max(1, static_cast<int>(std::lround(kSide * std::sqrt(request.scale))));
  Scene scene = std::get<Scene>(torus_knot(request));
  const Instance knot = scene.instances.front();
  scene.instances.clear();
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const auto at = [&](int i) {
        return kSpacing * (static_cast<float>(i) - 0.5f * static_cast<float>(side - 1));
      };
      Instance instance = knot;
      instance.angle += 0.7f * static_cast<float>(row * side + column);
      instance.translation = {at(column), 0.0f, at(row)};
      scene.instances.push_back(instance);
    }
  const float extent = kSpacing * static_cast<float>(side);
  scene.camera.position = {0.2f * extent, 0.4f * extent, 0.8f * extent};
  scene.camera.look_at({0.0f, -0.5f, 0.0f});
  scene.camera.far_z = std::max(scene.camera.far_z, 3.0f * extent);
  return scene;
}

// Smooth value noise on an integer lattice, in [0, 1].
float value_noise(float x, float y) {
  const auto lattice = [](int i, int j) {
    Random random(static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32 |
                  static_cast<std::uint32_t>(j));
    return random.uniform(0.0f, 1.0f);
  };
  const auto smooth = [](float t) { return t * t * (3.0f - 2.0f * t); };
  const float fx = std::floor(x), fy = std::floor(y);
  const int i = static_cast<int>(fx), j = static_cast<int>(fy);
  const float u = smooth(x - fx), v = smooth(y - fy);
  const float upper = lattice(i, j) + (lattice(i + 1, j) - lattice(i, j)) * u;
  const float lower = lattice(i, j + 1) + (lattice(i + 1, j + 1) - lattice(i, j + 1)) * u;
  return upper + (lower - upper) * v;
}

// The camera is in the middle, so triangles cross the near plane and every side of the view.
Drawable terrain(const SceneRequest& request) {
  const DefaultFloatState state;
  constexpr unsigned kSide = 512;  // cells: 524,288 triangles
  constexpr float kExtent = 40.0f, kHeight = 4.0f;
  const auto height = [](float x, float z) {
    float sum = 0.0f, amplitude = 0.5f, frequency = 0.15f;
    for (int octave = 0; octave < 5; ++octave, amplitude *= 0.5f, frequency *= 2.1f)
      sum += amplitude * value_noise(x * frequency + 100.0f, z * frequency + 100.0f);
    return kHeight * sum;
  };
  const auto coordinate = [](float t) { return (t - 0.5f) * kExtent; };
  Scene scene;
  scene.meshes.push_back(sheet(
      kSide, kSide,
      [&](float u, float v) {
        return glm::vec3(coordinate(u), height(coordinate(u), coordinate(v)), coordinate(v));
      },
      [&](float u, float v) {
        const float level = height(coordinate(u), coordinate(v)) / kHeight;
        const float grain = 0.15f * value_noise(u * 300.0f, v * 300.0f);
        const std::uint32_t low =
            blend(rgb(64, 128, 72), rgb(150, 142, 100), std::clamp(level * 3.0f - 1.0f, 0.0f, 1.0f));
        return blend(blend(low, rgb(240, 240, 245), std::clamp(level * 4.0f - 2.2f, 0.0f, 1.0f)),
                     rgb(30, 40, 30), grain);
      }));
  scene.instances.push_back({});
  scene.camera.position = {0.0f, height(0.0f, 0.0f) + 0.06f, 0.0f};
  scene.camera.yaw = 0.7f + 0.2f * request.time;
  scene.camera.pitch = -0.12f;
  return scene;
}

// Counts, areas and shapes are those of the comparison with peers, at 1920 x 1080.
Drawable large(const SceneRequest& r) {
  return random_stream(r, 1'000, 45'000.0, 0.0, 1);
}
Drawable medium(const SceneRequest& r) {
  return random_stream(r, 50'000, 400.0, 0.0, 2);
}
Drawable small(const SceneRequest& r) {
  return random_stream(r, 1'000'000, 10.0, 0.0, 3);
}
Drawable micro(const SceneRequest& r) {
  return random_stream(r, 2'000'000, 1.0, 0.0, 4);
}
Drawable sliver(const SceneRequest& r) {
  return random_stream(r, 100'000, 125.0, 1000.0, 5);
}
Drawable grid4(const SceneRequest& r) {
  return jittered_grid(r, 4.0, 6);
}
Drawable grid64(const SceneRequest& r) {
  return jittered_grid(r, 64.0, 7);
}
Drawable quads(const SceneRequest& r) {
  return aligned_squares(r, 1);
}

}  // namespace

std::span<const SceneInfo> builtin_scenes() {
#define EDGEWISE_ENTRY(name) scene_##name,
  static const std::array kScenes = {
      SceneInfo{"cube", "the tutorials' cube, rotating: twelve triangles of twelve colours", false, cube},
      SceneInfo{"cubes", "seven cubes that occlude and intersect each other", false, cubes},
      SceneInfo{"sphere", "a sphere of 49,152 triangles of nearly equal size", false, sphere},
      SceneInfo{"torus-knot", "a torus knot of 49,152 triangles that occlude each other", false, torus_knot},
      SceneInfo{"terrain",
                "524,288 triangles around the camera; some cross the near plane and the view's sides", false,
                terrain},
      SceneInfo{"large", "1,000 random triangles of 45,000 px", true, large},
      SceneInfo{"medium", "50,000 random triangles of 400 px", true, medium},
      SceneInfo{"small", "1,000,000 random triangles of 10 px", true, small},
      SceneInfo{"micro", "2,000,000 random triangles of 1 px", true, micro},
      SceneInfo{"sliver", "100,000 random triangles of about 500 x 0.5 px, in all directions", true, sliver},
      SceneInfo{"grid4", "a watertight jittered grid with cells of 4 px", true, grid4},
      SceneInfo{"grid64", "a watertight jittered grid with cells of 64 px", true, grid64},
      SceneInfo{"quads", "squares of 16, 32 and 64 px on the pixel grid; each size covers every pixel once",
                true, quads},
      SceneInfo{"knots", "36 torus knots that occlude each other: 1,769,472 triangles", false, knots, true},
      EDGEWISE_MORE_SCENES(EDGEWISE_ENTRY)};
  return kScenes;
}

const SceneInfo& find_scene(std::string_view name) {
  return find_named("scene", name, builtin_scenes(), &SceneInfo::name);
}

}  // namespace edgewise
