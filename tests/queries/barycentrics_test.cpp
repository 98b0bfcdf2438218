// Rule 11 of the contract: barycentric coordinates and distances.
#include "edgewise/barycentrics.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "edgewise/builtin.h"
#include "edgewise/draw.h"
#include "edgewise/visible.h"
#include "frontend/clip.h"
#include "frontend/transform.h"
#include "lab/cases/random_cases.h"
#include "lab/truth/truth.h"
#include "message_of.h"
#include "support.h"

namespace edgewise {
namespace {

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
  std::uint32_t id(int x, int y) const { return ids.payload_row(y)[x]; }
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
    const std::uint32_t id = shown_.id(x, y);
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
        exact[k].at = exact_corner(*scene, id, k);
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
  ClipVertex exact_corner(const Scene& scene, std::uint32_t id, int k) {
    return to_screen(scene, id)(position(scene, id, k));
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

double error_of(float value, const mpq_class& exact) {
  return mpq_class(abs(mpq_class(value) - exact)).get_d();
}

struct Counts {
  int pixels = 0, clipped = 0, tiny = 0;  // tiny: u is positive but rounds to 0
  double most_by_w = 0.0;                 // the largest error of u by that of w, over its bound
};

// Compares every pixel with the truth.
void expect_rule(const Shown& shown, const std::string& what, Counts& counts) {
  const Planes planes = shown.planes();
  Truth truth(shown);
  shown.for_each_pixel([&](int x, int y, std::size_t pixel) {
    const float u = planes.uv[2 * pixel], v = planes.uv[2 * pixel + 1], distance = planes.distance[pixel];
    if (!shown.has(x, y)) {
      ASSERT_TRUE(u == 0.0f && v == 0.0f && distance == kInfinity) << what;
      return;
    }
    const auto where = [&] { return what + ", " + std::to_string(x) + ", " + std::to_string(y); };
    const auto exact = truth.at(x, y);
    ASSERT_TRUE(exact) << where();
    ASSERT_LT(error_of(u, exact->u), contract::kBarycentricError) << where();
    ASSERT_LT(error_of(v, exact->v), contract::kBarycentricError) << where();
    const bool scene = std::holds_alternative<Scene>(shown.drawable);
    ASSERT_LT(error_of(distance, exact->distance),
              contract::kDistanceError * (scene ? exact->distance.get_d() : 1.0))
        << where();
    ASSERT_LT(error_of(u, exact->true_u), contract::kBarycentricError + exact->w_error / 2) << where();
    ASSERT_LT(error_of(v, exact->true_v), contract::kBarycentricError + exact->w_error / 2) << where();
    ASSERT_LT(error_of(distance, exact->true_distance),
              (contract::kDistanceError + exact->w_error) * (scene ? exact->true_distance.get_d() : 1.0))
        << where();
    if (exact->w_error > 0.0) {
      const double by_w = mpq_class(abs(mpq_class(exact->u - exact->true_u))).get_d();
      counts.most_by_w = std::max(counts.most_by_w, by_w / (exact->w_error / 2));
    }
    ASSERT_GE(u, 0.0f) << where();
    ASSERT_GE(v, 0.0f) << where();
    ASSERT_LE(u + v, 1.0f) << where();
    // Floats hold all three weights exactly, in any order of operations.
    ASSERT_EQ(double{1.0f - u - v}, 1.0 - double{u} - double{v}) << where();
    ASSERT_EQ(double{1.0f - (u + v)}, 1.0 - double{u} - double{v}) << where();
    ++counts.pixels;
    counts.clipped += exact->clipped;
    counts.tiny += exact->u != 0 && u == 0.0f;
  });
}

TEST(Barycentrics, AreWithinTheContractsErrorInRandomScenesAndStreams) {
  const auto families = randomized::scene_families();
  for (std::size_t family = 0; family < families.size(); ++family) {
    Counts counts;
    const std::uint64_t trials = testing::full_size() ? 400 : 40;
    for (std::uint64_t trial = 0; trial < trials; ++trial) {
      Random random(1000 * family + trial);
      const int width = testing::between(random, 1, 60), height = testing::between(random, 1, 60);
      const Drawable drawable = families[family].make(random, width, height);
      const Cull cull = cull_modes()[random.below(3)];
      expect_rule(Shown(drawable, {.width = width, .height = height, .cull = cull}),
                  std::string(families[family].name) + " " + std::to_string(trial), counts);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(counts.pixels, 3000) << families[family].name;
    EXPECT_GT(counts.clipped, 300) << families[family].name;
  }
}

// Screen triangles as a stream, which snaps them to the same positions.
TriangleStream stream_of(const std::vector<ScreenTriangle>& triangles, int width, int height) {
  TriangleStream stream{width, height, {}};
  for (const ScreenTriangle& t : triangles) {
    StreamTriangle& out = stream.triangles.emplace_back();
    for (int i = 0; i < 3; ++i)
      out.vertex[i] = {static_cast<float>(t.x_q15[i]) / contract::kPixel_q15,
                       static_cast<float>(t.y_q15[i]) / contract::kPixel_q15,
                       static_cast<float>(contract::depth01(t.z[i]))};
  }
  return stream;
}

TEST(Barycentrics, AreWithinTheContractsErrorInHardStreams) {
  for (const auto family : testing::kFamilies) {
    Counts counts;
    constexpr int kSize = 70;
    const auto triangles = testing::adversarial(family, 200, kSize, kSize, 48);
    expect_rule(
        Shown(stream_of(triangles, kSize, kSize), {.width = kSize, .height = kSize, .cull = Cull::none}),
        std::string(family), counts);
    if (HasFatalFailure()) return;
    EXPECT_GT(counts.pixels, 0) << family;
  }
}

// A floor that reaches from before the near plane far away, with w up to 2^30 times as large.
TEST(Barycentrics, AreWithinTheContractsErrorAtExtremeDepths) {
  Counts counts;
  for (const float length : {1e2f, 1e5f, 1e9f}) {
    Scene scene;
    scene.meshes.push_back({{{-1, -1, 0.5f}, {-1, -1, -length}, {length, -1, -length}, {3, -1, 0.5f}},
                            {{0, 1, 2}, {0, 2, 3}},
                            {0, 0}});
    scene.instances.emplace_back();
    scene.camera.near_z = 0.01f, scene.camera.far_z = 1e10f;
    for (const float pitch : {-1.5f, -0.5f, -0.01f}) {
      scene.camera.pitch = pitch;
      expect_rule(Shown(scene, {.width = 64, .height = 64, .cull = Cull::none}), std::to_string(length),
                  counts);
    }
  }
  EXPECT_GT(counts.clipped, 3000);
  EXPECT_GT(counts.tiny, 0);
}

// Triangles of any shape and place in the view, whose w are up to 2^12 times as large as others', seen by
// cameras up to 2^20 sizes away from the mesh's origin, also by matrices.
TEST(Barycentrics, AreWithinTheErrorOfWForManyCameras) {
  Counts counts;
  Random random(29);
  for (int trial = 0; trial < (testing::full_size() ? 2000 : 150); ++trial) {
    Scene scene;
    Camera& camera = scene.camera;
    camera.fov_y = random.uniform(0.02f, 3.0f);
    camera.yaw = random.uniform(-3, 3), camera.pitch = random.uniform(-1.5f, 1.5f);
    camera.near_z = 0.01f, camera.far_z = 1e5f;
    const double away = std::ldexp(1.0, testing::between(random, -4, 20));
    for (int i = 0; i < 3; ++i) camera.position[i] = away * double{random.uniform(-1, 1)};
    const glm::dmat3 to_world = glm::transpose(to_camera_frame(camera));
    const double up = std::tan(double{camera.fov_y} / 2);
    Mesh& mesh = scene.meshes.emplace_back();
    for (unsigned i = 0; i < 24; ++i) {
      const double w = std::ldexp(1.0, testing::between(random, -2, 10)) * double{random.uniform(1, 2)};
      const glm::dvec3 seen(w * up * double{random.uniform(-1.2f, 1.2f)},
                            w * up * double{random.uniform(-1.2f, 1.2f)}, -w);
      mesh.positions.emplace_back(camera.position + to_world * seen);
      if (i % 3 == 0) mesh.triangles.emplace_back(i, i + 1, i + 2), mesh.colours.push_back(0);
    }
    scene.instances.emplace_back();
    if (trial % 2 == 1) scene.matrices = matrices_of(camera, 1.0);
    expect_rule(Shown(scene, {.width = 40, .height = 40, .cull = Cull::none}), std::to_string(trial), counts);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(counts.pixels, 50'000);
  EXPECT_GT(counts.most_by_w, 0.05)
      << "of the bound: the cases are hard enough to find a bound that is much too small";
}

TEST(Barycentrics, AreTheSameOnEveryTargetAndThreadCount) {
  for (const auto& family : randomized::scene_families()) {
    Random random(7);
    Shown shown(family.make(random, 150, 90), {.width = 150, .height = 90, .cull = Cull::none});
    const Planes expected = shown.planes();
    for (const int threads : {2, 3, 8}) EXPECT_TRUE(shown.planes(threads) == expected) << family.name;
    for (const SimdTarget target : supported_targets())
      EXPECT_TRUE(shown.planes(1, target) == expected) << family.name << ", " << name_of(target);
    const FrameView ids = shown.ids.view();  // the same, with ids that begin at 9
    for (int y = 0; y < ids.height; ++y)
      for (int x = 0; x < ids.width; ++x) ids.payload[y * ids.stride + x] += 9;
    shown.options.first_id = 9;
    EXPECT_TRUE(shown.planes() == expected) << family.name;
  }
}

// More visible triangles than the cache holds, so that some are made again.
TEST(Barycentrics, ManyTrianglesHaveTheCoordinatesOfEachAlone) {
  const Shown shown(find_scene("sphere").make({}), {.width = 500, .height = 500});
  const Planes all = shown.planes();
  Counts counts;
  Truth truth(shown);
  shown.for_each_pixel([&](int x, int y, std::size_t pixel) {
    if (!shown.has(x, y) || pixel % 17 != 0) return;
    const auto exact = truth.at(x, y);
    ASSERT_TRUE(exact);
    ASSERT_LT(error_of(all.uv[2 * pixel], exact->u), contract::kBarycentricError);
    ASSERT_LT(error_of(all.uv[2 * pixel + 1], exact->v), contract::kBarycentricError);
    ++counts.pixels;
  });
  EXPECT_GT(visible_triangles(shown.ids).size(), 10'000u);
  EXPECT_GT(counts.pixels, 3000);
}

// Independent of snapping, clipping and rule 11: the interpolated position lies behind the pixel's centre.
TEST(Barycentrics, InterpolatedPositionsProjectToThePixel) {
  const auto families = randomized::scene_families();
  for (const auto& family : families) {
    int pixels = 0;
    for (std::uint64_t trial = 0; trial < 30; ++trial) {
      Random random(trial);
      const int width = 60, height = 40;
      const Drawable drawable = family.make(random, width, height);
      const auto* scene = std::get_if<Scene>(&drawable);
      if (scene == nullptr) continue;
      const Shown shown(drawable, {.width = width, .height = height, .cull = Cull::none});
      const Planes planes = shown.planes();
      const auto first = first_ids(*scene);
      const double focal = height / 2.0 / std::tan(double{scene->camera.fov_y} / 2);
      shown.for_each_pixel([&](int x, int y, std::size_t pixel) {
        if (!shown.has(x, y)) return;
        const std::size_t id = shown.id(x, y),
                          i = static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), id) -
                                                       first.begin()) -
                              1;
        const Instance& instance = scene->instances[i];
        const Mesh& mesh = scene->meshes[instance.mesh];
        const glm::uvec3 corners = mesh.triangles[id - first[i]];
        const double u = planes.uv[2 * pixel], v = planes.uv[2 * pixel + 1];
        const glm::dmat4 model = model_matrix(mesh, instance);
        glm::dvec3 seen[3];  // from the camera
        double size = 0, reach = 0;
        for (int k = 0; k < 3; ++k) {
          seen[k] = glm::dvec3(model * glm::dvec4(glm::dvec3(mesh.positions[corners[k]]), 1.0)) -
                    scene->camera.position;
          reach = std::max(reach, glm::length(seen[k]));
        }
        for (int k = 0; k < 3; ++k) size = std::max(size, glm::length(seen[k] - seen[(k + 1) % 3]));
        const glm::dvec3 point = (1 - u - v) * seen[0] + u * seen[1] + v * seen[2];
        const glm::dvec3 p = pixels_of(scene->camera, width, height) * point;
        // Snapping and clipping; the positions' rounding; that of u and v.
        const double bound = 0x1p-6 + contract::kPositionError * (focal + 2 * width) * reach / p.z +
                             0x1p-23 * (focal + width) * size / p.z;
        if (!(p.z > 0) || bound > 0.1) return;
        const double z_bound = contract::kPositionError * reach + 0x1p-22 * size;
        ASSERT_NEAR(p.x / p.z, x + 0.5, bound) << family.name << trial;
        ASSERT_NEAR(p.y / p.z, y + 0.5, bound) << family.name << trial;
        ASSERT_NEAR(double{planes.distance[pixel]}, p.z, z_bound + 0x1p-23 * p.z) << family.name << trial;
        ++pixels;
      });
    }
    EXPECT_TRUE(pixels > 3000 || family.name == "stream") << family.name << ", " << pixels;
  }
}

// A triangle in the middle of the image, and one that the camera does not see.
Scene two_triangles() {
  Scene scene;
  scene.meshes.push_back(
      {{{-1, -1, -3}, {-1, 1, -3}, {1, -1, -3}, {0, 0, 9}}, {{0, 1, 2}, {3, 3, 3}}, {0, 0}});
  scene.instances.emplace_back();
  return scene;
}

TEST(Barycentrics, WritesOnlyRowsAndPlanesOfTheView) {
  const Shown shown(two_triangles(), {.width = 40, .height = 30});
  const Planes expected = shown.planes();
  std::vector<float> uv(100 * 30, -7.0f), distance(50 * 30, -7.0f);
  barycentrics(shown.ids, shown.drawable, shown.options, {uv.data(), 100});
  barycentrics(shown.ids, shown.drawable, shown.options, {nullptr, 0, distance.data(), 50});
  for (std::size_t y = 0; y < 30; ++y) {
    EXPECT_EQ(std::memcmp(&uv[100 * y], &expected.uv[80 * y], 80 * sizeof(float)), 0);
    EXPECT_EQ(std::memcmp(&distance[50 * y], &expected.distance[40 * y], 40 * sizeof(float)), 0);
    EXPECT_EQ(std::count(&uv[100 * y], &uv[100 * y] + 100, -7.0f), 20);
    EXPECT_EQ(std::count(&distance[50 * y], &distance[50 * y] + 50, -7.0f), 10);
  }
}

TEST(Barycentrics, RejectsWhatDoesNotFit) {
  const Shown shown(two_triangles(), {.width = 40, .height = 30});
  std::vector<float> uv(80 * 30, -7.0f), distance(40 * 30, -7.0f);
  struct Call {
    ConstFrameView ids;
    Drawable drawable;
    FrontendOptions options;
    BarycentricsView out;
    Execution execution = {};
  };
  const auto message = [&](auto&& change) {
    Call call{shown.ids, shown.drawable, shown.options, {uv.data(), 80, distance.data(), 40}};
    change(call);
    return message_of([&] { barycentrics(call.ids, call.drawable, call.options, call.out, call.execution); });
  };
  const auto scene = [](Call& call) -> Scene& { return std::get<Scene>(call.drawable); };
  EXPECT_EQ(message([](Call& c) { c.options.width = 41; }),
            "options for 41 x 30 px, but a frame of 40 x 30 px");
  EXPECT_EQ(message([](Call& c) { c.options.payload = Payload::colour; }),
            "barycentric coordinates need a frame of ids: Payload::id");
  for (const int threads : {0, 257})
    EXPECT_EQ(message([&](Call& c) { c.execution.threads = threads; }),
              std::to_string(threads) + " threads are outside 1 to 256");
  EXPECT_EQ(message([](Call& c) { c.ids.depth = nullptr; }),
            "frame of 40 x 30 px, stride 48, cannot be read");
  EXPECT_EQ(message([](Call& c) { c.ids.payload = nullptr; }), "the frame has no payload");
  EXPECT_EQ(message([](Call& c) { c.ids.stride = 39; }), "frame of 40 x 30 px, stride 39, cannot be read");
  EXPECT_EQ(message([](Call& c) { c.out.uv = c.out.distance = nullptr; }),
            "barycentric coordinates need memory to write to: both planes are null");
  EXPECT_EQ(message([](Call& c) { c.out.uv_stride = 79; }),
            "barycentric coordinates need a stride of at least a row's floats");
  EXPECT_EQ(message([](Call& c) { c.out.distance_stride = 39; }),
            "barycentric coordinates need a stride of at least a row's floats");
  EXPECT_EQ(message([&](Call& c) { scene(c).instances[0].mesh = 1; }), "an instance names mesh 1 of 1");
  EXPECT_EQ(message([&](Call& c) { scene(c).meshes[0].flags = {0}; }), "a mesh has 2 triangles and 1 flags");
  EXPECT_EQ(message([&](Call& c) { scene(c).camera.near_z = 0; }),
            "the camera needs 0 < near < far, not 0 and 100");
  EXPECT_EQ(std::count(uv.begin(), uv.end(), -7.0f), 80 * 30) << "written before an error";
  EXPECT_EQ(std::count(distance.begin(), distance.end(), -7.0f), 40 * 30) << "written before an error";

  // Found at the first pixel, whichever thread is first.
  std::string first;
  shown.for_each_pixel([&](int x, int y, std::size_t) {
    if (first.empty() && shown.has(x, y))
      first = std::string("(") + std::to_string(x) + ", " + std::to_string(y) + ")";
  });
  for (const int threads : {1, 3}) {
    const auto on_threads = [&](auto&& change) {
      return message([&](Call& c) { c.execution.threads = threads, change(c); });
    };
    constexpr const char* kElsewhere = " has id 0, of a triangle that does not cover it";
    EXPECT_EQ(on_threads([&](Call& c) { scene(c).camera.yaw = 2.0f; }), "pixel " + first + kElsewhere);
    EXPECT_EQ(on_threads([&](Call& c) { c.options.cull = Cull::front; }), "pixel " + first + kElsewhere);
    EXPECT_EQ(on_threads([&](Call& c) { scene(c).meshes[0].positions.resize(2); }),
              "pixel " + first + kElsewhere);
    EXPECT_EQ(on_threads([&](Call& c) {
                c.drawable = TriangleStream{40, 30, {}};
              }),
              "pixel " + first + " has id 0 of 0 triangles");
    EXPECT_EQ(on_threads([&](Call& c) { c.options.first_id = 1; }),
              "pixel " + first + " has id 0 of 2 triangles from 1 on");
  }
}

}  // namespace
}  // namespace edgewise
