// The visible part of a triangle or convex polygon, in double: clipped by the near and far planes and divided
// by w, but neither cut by the guard band nor snapped.
//
// The front end rounds a new vertex to float and all vertices to 1/256 px, so an edge may lie up to
// kHairlinePx from its exact position (lab/clipping/clipping.h derives this). A sample farther than that from
// every edge is decided: there the picture must agree exactly. The other samples, fewer than one in 500, are
// judged by hit counts only.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "conformance/winding.h"
#include "lab/clipping/clipping.h"

namespace edgewise::conformance {

// Pixel coordinates and depth, both multiplied by w, and w.
using Homogeneous = glm::dvec4;

class Outline {
 public:
  explicit Outline(std::vector<Homogeneous> polygon) {
    for (const Homogeneous plane : {Homogeneous(0, 0, 1, 0), Homogeneous(0, 0, -1, 1)}) {
      std::vector<Homogeneous> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Homogeneous &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = glm::dot(plane, a), db = glm::dot(plane, b);
        if (da >= 0) kept.push_back(a);
        if ((da >= 0) != (db >= 0)) kept.push_back(a + (b - a) * (da / (da - db)));
      }
      polygon = kept;
    }
    for (const Homogeneous& v : polygon) positions_.emplace_back(v.x / v.w, v.y / v.w);
  }

  bool empty() const { return positions_.size() < 3; }

  // Like conformance::winding(), but only for decided samples.
  int winding(int px, int py) const {
    const glm::dvec2 s(px + 0.5, py + 0.5);
    int turns = 0;
    for_each_edge([&](glm::dvec2 p, glm::dvec2 q) {
      const bool down = p.y <= s.y && s.y < q.y, up = q.y <= s.y && s.y < p.y;
      if (!down && !up) return;
      const double side = (q.x - p.x) * (s.y - p.y) - (q.y - p.y) * (s.x - p.x);
      turns += (down && side > 0) - (up && side < 0);
    });
    return turns;
  }

  bool decides(int px, int py) const {
    const glm::dvec2 s(px + 0.5, py + 0.5);
    bool far_from_all = true;
    for_each_edge([&](glm::dvec2 p, glm::dvec2 q) {
      const glm::dvec2 along = q - p;
      const double length = glm::dot(along, along);
      const double t = length > 0 ? std::clamp(glm::dot(s - p, along) / length, 0.0, 1.0) : 0.0;
      if (glm::length(s - p - t * along) <= lab::kHairlinePx) far_from_all = false;
    });
    return far_from_all;
  }

  // Whether both ends of some edge lie at least this far off the image. If so, floats are too coarse to
  // position the edge.
  bool reaches_beyond(double px) const {
    bool beyond = false;
    for_each_edge([&](glm::dvec2 p, glm::dvec2 q) {
      const auto out = [](glm::dvec2 v) { return std::max(std::abs(v.x), std::abs(v.y)); };
      if (std::min(out(p), out(q)) > px) beyond = true;
    });
    return beyond;
  }

 private:
  template <typename Visit>
  void for_each_edge(Visit&& visit) const {
    for (std::size_t i = 0; i < positions_.size(); ++i)
      visit(positions_[i], positions_[(i + 1) % positions_.size()]);
  }

  std::vector<glm::dvec2> positions_;
};

}  // namespace edgewise::conformance
