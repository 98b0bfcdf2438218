// Frames of ids, what barycentrics() makes of them, and the exact values of rule 11.
#pragma once

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "edgewise/barycentrics.h"
#include "edgewise/draw.h"
#include "edgewise/visible.h"
#include "frontend/clip.h"
#include "frontend/transform.h"
#include "lab/truth/truth.h"

namespace edgewise::testing {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Planes {
  std::vector<float> uv, distance;
  bool operator==(const Planes&) const = default;
};

// A frame of ids and what barycentrics() makes of it, row after row.
struct Shown {
  Shown(const Drawable& d, const FrontendOptions& o) : drawable(d), options(o), ids(o.width, o.height) {
    options.payload = Payload::id;
    Frontend frontend;
    draw(drawable, frontend, options, *find_backend("naive").make(), ids.view());  // an id too
  }

  Planes planes(int threads = 1, SimdTarget target = SimdTarget::best) const {
    const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
    Planes planes{std::vector<float>(2 * pixels, -1.0f), std::vector<float>(pixels, -1.0f)};
    barycentrics(ids, drawable, options,
                 {planes.uv.data(), 2 * options.width, planes.distance.data(), options.width},
                 {.threads = threads, .target = target});
    return planes;
  }
  bool has(int x, int y) const { return ids.depth_row(y)[x] != contract::kDepthClear; }
  // Calls visit(x, y, index of the pixel) until a test fails.
  template <typename Visit>
  void for_each_pixel(Visit&& visit) const {
    std::size_t pixel = 0;
    for (int y = 0; y < options.height; ++y)
      for (int x = 0; x < options.width && !::testing::Test::HasFatalFailure(); ++x) visit(x, y, pixel++);
  }

  Drawable drawable;
  FrontendOptions options;
  Framebuffer ids;
};

// A vertex of a clipped polygon, with exact weights.
struct ExactVertex {
  ClipVertex at;
  double true_w, w_error;  // w before it is rounded to float, and rule 11's bound of e / (1 - e)
  std::array<mpq_class, 3> weights;
  Vertex snapped{};
};

// The exact values of rule 11 at any pixel, from a clipper of its own. It rounds where the rule says that the
// clipper rounds: the positions of new vertices, and t.
class Truth {
 public:
  explicit Truth(const Shown& shown) : shown_(shown) {
    if (const auto* scene = std::get_if<Scene>(&shown.drawable)) {
      first_ids_ = first_ids(*scene);
      view_ = View(*scene, shown.options.width, shown.options.height).volume;
    } else {
      view_ = {double(shown.options.width), double(shown.options.height), 0.0, 1.0};
    }
  }

  struct Values {
    mpq_class u, v, distance;
    bool clipped;
    mpq_class true_u, true_v, true_distance;  // with the true w
    double w_error;
  };
  std::optional<Values> at(int x, int y) {
    const std::uint32_t id = shown_.ids.payload_row(y)[x];
    if (id_ != id) id_ = id, make_pieces(id);
    for (const Piece& piece : pieces_) {
      const ScreenTriangle t{{piece[0].snapped.x_q15, piece[1].snapped.x_q15, piece[2].snapped.x_q15},
                             {piece[0].snapped.y_q15, piece[1].snapped.y_q15, piece[2].snapped.y_q15},
                             {},
                             id};
      const lab::SnappedTruth coverage(t);
      const int hidden = cull_ == Cull::back ? -1 : cull_ == Cull::front ? 1 : 0;
      if (cull_ == Cull::both || coverage.facing() == hidden || !coverage.covers(x, y)) continue;
      mpq_class sum = 0, z = 0, u = 0, v = 0, true_sum = 0, true_z = 0, true_u = 0, true_v = 0;
      double w_error = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vertex &a = piece[(i + 1) % 3].snapped, &b = piece[(i + 2) % 3].snapped;
        const mpq_class sx = contract::sample_q15(x), sy = contract::sample_q15(y);
        const mpq_class edge = (b.x_q15 - a.x_q15) * (sy - a.y_q15) - (b.y_q15 - a.y_q15) * (sx - a.x_q15);
        const mpq_class weight = edge * coverage.facing() / mpq_class(piece[i].at.w);
        sum += weight, z += weight * mpq_class(piece[i].at.z);
        u += weight * piece[i].weights[1], v += weight * piece[i].weights[2];
        const mpq_class true_weight = weight * mpq_class(piece[i].at.w) / mpq_class(piece[i].true_w);
        true_sum += true_weight;
        true_z += true_weight * mpq_class(first_ids_.empty() ? piece[i].at.z : piece[i].true_w);
        true_u += true_weight * piece[i].weights[1], true_v += true_weight * piece[i].weights[2];
        w_error = std::max(w_error, piece[i].w_error);
      }
      return Values{u / sum,           v / sum,           z / sum,           clipped_,
                    true_u / true_sum, true_v / true_sum, true_z / true_sum, w_error};
    }
    return {};
  }

 private:
  using Piece = std::array<ExactVertex, 3>;

  void make_pieces(std::uint32_t id) {
    pieces_.clear();
    cull_ = shown_.options.cull;
    ExactVertex rounded[3], exact[3];
    std::uint32_t sides = 0;
    for (int k = 0; k < 3; ++k) {
      rounded[k].at = exact[k].at = corner(id, k, rounded[k]);
      rounded[k].weights[static_cast<std::size_t>(k)] = exact[k].weights[static_cast<std::size_t>(k)] = 1;
      rounded[k].true_w = rounded[k].at.w, rounded[k].w_error = 0.0;
      if (const auto* scene = std::get_if<Scene>(&shown_.drawable)) {
        exact[k].at = to_screen(*scene, id)(position(*scene, id, k));
        rounded[k].true_w = exact[k].at.w;
        rounded[k].w_error = w_error(to_screen(*scene, id), position(*scene, id, k), exact[k].at.w);
      }
      sides |= rounded[k].snapped.outside & kMustClip;
    }
    clipped_ = sides != 0;
    if (!clipped_) {
      pieces_.push_back({rounded[0], rounded[1], rounded[2]});
      return;
    }
    clip(rounded, exact);
  }

  // Fills the vertex's snapped position, if it needs no clipping.
  ClipVertex corner(std::uint32_t id, int k, ExactVertex& out) {
    ClipVertex v;
    if (const auto* scene = std::get_if<Scene>(&shown_.drawable)) {
      v = as_clip_vertex(transform(to_screen(*scene, id), position(*scene, id, k)));
      const auto inverse = 1.0f / static_cast<float>(v.w);
      out.snapped = {snap(static_cast<float>(v.x) * inverse), snap(static_cast<float>(v.y) * inverse), 0, 0};
      if (!std::isfinite(inverse)) out.snapped.outside = kNear;
    } else {
      const glm::vec3 p = std::get<TriangleStream>(shown_.drawable).triangles[id].vertex[k];
      v = {double{p.x}, double{p.y}, double{p.z}, 1.0};
      out.snapped = {snap(p.x), snap(p.y), 0, 0};
    }
    out.snapped.outside |= outside_of(v, view_);
    return v;
  }
  // Infinite beyond the condition of rules 10 and 11.
  static double w_error(const ScreenTransform& to_screen, glm::vec3 position, double w) {
    const double distance = glm::distance(glm::dvec3(position), glm::dvec3(to_screen.origin)),
                 length = glm::length(
                     glm::dvec3(to_screen.exact[0].z, to_screen.exact[1].z, to_screen.exact[2].z));
    if (glm::length(glm::dvec3(to_screen.origin)) > 0x1p24 * distance) return double{kInfinity};
    return contract::kWError * length * distance / w;
  }
  std::size_t instance_of(std::uint32_t id) const {
    std::size_t i = 0;
    while (first_ids_[i + 1] <= id) ++i;
    return i;
  }
  ScreenTransform to_screen(const Scene& scene, std::uint32_t id) {
    const Instance& instance = scene.instances[instance_of(id)];
    if (scene.meshes[instance.mesh].has_flag(id - first_ids_[instance_of(id)], kTwoSided)) cull_ = Cull::none;
    return {{scene, shown_.options.width, shown_.options.height},
            model_matrix(scene.meshes[instance.mesh], instance)};
  }
  glm::vec3 position(const Scene& scene, std::uint32_t id, int k) const {
    const Mesh& mesh = scene.meshes[scene.instances[instance_of(id)].mesh];
    return mesh.positions[mesh.triangles[id - first_ids_[instance_of(id)]][k]];
  }

  // Distance to a plane times a positive factor, as clip.cpp rounds it.
  double inside_of(const ClipVertex& v, int plane) const {
    const double guard = contract::kMaxImageSide * v.w;
    const double distances[] = {v.z - view_.near_z, view_.far_z - v.z, v.x + guard,
                                guard - v.x,        v.y + guard,       guard - v.y};
    return distances[plane];
  }

  void clip(const ExactVertex (&rounded)[3], const ExactVertex (&exact)[3]) {
    std::vector<ExactVertex> polygon;
    std::uint32_t planes = 0;
    for (int k = 0; k < 3; ++k) {
      const bool inside = is_inside(rounded[k].snapped);
      polygon.push_back(exact[k]);
      if (inside)
        polygon.back().at.corner = k;
      else
        planes |= outside_of(exact[k].at, view_);
    }
    if ((planes & kNear) != 0) planes |= kGuard;
    for (int plane = 0; plane < 6; ++plane) {
      if ((planes & (1u << plane)) == 0) continue;
      std::vector<ExactVertex> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const ExactVertex *a = &polygon[i], *b = &polygon[(i + 1) % polygon.size()];
        const auto distance = [&](const ExactVertex& v) {
          const double d = inside_of(v.at, plane);
          return v.at.corner >= 0 ? std::max(d, 0.0) : d;
        };
        if (distance(*a) >= 0.0) kept.push_back(*a);
        if ((distance(*a) >= 0.0) == (distance(*b) >= 0.0)) continue;
        if (distance(*a) < 0.0) std::swap(a, b);
        const double t = distance(*a) / (distance(*a) - distance(*b));
        ExactVertex cut;
        const auto between = [&](double from, double to) { return from + t * (to - from); };
        cut.at = {between(a->at.x, b->at.x), between(a->at.y, b->at.y), between(a->at.z, b->at.z),
                  between(a->at.w, b->at.w)};
        cut.true_w = cut.at.w, cut.w_error = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
          cut.weights[k] = (1 - mpq_class(t)) * a->weights[k] + mpq_class(t) * b->weights[k];
        kept.push_back(cut);
      }
      polygon = kept;
    }
    if (polygon.size() < 3) return;
    std::vector<Vertex> snapped;
    for (ExactVertex& v : polygon) {
      if (v.at.corner >= 0)
        v = rounded[v.at.corner];
      else
        v.snapped = {snap(x_px(v.at)), snap(y_px(v.at)), 0, 0};
      snapped.push_back(v.snapped);
    }
    const Pieces split_into = split(snapped);
    for (std::size_t i = 0; i < split_into.count; ++i) {
      const auto& at = split_into.corners[i];
      pieces_.push_back({polygon[at[0]], polygon[at[1]], polygon[at[2]]});
    }
  }

  const Shown& shown_;
  std::vector<std::size_t> first_ids_;
  ViewVolume view_{};
  std::optional<std::uint32_t> id_;  // whose pieces these are
  std::vector<Piece> pieces_;
  bool clipped_ = false;
  Cull cull_ = Cull::none;
};

}  // namespace edgewise::testing
