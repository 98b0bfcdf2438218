// Ear clipping (Meisters, "Polygons have ears", 1975; as in Eberly, "Triangulation by ear clipping"). A
// corner is cut off if its triangle contains no concave corner of the remaining polygon. A cut changes only
// the two neighbouring corners. So a corner that cannot be cut is tested again only after a neighbour is
// removed. The concave corners are searched in a list sorted along the longer axis: large round polygons take
// about n log n time.
#include "scene/polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace edgewise {

namespace {

// Corners visited before triangulate() gives up; about two seconds.
constexpr std::uint64_t kMaxWork = 1'000'000'000;

// Projects the polygon along the axis closest to its normal, and makes it counter-clockwise.
std::vector<glm::dvec2> flatten(std::span<const glm::vec3> positions,
                                std::span<const std::uint32_t> polygon) {
  std::vector<glm::vec3> vertices;
  for (const std::uint32_t i : polygon) vertices.push_back(positions[i]);
  // Newell's method needs no convex corner to start from.
  const glm::vec3 normal = -face_normal(vertices), size = glm::abs(normal);
  const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double turn = normal[axis] < 0.0f ? -1.0 : 1.0;
  std::vector<glm::dvec2> points;
  points.reserve(polygon.size());
  for (const std::uint32_t i : polygon) points.emplace_back(positions[i][u], turn * positions[i][v]);
  return points;
}

// Positive for a left turn at b, negative for a right turn.
double turn_at(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

class EarClipper {
 public:
  explicit EarClipper(std::vector<glm::dvec2> points) : points_(std::move(points)) {
    const auto n = static_cast<std::uint32_t>(points_.size());
    state_.assign(n, State::unknown);
    for (std::uint32_t i = 0; i < n; ++i) {
      previous_.push_back(i == 0 ? n - 1 : i - 1);
      next_.push_back(i + 1 == n ? 0 : i + 1);
    }
    sort_concave();
  }

  // Calls emit(a, b, c) for every triangle, with indices into the polygon.
  template <typename Emit>
  void run(const Emit& emit) {
    auto remaining = static_cast<std::uint32_t>(points_.size());
    std::uint32_t corner = 1, rejected = 0;
    while (remaining > 3) {
      if (rejected < remaining && !is_ear(corner)) {
        corner = next_[corner];
        ++rejected;
        spend(1);
        continue;
      }
      // If no corner is an ear, the polygon crosses itself or is flat, and any corner may be cut.
      emit(previous_[corner], corner, next_[corner]);
      remove(corner);
      --remaining;
      rejected = 0;
      // Skipping a corner gives compact triangles. Cutting the next corner would give a fan of slivers.
      corner = next_[next_[corner]];
    }
    emit(previous_[corner], corner, next_[corner]);
  }

 private:
  enum class State : std::uint8_t { unknown, blocked, removed };

  bool is_concave(std::uint32_t i) const {
    return turn_at(points_[previous_[i]], points_[i], points_[next_[i]]) <= 0.0;
  }

  void sort_concave() {
    const auto [left, right] =
        std::minmax_element(points_.begin(), points_.end(), [](auto a, auto b) { return a.x < b.x; });
    const auto [low, high] =
        std::minmax_element(points_.begin(), points_.end(), [](auto a, auto b) { return a.y < b.y; });
    axis_ = right->x - left->x >= high->y - low->y ? 0 : 1;
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      if (is_concave(i)) concave_.push_back(i);
    std::sort(concave_.begin(), concave_.end(),
              [this](std::uint32_t i, std::uint32_t j) { return points_[i][axis_] < points_[j][axis_]; });
  }

  bool is_ear(std::uint32_t i) {
    if (state_[i] == State::blocked) return false;
    if (!is_concave(i) && is_empty(points_[previous_[i]], points_[i], points_[next_[i]])) return true;
    state_[i] = State::blocked;
    return false;
  }

  // True if no concave corner lies in the triangle or on its sides. Corners at the same position as one of
  // the triangle's do not count: a bridge to a hole passes each of its points twice.
  bool is_empty(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    const auto [low, high] = std::minmax({a[axis_], b[axis_], c[axis_]});
    auto i = std::lower_bound(concave_.begin(), concave_.end(), low,
                              [this](std::uint32_t j, double value) { return points_[j][axis_] < value; });
    for (; i != concave_.end() && points_[*i][axis_] <= high; ++i) {
      spend(1);
      const glm::dvec2 p = points_[*i];
      if (state_[*i] == State::removed || p == a || p == b || p == c) continue;
      if (turn_at(a, b, p) >= 0.0 && turn_at(b, c, p) >= 0.0 && turn_at(c, a, p) >= 0.0 && is_concave(*i))
        return false;
    }
    return true;
  }

  void remove(std::uint32_t i) {
    state_[i] = State::removed;
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    state_[previous_[i]] = state_[next_[i]] = State::unknown;
  }

  void spend(std::uint64_t work) {
    work_ += work;
    if (work_ > kMaxWork) throw std::invalid_argument("a polygon has too many concave corners");
  }

  std::vector<glm::dvec2> points_;
  std::vector<std::uint32_t> previous_, next_, concave_;
  std::vector<State> state_;
  int axis_ = 0;
  std::uint64_t work_ = 0;
};

}  // namespace

void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon,
                 std::vector<glm::uvec3>& triangles) {
  const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    triangles.emplace_back(polygon[a], polygon[b], polygon[c]);
  };
  if (polygon.size() == 3)
    emit(0, 1, 2);
  else
    EarClipper(flatten(positions, polygon)).run(emit);
}

void join_cells(Scene& scene) {
  for (Mesh& mesh : scene.meshes) {
    Mesh quads{mesh.positions, {}, {}};
    for (std::size_t i = 0; i + 1 < mesh.triangles.size(); i += 2) {
      const glm::uvec3 upper = mesh.triangles[i], lower = mesh.triangles[i + 1];
      quads.add_quad({upper.x, upper.y, lower.y, upper.z}, mesh.colours[i]);
    }
    quads.clusters = clusters_of(quads);
    quads.origin = mesh.origin;
    mesh = std::move(quads);
  }
}

}  // namespace edgewise
