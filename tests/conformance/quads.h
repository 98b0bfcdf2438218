// The quads of the conformance suite's fill rules, also drawn by tests/hashes.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "edgewise/scene.h"

namespace edgewise::conformance {

inline TriangleStream stream_of(const std::vector<glm::vec3>& vertices,
                                const std::vector<glm::uvec3>& triangles) {
  TriangleStream stream{64, 64, {}};
  for (const glm::uvec3 t : triangles)
    stream.triangles.push_back({{vertices.at(t.x), vertices.at(t.y), vertices.at(t.z)}, 0});
  return stream;
}

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

}  // namespace edgewise::conformance
