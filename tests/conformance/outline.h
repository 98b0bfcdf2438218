// The visible part of a triangle or convex polygon, in double: clipped by the near and far planes and divided
// by w, but neither cut by the guard band nor snapped.
//
// The front end rounds a cut vertex to float and all vertices to 1/256 px, so an edge may lie up to
// kHairlinePx from where it belongs (lab/clipping/clipping.h derives that). A sample that is farther than
// that from every edge is decided: there the picture must agree, without tolerance. The others, fewer than
// one in 500, are judged by hit counts only.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "conformance/winding.h"
#include "lab/clipping/clipping.h"

namespace edgewise::conformance {

// Pixels and depth, both times w, and w.
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
    for (const Homogeneous& v : polygon) places_.emplace_back(v.x / v.w, v.y / v.w);
  }

  bool empty() const { return places_.size() < 3; }

  // As conformance::winding(), for samples that are decided.
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

  // Whether floats can place all edges well: not where both ends lie this far out on either side of the
  // image.
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
    for (std::size_t i = 0; i < places_.size(); ++i) visit(places_[i], places_[(i + 1) % places_.size()]);
  }

  std::vector<glm::dvec2> places_;
};

}  // namespace edgewise::conformance
