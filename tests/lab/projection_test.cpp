// The exact projection of scenes, compared with rational arithmetic that projects and clips; and the methods.
#include "lab/projection/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/trigonometry.h"
#include "frontend/view.h"

namespace edgewise::lab {
namespace {

constexpr Size kSize{32, 16};

// x and y in pixels, depth from 0 to 1.
struct Point {
  mpq_class x, y, z;
};

using Vector = std::array<mpq_class, 4>;

Vector operator*(const glm::dmat4& m, const Vector& v) {
  Vector product;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      product[static_cast<std::size_t>(row)] +=
          mpq_class(m[column][row]) * v[static_cast<std::size_t>(column)];
  return product;
}

// In clip space.
Vector projected(const Scene& scene, const Instance& instance, const glm::vec3& p) {
  Vector v =
      model_matrix(scene.meshes[instance.mesh], instance) * Vector{double{p.x}, double{p.y}, double{p.z}, 1};
  if (scene.matrices) return scene.matrices->projection * (scene.matrices->view * v);
  const Camera& c = scene.camera;
  for (int i = 0; i < 3; ++i) v[static_cast<std::size_t>(i)] -= mpq_class(c.position[i]);
  v = glm::dmat4(to_camera_frame(c)) * v;
  const mpq_class focal(kSize.height / 2.0 / tangent(double{c.fov_y} / 2)), half_w(kSize.width / 2.0),
      half_h(kSize.height / 2.0), near_z(double{c.near_z}), far_z(double{c.far_z}), w = -v[2];
  return {focal * v[0] / half_w, focal * v[1] / half_h, far_z * (w - near_z) / (far_z - near_z), w};
}

// Clipped between near and far.
std::vector<Point> polygon_of(const Vector (&corners)[3]) {
  std::vector<Vector> polygon(corners, corners + 3);
  for (const bool is_far : {false, true}) {
    const auto inside = [&](const Vector& v) { return is_far ? mpq_class(v[3] - v[2]) : v[2]; };
    std::vector<Vector> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const mpq_class da = inside(a), db = inside(b);
      if (da >= 0) kept.push_back(a);
      if ((da >= 0) == (db >= 0)) continue;
      Vector& cut = kept.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) cut[k] = a[k] + da / (da - db) * (b[k] - a[k]);
    }
    polygon = kept;
  }
  std::vector<Point> result;
  const mpq_class half_w(kSize.width / 2.0), half_h(kSize.height / 2.0);
  for (const Vector& v : polygon)
    if (v[3] > 0) result.push_back({half_w * (1 + v[0] / v[3]), half_h * (1 - v[1] / v[3]), v[2] / v[3]});
  return result;
}

mpq_class area(const std::vector<Point>& p) {
  mpq_class sum;
  for (std::size_t i = 2; i < p.size(); ++i)
    sum += (p[i - 1].x - p[0].x) * (p[i].y - p[0].y) - (p[i - 1].y - p[0].y) * (p[i].x - p[0].x);
  return sum;
}

// The fill rule in another form: strictly inside after an infinitesimal move to the right, and a far smaller
// one down.
bool covers(const std::vector<Point>& polygon, int facing, int px, int py) {
  const mpq_class sx(px + 0.5), sy(py + 0.5);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    if (p.x == q.x && p.y == q.y) continue;
    const mpq_class a = p.y - q.y, b = q.x - p.x, here = a * (sx - p.x) + b * (sy - p.y);
    const int side = sgn(here) != 0 ? sgn(here) : sgn(a) != 0 ? sgn(a) : sgn(b);
    if (side * facing <= 0) return false;
  }
  return facing != 0;
}

// On the plane through the polygon.
mpq_class depth(const std::vector<Point>& p, int px, int py) {
  for (std::size_t i = 2; i < p.size(); ++i) {
    const mpq_class qx = p[i - 1].x - p[0].x, qy = p[i - 1].y - p[0].y, rx = p[i].x - p[0].x,
                    ry = p[i].y - p[0].y, det = qx * ry - qy * rx, x = mpq_class(px + 0.5) - p[0].x,
                    y = mpq_class(py + 0.5) - p[0].y;
    if (det == 0) continue;
    return p[0].z + (x * ry - y * rx) / det * (p[i - 1].z - p[0].z) +
           (qx * y - qy * x) / det * (p[i].z - p[0].z);
  }
  return 2;
}

// Triangles around the camera: far and near ones, some across the near or the far plane, some behind. With
// `on_samples`, matrices whose elements are few powers of two, and vertices that project onto samples.
Scene around_the_camera(std::uint64_t seed, bool on_samples) {
  Random random(seed);
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  const auto within = [&](float reach) { return random.uniform(-reach, reach); };
  for (unsigned i = 0; i < 40; ++i) {
    const float side = i % 4 == 0 ? 6.0f : 1.0f;
    const float x = within(3), y = within(2), z = within(6) - 4;
    for (int k = 0; k < 3; ++k) {
      glm::vec3 p(x + within(side), 0, 0);
      p.y = y + within(side), p.z = z + within(side);
      if (on_samples) {
        p.z = -std::ldexp(1.0f, static_cast<int>(random.below(3)));
        p.x = -p.z * (static_cast<float>(random.below(32)) + 0.5f - 16) / 8;
        p.y = -p.z * (static_cast<float>(random.below(16)) + 0.5f - 8) / 8;
      }
      mesh.positions.push_back(p);
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  mesh.colours.assign(mesh.triangles.size(), 0);
  mesh.positions[7].y = std::numeric_limits<float>::quiet_NaN();
  mesh.flags.assign(mesh.triangles.size(), 0);
  mesh.flags[5] = kTwoSided;
  scene.instances = {
      {}, {.scale = glm::dvec3(0.7), .axis = {1, 2, 3}, .angle = 0.4f, .translation = {0.1, 0.2, -1}}};
  scene.camera.near_z = 0.5f, scene.camera.far_z = 7.0f;
  if (on_samples) {
    scene.instances.resize(1);
    CameraMatrices& m = scene.matrices.emplace();
    m.projection = glm::dmat4(0.0);
    m.projection[0].x = 0.5, m.projection[1].y = 1.0;                   // 8 px per unit at distance 1
    m.projection[2] = {0, 0, -1.125, -1}, m.projection[3].z = -0.5625;  // from 0.5 to 4.5
  } else if (seed % 2 == 0) {
    scene.camera.position = {0.3, -0.2, 0.5};
    scene.camera.yaw = 0.3f, scene.camera.pitch = -0.2f;
  }
  return scene;
}

TEST(SceneTruth, AgreesWithRationalsThatProjectAndClip) {
  std::size_t covered = 0, clipped = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Scene scene = around_the_camera(seed, seed % 4 == 3);
    const Cull cull = seed % 3 == 0 ? Cull::none : seed % 3 == 1 ? Cull::back : Cull::front;
    const SceneTruth truth(scene, kSize, cull);
    const Window window{kSize.width, kSize.height};
    const std::vector<lab::Run> runs = truth.runs(window, 1);
    EXPECT_EQ(truth.runs(window, 2), runs);
    const VisibleTriangles visible = truth.visible_triangles(window, 2);
    std::vector<std::uint32_t> nearest(visible.triangle.size(), kNoTriangle);
    std::vector<mpq_class> depths(visible.triangle.size());
    std::uint32_t id = 0;
    for (const Instance& instance : scene.instances)
      for (std::size_t t = 0; t < scene.meshes[0].triangles.size(); ++t, ++id) {
        const Mesh& mesh = scene.meshes[0];
        const auto corner = [&](int k) { return mesh.positions[mesh.triangles[t][k]]; };
        std::vector<Point> polygon;
        if (t != 2) {
          polygon = polygon_of({projected(scene, instance, corner(0)), projected(scene, instance, corner(1)),
                                projected(scene, instance, corner(2))});
          clipped += polygon.size() > 3;
        }
        int facing = sgn(area(polygon));
        if (!keeps(cull, facing) && !mesh.has_flag(t, kTwoSided)) facing = 0;
        bool any = false;
        for (int y = 0; y < kSize.height; ++y)
          for (int x = 0; x < kSize.width; ++x) {
            const bool expected = covers(polygon, facing, x, y);
            ASSERT_EQ(truth.covers(id, x + 0.5, y + 0.5), expected)
                << seed << ": " << id << " at " << x << ", " << y;
            const bool in_runs = std::ranges::any_of(runs, [&](const lab::Run& run) {
              return run.triangle == id && run.y == y && run.x0 <= x && x < run.x1;
            });
            ASSERT_EQ(in_runs, expected) << seed << ": " << id << " at " << x << ", " << y;
            if (!expected) continue;
            any = true, ++covered;
            const mpq_class z = depth(polygon, x, y);
            ASSERT_LE(abs(mpq_class(truth.depth01(id, x + 0.5, y + 0.5)) - z), mpq_class(0x1p-36));
            const auto at = static_cast<std::size_t>(y * kSize.width + x);
            if (nearest[at] == kNoTriangle || z < depths[at]) nearest[at] = id, depths[at] = z;
          }
        if (!any) continue;
        ASSERT_EQ(truth.facing(id), facing) << id;
        const auto outline = truth.outline(id);
        ASSERT_EQ(outline.size(), polygon.size());
        for (const glm::dvec3& p : outline)
          EXPECT_TRUE(std::ranges::any_of(polygon, [&](const Point& q) {
            return std::abs(q.x.get_d() - p.x) < 1e-9 && std::abs(q.y.get_d() - p.y) < 1e-9 &&
                   std::abs(q.z.get_d() - p.z) < 1e-9;
          }));
      }
    EXPECT_EQ(visible.triangle, nearest) << seed;
  }
  EXPECT_GT(covered, 5'000u);
  EXPECT_GT(clipped, 50u);
}

TEST(ExactProjection, RoundsTheNearestPositionsToTheGrid) {
  for (const bool on_samples : {false, true}) {
    const SceneTruth truth(around_the_camera(2, on_samples), kSize, Cull::none);
    const Scene& scene = truth.scene();
    for (const int bits : {0, 4, 15})
      for (const ProjectedTriangle& t : exactly_projected(truth, bits)) {
        const auto [instance, index] = truth.source(t.source);
        const auto corner = [&](int k) {
          return projected(scene, scene.instances[instance], truth.position(t.source, k));
        };
        const auto polygon = polygon_of({corner(0), corner(1), corner(2)});
        for (int k = 0; k < 3; ++k) {
          EXPECT_EQ(std::ldexp(t.x_px[k], bits), std::nearbyint(std::ldexp(t.x_px[k], bits)));
          if (std::abs(t.x_px[k]) > 16000 || std::abs(t.y_px[k]) > 16000) continue;  // by the guard band
          const bool found = std::ranges::any_of(polygon, [&](const Point& p) {
            const mpq_class half(std::ldexp(0.5, -bits));
            return abs(p.x - mpq_class(t.x_px[k])) <= half && abs(p.y - mpq_class(t.y_px[k])) <= half;
          });
          const bool guarded = std::ranges::any_of(
              polygon, [](const Point& p) { return abs(p.x) > 16000 || abs(p.y) > 16000; });
          EXPECT_TRUE(found || guarded) << t.source << " with " << bits << " bits";
        }
      }
  }
}

ProjectionScore score(std::string_view method, const ProjectionJudge& judge) {
  const auto name_of = [](const ProjectionMethod& m) { return m.info.name; };
  return judge.score(*std::ranges::find(projection_methods(), method, name_of));
}

TEST(Projection, SaysWhichPartOfTheErrorsComesFromWhere) {
  const ProjectionJudge sphere(sphere_scene(64, 96), {960, 540}, 2);
  const ProjectionScore ours = score("ours_8", sphere), floats = score("ours_float", sphere);
  EXPECT_EQ(ours.by_rounding, score("exact_8", sphere).wrong);
  // By the sweeps' theory, rounding to 1/256 px moves 650 to 1300 per million of crossings.
  EXPECT_NEAR(1e6 * static_cast<double>(ours.wrong) / static_cast<double>(sphere.crossings()), 800, 150);
  EXPECT_LT(4 * ours.by_projection, ours.wrong);
  EXPECT_EQ(floats.wrong, floats.by_projection);
  EXPECT_LT(20 * floats.wrong, ours.wrong);
  EXPECT_EQ(score("matrix_double", sphere).wrong, 0u);
  for (const ProjectionMethod& method : projection_methods())
    if (method.info.exact) {
      EXPECT_EQ(sphere.score(method).by_projection, 0u) << method.info.name;
    }
}

// Triangles behind the camera and across all planes.
TEST(Projection, ClippingAddsNothing) {
  for (const std::uint64_t seed : {2u, 4u, 6u}) {
    const ProjectionJudge judge(around_the_camera(seed, false), kSize, 1);
    EXPECT_GT(judge.covered(), 400u);
    EXPECT_EQ(score("matrix_double", judge).wrong, 0u);
    EXPECT_EQ(score("exact_15", judge).wrong, 0u);
  }
}

}  // namespace
}  // namespace edgewise::lab
