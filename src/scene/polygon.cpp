// Ear clipping (Meisters, "Polygons have ears", 1975; as in Eberly, "Triangulation by ear clipping"). A
// corner is cut off if its triangle contains no concave corner of the remaining polygon. A cut changes only
// the two neighbouring corners. So a corner that cannot be cut is tested again only after a neighbour is
// removed. A k-d tree finds the concave corners in a triangle: large polygons take about n log n time.
#include "scene/polygon.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace edgewise {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

struct Box {
  glm::dvec2 low, high;
};
struct Triangle {
  glm::dvec2 a, b, c;  // counter-clockwise
  Box box{glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
};

// True if all points of the box lie on the right of the line from a to b, as turn_at() says: rounding is
// monotonic, so it suffices to ask for the corner farthest to the left.
bool is_right_of(glm::dvec2 a, glm::dvec2 b, const Box& box) {
  return turn_at(a, b, {b.y > a.y ? box.low.x : box.high.x, b.x > a.x ? box.high.y : box.low.y}) < 0.0;
}

// The corners of a polygon, in order, or some of them.
struct Ring {
  std::vector<std::uint32_t> previous, next;

  explicit Ring(std::size_t corners) : previous(corners), next(corners) {
    std::iota(next.begin(), next.end(), 1u);
    std::iota(previous.begin() + 1, previous.end(), 0u);
    previous.front() = next[corners - 2];
    next.back() = 0;
  }
  void insert(std::uint32_t i, std::uint32_t before, std::uint32_t after) {
    previous[i] = before, next[i] = after;
    next[before] = previous[after] = i;
  }
  void remove(std::uint32_t i) {
    next[previous[i]] = next[i];
    previous[next[i]] = previous[i];
  }
};

class EarClipper {
 public:
  EarClipper(std::vector<glm::dvec2> points, std::uint64_t& steps_left)
      : points_(std::move(points)), ring_(points_.size()), candidates_(ring_), steps_left_(steps_left) {
    const auto n = static_cast<std::uint32_t>(points_.size());
    state_.assign(n, State::candidate);
    for (std::uint32_t i = 0; i < n; ++i)
      if (is_concave(i)) {
        concave_.push_back(i);
        box_ = {glm::min(box_.low, points_[i]), glm::max(box_.high, points_[i])};
      }
    sort(concave_, 0);
  }

  // Calls emit(a, b, c) for every triangle, with indices into the polygon.
  template <typename Emit>
  void run(const Emit& emit) {
    std::uint32_t start = 1, corner = start;
    for (std::size_t remaining = points_.size(); remaining > 3; --remaining) {
      while (!is_ear(corner)) {
        state_[corner] = State::blocked;
        candidates_.remove(corner);
        corner = candidates_.next[corner];
        if (state_[corner] == State::candidate) continue;
        // If no corner is an ear, the polygon crosses itself or is flat, and any corner may be cut.
        corner = candidates_.next[start] = candidates_.previous[start] = start;
        break;
      }
      const std::uint32_t before = ring_.previous[corner], after = ring_.next[corner];
      emit(before, corner, after);
      make_candidate(before, candidates_.previous[corner], corner);
      make_candidate(after, corner, candidates_.next[corner]);
      state_[corner] = State::removed;
      ring_.remove(corner), candidates_.remove(corner);
      // Skipping a corner gives compact triangles. Cutting the next corner would give a fan of slivers.
      start = ring_.next[after];
      corner = candidates_.next[after];
    }
    emit(ring_.previous[start], start, ring_.next[start]);
  }

 private:
  enum class State : std::uint8_t { candidate, blocked, removed };

  void make_candidate(std::uint32_t i, std::uint32_t previous, std::uint32_t next) {
    if (std::exchange(state_[i], State::candidate) != State::candidate) candidates_.insert(i, previous, next);
  }

  bool is_concave(std::uint32_t i) const {
    return turn_at(points_[ring_.previous[i]], points_[i], points_[ring_.next[i]]) <= 0.0;
  }

  // Makes a k-d tree: the middle element splits the others along `axis`, those of both halves along the other
  // axis.
  void sort(std::span<std::uint32_t> corners, int axis) {
    if (corners.size() < 2) return;
    const std::size_t middle = corners.size() / 2;
    std::nth_element(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(middle), corners.end(),
                     [&](auto i, auto j) { return points_[i][axis] < points_[j][axis]; });
    sort(corners.first(middle), 1 - axis);
    sort(corners.subspan(middle + 1), 1 - axis);
  }

  bool is_ear(std::uint32_t i) {
    return !is_concave(i) &&
           !blocks(concave_, 0, box_, {points_[ring_.previous[i]], points_[i], points_[ring_.next[i]]});
  }

  // True if a concave corner of the k-d tree, whose corners are all in the box, lies in the triangle or on
  // its sides. Corners at the same position as one of the triangle's do not count: a bridge to a hole passes
  // each of its points twice.
  bool blocks(std::span<const std::uint32_t> tree, int axis, const Box& box, const Triangle& triangle) {
    const auto& [a, b, c, around] = triangle;
    if (tree.empty() || is_right_of(a, b, box) || is_right_of(b, c, box) || is_right_of(c, a, box))
      return false;
    if (steps_left_ == 0)
      throw std::invalid_argument("filling its " + std::to_string(points_.size()) +
                                  " corners takes too many steps");
    --steps_left_;
    const std::size_t middle = tree.size() / 2;
    const std::uint32_t i = tree[middle];
    const glm::dvec2 p = points_[i];
    if (state_[i] != State::removed && p != a && p != b && p != c && turn_at(a, b, p) >= 0.0 &&
        turn_at(b, c, p) >= 0.0 && turn_at(c, a, p) >= 0.0 && is_concave(i))
      return true;
    Box before = box, after = box;
    before.high[axis] = after.low[axis] = p[axis];
    return (around.low[axis] <= p[axis] && blocks(tree.first(middle), 1 - axis, before, triangle)) ||
           (around.high[axis] >= p[axis] && blocks(tree.subspan(middle + 1), 1 - axis, after, triangle));
  }

  std::vector<glm::dvec2> points_;
  Ring ring_, candidates_;  // candidates: the corners that may be ears
  std::vector<std::uint32_t> concave_;
  std::vector<State> state_;
  Box box_{glm::dvec2(kInfinity), glm::dvec2(-kInfinity)};  // of the concave corners
  std::uint64_t& steps_left_;                               // nodes of the tree to visit
};

}  // namespace

void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon,
                 std::vector<glm::uvec3>& triangles, std::uint64_t& steps_left) {
  const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    triangles.emplace_back(polygon[a], polygon[b], polygon[c]);
  };
  if (polygon.size() == 3)
    emit(0, 1, 2);
  else
    EarClipper(flatten(positions, polygon), steps_left).run(emit);
}

void join_cells(Scene& scene) {
  for (Mesh& mesh : scene.meshes) {
    Mesh quads{mesh.positions, {}, {}};
    for (std::size_t i = 0; i + 1 < mesh.triangles.size(); i += 2) {
      const glm::uvec3 upper = mesh.triangles[i], lower = mesh.triangles[i + 1];
      quads.add_quad({upper.x, upper.y, lower.y, upper.z}, mesh.colours[i]);
    }
    quads.clusters = clusters_of(quads);
    quads.parts = std::move(mesh.parts), quads.origin = mesh.origin;
    mesh = std::move(quads);
  }
}

}  // namespace edgewise
