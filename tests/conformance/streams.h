// The streams of the conformance suite, also drawn by tests/hashes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "core/random.h"
#include "edgewise/contract.h"
#include "edgewise/scene.h"

namespace edgewise::conformance {

inline TriangleStream stream_of(const std::vector<glm::vec3>& vertices,
                                const std::vector<glm::uvec3>& triangles) {
  TriangleStream stream{64, 64, {}};
  for (const glm::uvec3 t : triangles)
    stream.triangles.push_back({{vertices.at(t.x), vertices.at(t.y), vertices.at(t.z)}, 0});
  return stream;
}

// ---- Fill rules

using Quad = std::vector<glm::vec3>;  // four corners

inline Quad rotated(glm::dvec2 centre, double half, glm::dvec2 along) {
  const glm::dvec2 across(-along.y, along.x);
  const auto corner = [&](double a, double b) {
    const glm::dvec2 p = centre + half * (a * along + b * across);
    return glm::vec3(static_cast<float>(p.x), static_cast<float>(p.y), 0.5f);
  };
  return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

// Directions with whole coordinates, so that corners stay on the lattice and the diagonals pass through
// samples.
inline constexpr std::array<std::pair<int, int>, 9> kDirections{
    {{1, 0}, {1, 1}, {2, 1}, {3, 1}, {3, 2}, {3, 4}, {5, 12}, {7, 1}, {1, 9}}};

// A quad in such a direction, with its centre on a pixel's corner (0) or on a sample (0.5).
inline Quad on_lattice(std::pair<int, int> direction, double corner) {
  const double half = std::floor(28 / (std::abs(direction.first) + std::abs(direction.second)));
  return rotated(glm::dvec2(32 + corner), half, glm::dvec2(direction.first, direction.second));
}

// The ways to split a quad into two triangles.
struct Split {
  const char* name;
  glm::uvec3 a, b;
};
inline constexpr std::array<Split, 6> kSplits{{{"one diagonal", {0, 1, 2}, {0, 2, 3}},
                                               {"the other diagonal", {0, 1, 3}, {1, 2, 3}},
                                               {"started elsewhere", {2, 0, 1}, {3, 0, 2}},
                                               {"last one first", {2, 3, 1}, {3, 0, 1}},
                                               {"first reversed", {0, 2, 1}, {0, 2, 3}},
                                               {"both reversed", {0, 2, 1}, {0, 3, 2}}}};

// ---- Depth

// Fills the image.
inline TriangleStream wall(float z) {
  return stream_of({{-10, -10, z}, {200, -10, z}, {-10, 200, z}}, {{0, 1, 2}});
}
inline const float kBeyondNearAndFar[] = {std::nextafter(0.0f, -1.0f), -1e-30f, -0.25f, -1e5f, -3e38f,
                                          std::nextafter(1.0f, 2.0f),  1.5f,    1e5f,   3e38f};

// From nearer than the near plane to beyond the far plane. Depth is 0 at `start`, 1 at start + 32; the
// corners lie 32 px beyond.
inline constexpr float kSlopeStarts[] = {8.5f, 8.0f, 8.25f};
inline TriangleStream slope(float start, bool falls) {
  const auto at = [&](float x, float y) {
    const float z = (x - start) / 32;
    return glm::vec3(x, y, falls ? 1 - z : z);
  };
  return stream_of({at(start - 32, -16), at(start + 64, -16), at(start - 32, 80), at(start + 64, 80)},
                   {{0, 1, 2}, {1, 3, 2}});
}

// ---- Culling

inline TriangleStream scattered(Random& random) {
  std::vector<glm::vec3> v;
  std::vector<glm::uvec3> triangles;
  for (unsigned i = 0; i < 60; ++i) {
    v.push_back({random.uniform(-9.0f, 73.0f), random.uniform(-9.0f, 73.0f), 0.5f});
    if (i % 3 == 2) triangles.emplace_back(i - 2, i - 1, i);
  }
  return stream_of(v, triangles);
}

inline TriangleStream reversed(TriangleStream stream) {
  for (StreamTriangle& t : stream.triangles) std::swap(t.vertex[1], t.vertex[2]);
  return stream;
}

// Sub-units around a sample, clockwise: from the smallest triangle that can cover it to nearly the size of a
// pixel.
using TinyShape = std::array<glm::ivec2, 3>;
inline constexpr TinyShape kTinyShapes[] = {{{{0, 0}, {1, 0}, {0, 1}}},
                                            {{{-1, -1}, {1, 0}, {0, 1}}},
                                            {{{0, -3}, {2, 2}, {-3, 1}}},
                                            {{{-20, -30}, {41, -7}, {-3, 50}}},
                                            {{{-127, -127}, {127, -127}, {-126, 127}}}};

// One triangle for each pixel, with alternating windings.
inline TriangleStream tiny_triangles(const TinyShape& shape, int subpixel_bits = 8) {
  const auto units = static_cast<float>(1 << subpixel_bits);  // per pixel
  TriangleStream stream{48, 40, {}};
  for (int y = 0; y < stream.height; ++y)
    for (int x = 0; x < stream.width; ++x) {
      StreamTriangle t{};
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::ivec2 p = shape[(x + y) % 2 == 0 ? k : 2 - k];
        t.vertex[k] = {static_cast<float>(x) + 0.5f + static_cast<float>(p.x) / units,
                       static_cast<float>(y) + 0.5f + static_cast<float>(p.y) / units, 0.5f};
      }
      stream.triangles.push_back(t);
    }
  return stream;
}

// ---- Clipping

inline constexpr float kGuard = contract::kMaxImageSide;  // px

struct Plane {
  const char* name;
  int axis;  // of x, y, depth
  float at, inward;
  float distance(glm::vec3 v) const { return (v[axis] - at) * inward; }
};
inline constexpr Plane kPlanes[] = {{"near", 2, 0, 1},       {"far", 2, 1, -1},
                                    {"left", 0, -kGuard, 1}, {"right", 0, kGuard, -1},
                                    {"top", 1, -kGuard, 1},  {"bottom", 1, kGuard, -1}};

using Triangle = std::array<glm::vec3, 3>;

inline TriangleStream stream_of(const Triangle& t) {
  return stream_of(std::vector<glm::vec3>{t.begin(), t.end()}, {{0, 1, 2}});
}

// A triangle with one or two vertices beyond a plane. The plane cuts its edges where floats and the grid are
// exact: at 1/2, 3/4 or 7/8 of the edge. No other plane cuts it.
inline Triangle exactly_cut(const Plane& plane, int outside, Random& random) {
  const auto pick = [&](int low, int high) {
    return static_cast<float>(low +
                              static_cast<int>(random.below(static_cast<std::uint64_t>(high - low + 1))));
  };
  constexpr float kRatios[] = {1, 3, 7};  // distance inside over distance outside
  const auto ratio = [&](std::uint64_t kinds) { return kRatios[random.below(kinds)]; };
  const bool depth = plane.axis == 2;
  // The distance of vertices on the screen from the plane; exactly divisible by all ratios.
  const float inside = depth ? 21.0f / 32 : 21 * (plane.inward > 0 ? 782.0f : 779.0f);
  float distance[3];
  if (outside == 1) {
    const std::uint64_t largest = random.below(3);
    const float beyond = inside / kRatios[largest];
    distance[0] = -beyond, distance[1] = inside, distance[2] = beyond * ratio(largest + 1);
  } else {
    distance[0] = inside, distance[1] = -inside / ratio(3), distance[2] = -inside / ratio(3);
  }
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool near_screen = depth || distance[k] == inside;
    const int reach = near_screen ? 40 : 3000;
    t[k] = {pick(-reach, 64 + reach), pick(-reach, 64 + reach), pick(1, 15) / 16};
    t[k][plane.axis] = plane.at + plane.inward * distance[k];
  }
  return t;
}

// Each coordinate of each vertex is in view, or up to 100,000 px outside on either side. Two triangles in
// three contain a point of the image.
inline Triangle anywhere(Random& random) {
  Triangle t;
  for (glm::vec3& v : t) {
    for (int axis = 0; axis < 2; ++axis) {
      const float u = random.uniform(0.0f, 1.0f);
      // More often near the guard band. No pow: the stored hashes need the same bits everywhere.
      const float beyond = kGuard * (1 + 5.1f * u * u);
      const float coordinate[] = {random.uniform(-30.0f, 94.0f), -beyond, beyond};
      v[axis] = coordinate[random.below(3)];
    }
    const float depth[] = {random.uniform(0.0f, 1.0f), -random.uniform(0.0f, 2.0f),
                           1 + random.uniform(0.0f, 2.0f)};
    v.z = depth[random.below(3)];
  }
  if (random.below(3) == 0) return t;
  const glm::vec3 held{random.uniform(2.0f, 62.0f), random.uniform(2.0f, 62.0f), random.uniform(0.1f, 0.9f)};
  t[2] = 2.0f * held - 0.5f * (t[0] + t[1]);
  return t;
}

}  // namespace edgewise::conformance
