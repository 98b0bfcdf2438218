#include "scene/streams.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/float_state.h"
#include "core/numbers.h"
#include "core/random.h"

namespace edgewise {

namespace {

constexpr double kMaxStreamTriangles = 1e8;

std::uint32_t random_colour(Random& random) {
  const auto channel = [&] { return static_cast<std::uint32_t>(64 + random.below(192)); };
  const std::uint32_t r = channel(), g = channel(), b = channel();
  return rgb(r, g, b);
}

void shuffle(std::vector<StreamTriangle>& triangles, Random& random) {
  for (std::size_t i = triangles.size(); i > 1; --i) std::swap(triangles[i - 1], triangles[random.below(i)]);
}

}  // namespace

void check_triangles(double triangles, double scale) {
  if (!(scale > 0.0) || !(triangles <= kMaxStreamTriangles))
    throw std::invalid_argument("scale " + number_text(scale) + " gives no triangle, or more than 10^8");
}

TriangleStream random_stream(const SceneRequest& request, std::size_t count, double area_px, double aspect,
                             std::uint64_t seed) {
  const DefaultFloatState state;
  const double wanted = std::max(1.0, std::round(static_cast<double>(count) * request.scale));
  check_triangles(wanted, request.scale);
  Random random(seed);
  TriangleStream stream{request.width, request.height, {}};
  stream.triangles.resize(static_cast<std::size_t>(wanted));
  for (auto& triangle : stream.triangles) {
    // A base of random length, and the height that gives the area. The apex lies anywhere above the base or a
    // little beside it.
    const float proportion =
        aspect > 0.0 ? static_cast<float>(aspect) * random.uniform(0.7f, 1.4f) : random.uniform(0.6f, 3.0f);
    const float base = static_cast<float>(std::sqrt(2.0 * area_px * proportion));
    const float height = static_cast<float>(2.0 * area_px) / base;
    const float foot = base * random.uniform(-0.25f, 1.25f);
    const glm::vec2 along = random.direction(), across(-along.y, along.x);
    const glm::vec2 apex = foot * along + height * across;
    const glm::vec2 centroid = (base * along + apex) / 3.0f;
    const float centre_y = random.uniform(0.0f, static_cast<float>(request.height));
    const glm::vec2 centre(random.uniform(0.0f, static_cast<float>(request.width)), centre_y);
    const glm::vec2 corners[3] = {centre - centroid, centre - centroid + base * along,
                                  centre - centroid + apex};
    const float z = random.uniform(0.1f, 0.9f);
    for (int i = 0; i < 3; ++i) triangle.vertex[i] = glm::vec3(corners[i], z + random.uniform(-0.1f, 0.1f));
    if (random.below(2) != 0) std::swap(triangle.vertex[1], triangle.vertex[2]);
    triangle.colour = random_colour(random);
  }
  return stream;
}

TriangleStream jittered_grid(const SceneRequest& request, double cell_px, std::uint64_t seed) {
  const DefaultFloatState state;
  // A jitter j below 1/4 of a cell flips no triangle: twice its area is at least (1 - 2j)^2 - (2j)^2 = 1 - 4j
  // cells.
  constexpr float kJitter = 0.2f;
  const double cell = cell_px / std::sqrt(request.scale);
  check_triangles(2.0 * request.width / cell * request.height / cell, request.scale);
  const auto cells = [&](int side) { return std::max(1, static_cast<int>(std::lround(side / cell))); };
  const int columns = cells(request.width), rows = cells(request.height);
  Random random(seed);

  const auto coordinate = [&](int index, int count, int side) {
    if (index == 0 || index == count) return index == 0 ? 0.0f : static_cast<float>(side);
    const float jittered = static_cast<float>(index) + random.uniform(-kJitter, kJitter);
    return jittered * static_cast<float>(side) / static_cast<float>(count);
  };
  std::vector<glm::vec3> vertices;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const float x = coordinate(column, columns, request.width), y = coordinate(row, rows, request.height);
      vertices.emplace_back(x, y, random.uniform(0.1f, 0.9f));
    }

  TriangleStream stream{request.width, request.height, {}};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto vertex = [&](int right, int down) {
        return vertices[static_cast<std::size_t>(row + down) * static_cast<std::size_t>(columns + 1) +
                        static_cast<std::size_t>(column + right)];
      };
      const glm::vec3 quad[4] = {vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1)};
      const std::uint64_t turn = random.below(2);  // which diagonal
      for (const std::uint64_t first : {turn, turn + 2})
        stream.triangles.push_back(
            {{quad[first % 4], quad[(first + 1) % 4], quad[(first + 2) % 4]}, random_colour(random)});
    }
  shuffle(stream.triangles, random);
  return stream;
}

TriangleStream aligned_squares(const SceneRequest& request, std::uint64_t seed) {
  const DefaultFloatState state;
  constexpr int kSides_px[] = {16, 32, 64};
  const auto squares = [&](int length_px, int side_px) { return (length_px + side_px - 1) / side_px; };
  double at_scale_1 = 0.0;
  for (const int side_px : kSides_px)
    at_scale_1 += 2.0 * squares(request.width, side_px) * squares(request.height, side_px);
  const double wanted = std::ceil(at_scale_1 * request.scale);
  check_triangles(wanted, request.scale);

  Random random(seed);
  TriangleStream stream{request.width, request.height, {}};
  while (static_cast<double>(stream.triangles.size()) < wanted)
    for (const int side_px : kSides_px)
      for (int y = 0; y < request.height; y += side_px)
        for (int x = 0; x < request.width; x += side_px) {
          const float z = random.uniform(0.1f, 0.9f);
          const auto corner = [&](int right, int down) {
            return glm::vec3(static_cast<float>(x + right * side_px), static_cast<float>(y + down * side_px),
                             z);
          };
          const glm::vec3 at[4] = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          const std::uint64_t turn = random.below(2);  // which diagonal
          for (const std::uint64_t first : {turn, turn + 2})
            stream.triangles.push_back({{at[first % 4], at[(first + 1) % 4], at[(first + 2) % 4]},
                                        static_cast<std::uint32_t>(random.below(1u << 24)) | 0xFF000000u});
        }
  shuffle(stream.triangles, random);
  stream.triangles.resize(static_cast<std::size_t>(wanted));
  return stream;
}

}  // namespace edgewise
