#include "lab/cases/random_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "edgewise/contract.h"
#include "lab/cases/hard_triangles.h"

namespace edgewise::randomized {

// Scenes are identical on every machine, as in lab/cases/hard_triangles.cpp: powers of two instead of pow,
// and one random number per statement.
namespace {

// A number from 2^low to 2^high, uniform in its exponent.
float magnitude(Random& random, int low, int high) {
  const int exponent = low + static_cast<int>(random.below(static_cast<std::uint64_t>(high - low)));
  return std::ldexp(random.uniform(1.0f, 2.0f), exponent);
}

bool one_in(Random& random, std::uint64_t n) {
  return random.below(n) == 0;
}

glm::vec3 in_cube(Random& random, float reach) {
  const float x = random.uniform(-reach, reach), y = random.uniform(-reach, reach);
  return {x, y, random.uniform(-reach, reach)};
}

std::uint32_t colour(Random& random) {
  return static_cast<std::uint32_t>(random.next() >> 32);
}

// Sets a coordinate to NaN or infinity, or scales v to near the float maximum, with 1 % probability each.
glm::vec3 spoiled(Random& random, glm::vec3 v) {
  const auto dice = random.below(100);
  const int axis = static_cast<int>(random.below(3));
  if (dice == 0) v[axis] = std::numeric_limits<float>::quiet_NaN();
  if (dice == 1) v[axis] = std::numeric_limits<float>::infinity();
  if (dice == 2) v *= 1e35f;
  return v;
}

// A triangle count. One in sixteen is large enough for several threads and chunks.
std::size_t random_count(Random& random, std::size_t most) {
  return one_in(random, 16) ? 9000 + random.below(6000) : 1 + random.below(most);
}

Camera random_camera(Random& random, glm::vec3 position) {
  Camera camera;
  camera.position = position;
  camera.yaw = random.uniform(-3.2f, 3.2f);
  camera.pitch = random.uniform(-1.6f, 1.6f);
  camera.fov_y = one_in(random, 8) ? random.uniform(0.01f, 3.1f) : random.uniform(0.4f, 1.6f);
  camera.near_z = magnitude(random, -10, 1);
  camera.far_z = camera.near_z * magnitude(random, 1, 20);
  return camera;
}

Drawable stream(Random& random, int width, int height) {
  TriangleStream result{width, height, {}};
  const bool wild = one_in(random, 2);
  for (std::size_t i = random_count(random, 300); i > 0; --i) {
    StreamTriangle& t = result.triangles.emplace_back();
    const float x = random.uniform(-20.0f, static_cast<float>(width) + 20.0f);
    const float y = random.uniform(-20.0f, static_cast<float>(height) + 20.0f);
    const bool may_be_cut = wild && one_in(random, 4);  // by the guard band or the near or far plane
    const float reach = magnitude(random, -7, may_be_cut ? 20 : 7);
    for (glm::vec3& v : t.vertex) {
      const glm::vec3 offset = in_cube(random, reach);
      const float z = may_be_cut ? random.uniform(-0.5f, 1.5f) : random.uniform(0.0f, 1.0f);
      v = {x + offset.x, y + offset.y, z};
      if (may_be_cut) v = spoiled(random, v);
    }
    if (one_in(random, 16)) t.vertex[2] = t.vertex[0];
    t.colour = colour(random);
  }
  return result;
}

// Triangles between vertices at all distances, so that every frustum plane clips some.
Mesh soup_mesh(Random& random, bool spoil) {
  Mesh mesh;
  const int low = -10 + static_cast<int>(random.below(10)),
            high = low + 1 + static_cast<int>(random.below(20));
  for (std::size_t i = 3 + random.below(200); i > 0; --i) {
    const glm::vec3 position = in_cube(random, magnitude(random, low, high));
    mesh.positions.push_back(spoil ? spoiled(random, position) : position);
  }
  for (std::size_t i = random_count(random, 120); i > 0; --i) {
    const auto vertex = [&] { return static_cast<unsigned>(random.below(mesh.positions.size())); };
    const unsigned a = vertex(), b = vertex(), c = vertex();
    mesh.triangles.emplace_back(a, b, c);
    mesh.colours.push_back(colour(random));
  }
  return mesh;
}

// Moves camera and instances away from the origin, sometimes.
void move_away(Random& random, Scene& scene) {
  if (!one_in(random, 4)) return;
  const glm::dvec3 by(in_cube(random, magnitude(random, 0, 8)));
  scene.camera.position += by;
  for (Instance& instance : scene.instances) instance.translation += by;
}

Drawable soup(Random& random, int, int) {
  Scene scene;
  scene.meshes.push_back(soup_mesh(random, one_in(random, 4)));
  for (std::size_t i = 1 + random.below(3); i > 0; --i) {
    Instance& instance = scene.instances.emplace_back();
    if (one_in(random, 2)) continue;  // identity transform
    instance.scale = in_cube(random, 2.0f);
    instance.axis = in_cube(random, 1.0f);
    instance.angle = random.uniform(-4.0f, 4.0f);
    instance.translation = in_cube(random, magnitude(random, -3, 6));
  }
  const float reach = one_in(random, 2) ? 0.0f : magnitude(random, -3, 4);
  scene.camera = random_camera(random, in_cube(random, reach));
  move_away(random, scene);
  return scene;
}

// A bumpy sheet around the camera, which is a little above it, below it, or at one of its vertices.
Drawable inside(Random& random, int, int) {
  const unsigned side = 1 + static_cast<unsigned>(random.below(one_in(random, 16) ? 80 : 14));
  const float extent = magnitude(random, 0, 8), height = extent * random.uniform(0.0f, 0.5f);
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  for (unsigned row = 0; row <= side; ++row)
    for (unsigned column = 0; column <= side; ++column) {
      const auto coordinate = [&](unsigned i) {
        return extent * (static_cast<float>(i) / static_cast<float>(side) - 0.5f);
      };
      mesh.positions.emplace_back(coordinate(column), random.uniform(-height, height), coordinate(row));
    }
  for (unsigned row = 0; row < side; ++row)
    for (unsigned column = 0; column < side; ++column) {
      const unsigned corner = row * (side + 1) + column, below = corner + side + 1;
      mesh.triangles.emplace_back(corner, corner + 1, below);
      mesh.triangles.emplace_back(corner + 1, below + 1, below);
      for (int i = 0; i < 2; ++i) mesh.colours.push_back(colour(random));
    }
  scene.instances.push_back({});
  glm::vec3 camera = in_cube(random, 0.4f * extent);
  camera.y = random.uniform(-1.5f, 1.5f) * height;
  if (one_in(random, 8)) camera = mesh.positions[random.below(mesh.positions.size())];
  scene.camera = random_camera(random, camera);
  scene.camera.pitch *= 0.3f;
  return scene;
}

// Boxes of all sizes, some around the camera, some flattened or mirrored by their scale.
Drawable boxes(Random& random, int, int) {
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  constexpr std::array<std::array<unsigned, 4>, 6> kFaces{
      {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}}};
  for (const auto& face : kFaces) {
    mesh.triangles.emplace_back(face[0], face[1], face[2]);
    mesh.triangles.emplace_back(face[0], face[2], face[3]);
    for (int i = 0; i < 2; ++i) mesh.colours.push_back(colour(random));
  }
  scene.camera = random_camera(random, in_cube(random, 1.0f));
  for (std::size_t i = 1 + random.below(20); i > 0; --i) {
    Instance& instance = scene.instances.emplace_back();
    instance.scale = in_cube(random, magnitude(random, -6, 6));
    if (one_in(random, 8)) instance.scale[static_cast<int>(random.below(3))] = 0.0f;
    instance.axis = in_cube(random, 1.0f);
    instance.angle = one_in(random, 3) ? 0.0f : random.uniform(-4.0f, 4.0f);
    instance.translation = in_cube(random, magnitude(random, -2, 5));
  }
  move_away(random, scene);
  return scene;
}

}  // namespace

std::span<const SceneFamily> scene_families() {
  static constexpr std::array kFamilies = {
      SceneFamily{"stream", stream},  // cut by the guard band, near and far plane, with NaN
      SceneFamily{"soup", soup},      // triangles between vertices at all distances, with NaN
      SceneFamily{"inside", inside},  // a bumpy sheet around the camera
      SceneFamily{"boxes", boxes},    // boxes of all sizes, some around the camera
  };
  return kFamilies;
}

namespace {

// Hashes seed and number, so that cases are independent. Generator states one step apart would give shifted
// copies of one sequence.
Random random_of(std::uint64_t seed, std::uint64_t number) {
  return Random(Random(Random(seed).next() ^ number).next());
}

// Mostly small images, because many errors occur at image edges; some as large as the contract allows.
std::pair<int, int> random_size(Random& random) {
  const auto up_to = [&](int most) {
    return 1 + static_cast<int>(random.below(static_cast<unsigned>(most)));
  };
  if (random.below(100) == 0) {
    const int width = up_to(1000);
    return {width, up_to(1000)};
  }
  constexpr std::array kLargestSides{4, 20, 80, 80, 150, 150, 300};
  const auto kind = random.below(kLargestSides.size() + 1);
  if (kind < kLargestSides.size()) {
    const int width = up_to(kLargestSides[kind]);
    return {width, up_to(kLargestSides[kind])};
  }
  const int along = up_to(random.below(8) == 0 ? contract::kMaxImageSide : 2048), across = up_to(8);
  return random.below(2) == 0 ? std::pair{along, across} : std::pair{across, along};
}

// Drops triangles once the pixels of all bounding boxes exceed a case's time budget.
void cut_to_budget(std::vector<ScreenTriangle>& triangles, int width, int height) {
  constexpr std::int64_t kBudget = 1'000'000;  // px
  std::int64_t cost = 0;
  const auto beyond = [&](const ScreenTriangle& t) {
    const contract::PixelBox box = contract::pixel_box(t, width, height);
    if (!box.empty()) cost += std::int64_t{box.x1 - box.x0} * (box.y1 - box.y0);
    return cost > kBudget;
  };
  triangles.erase(std::find_if(triangles.begin() + 1, triangles.end(), beyond), triangles.end());
}

}  // namespace

Case make_case(std::uint64_t seed, std::uint64_t number, int subpixel_bits) {
  Random random = random_of(seed, number);
  Case c;
  c.number = number;
  std::tie(c.width, c.height) = random_size(random);
  c.background = static_cast<std::uint32_t>(random.next() >> 32);
  constexpr std::array kThreads{2, 2, 2, 3, 4, 5, 8, 16};
  c.threads = kThreads[random.below(kThreads.size())];
  c.large_oracle_budget = random.below(16) == 0;
  c.draws_seed = random.next();
  c.frontend.subpixel_bits = subpixel_bits;

  const auto lists = lab::triangle_families();
  const auto scenes = scene_families();
  const auto kind = random.below(lists.size() + scenes.size());
  if (kind < lists.size()) {
    c.family = lists[kind];
    // Several chunks, sometimes.
    const auto count = random.below(100) == 0 ? 8000 + random.below(12'000) : 1 + random.below(300);
    c.triangles =
        lab::adversarial(c.family, static_cast<int>(count), c.width, c.height, random.next(), subpixel_bits);
    cut_to_budget(c.triangles, c.width, c.height);
    return c;
  }
  const SceneFamily& scene = scenes[kind - lists.size()];
  c.family = scene.name;
  constexpr std::array kCulls{Cull::none, Cull::none,  Cull::none,  Cull::back,
                              Cull::back, Cull::front, Cull::front, Cull::both};
  c.frontend.width = c.width;
  c.frontend.height = c.height;
  c.frontend.cull = kCulls[random.below(kCulls.size())];
  c.frontend.shade = random.below(2) == 0;
  c.frontend.payload = random.below(2) == 0 ? Payload::colour : Payload::id;
  c.drawable = scene.make(random, c.width, c.height);
  return c;
}

int random_subpixel_bits(std::uint64_t seed, std::uint64_t number) {
  Random random = random_of(~seed, number);
  constexpr auto kChoices = static_cast<std::uint64_t>(kMaxSubpixelBits - kMinSubpixelBits + 1);
  return one_in(random, 2) ? 8 : kMinSubpixelBits + static_cast<int>(random.below(kChoices));
}

namespace {

// Of a kind that a helper of camera.h makes, or of a general one.
CameraMatrices matrices_like(Random& random, const Camera& camera, int width, int height) {
  const double aspect = double(width) / height, near_z{camera.near_z}, far_z{camera.far_z};
  CameraMatrices m = matrices_of(camera, aspect);
  glm::dmat4& p = m.projection;
  const auto slope = [&] { return double{random.uniform(-0.25f, 0.25f)}; };
  switch (random.below(6)) {
    case 0:  // OpenGL
      for (int i = 0; i < 4; ++i) p[i].z = 2.0 * p[i].z - p[i].w;
      p = projection_from(kOpenGl, p);
      break;
    case 1:  // reversed depth, without a far plane
      p = perspective_projection(double{camera.fov_y}, aspect, near_z,
                                 std::numeric_limits<double>::infinity());
      for (int i = 0; i < 4; ++i) p[i].z = p[i].w - p[i].z;
      p = projection_from({.reversed = true}, p);
      break;
    case 2: {
      const double side{magnitude(random, -3, 7)};
      const double begin = one_in(random, 2) ? near_z : -far_z;
      p = orthographic_projection(-side * aspect, side * aspect, -side, side, begin, far_z);
      break;
    }
    case 3: {  // computer vision, with skew
      const double focal = p[1].y * height / 2.0, skew = focal * slope();
      const double x = width * (0.5 + slope()), y = height * (0.5 + slope());
      for (int i = 0; i < 4; ++i) m.view[i].y = -m.view[i].y, m.view[i].z = -m.view[i].z;
      const glm::dmat3 k(focal, 0, 0, skew, focal, 0, x, y, 1);
      p = intrinsics_projection(k, width, height, 0.0, near_z, far_z);
      break;
    }
    case 4:  // a tilted near plane
      p[0].z = slope() * p[0].x;
      p[1].z = slope() * p[1].y;
      break;
    default:  // sheared, in one matrix
      glm::dmat4 shear(1.0);
      for (int i = 0; i < 9; ++i) shear[i / 3][i % 3] += slope();
      m = {glm::dmat4(1.0), p * shear * m.view};
  }
  return m;
}

}  // namespace

std::optional<CameraMatrices> random_matrices(Random& random, const Camera& camera, int width,
                                              int height) try {
  Scene scene;
  scene.matrices = matrices_like(random, camera, width, height);
  Frontend().run(scene, {.width = width, .height = height});
  return scene.matrices;
} catch (const std::invalid_argument&) {
  return {};
}

std::optional<Case> with_matrices(const Case& c) {
  Random random(~c.draws_seed);
  if (!c.drawable || !std::holds_alternative<Scene>(*c.drawable) || one_in(random, 2)) return {};
  const auto m = random_matrices(random, std::get<Scene>(*c.drawable).camera, c.width, c.height);
  if (!m) return {};
  Case other = c;
  other.family += " with matrices";
  std::get<Scene>(*other.drawable).matrices = m;
  return other;
}

}  // namespace edgewise::randomized
