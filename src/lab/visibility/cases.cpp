// Small scenes on which visibility methods fail, and the scenes of the visibility sweeps.
#include "lab/visibility/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <initializer_list>
#include <numeric>

#include "core/grid.h"
#include "core/trigonometry.h"
#include "edgewise/contract.h"
#include "frontend/fixed.h"

namespace edgewise::lab {

namespace {

// As in the front end, which has the distance as a float.
std::uint32_t front_end_depth(double view_z, double near_z, double far_z) {
  return ViewDepth(near_z, far_z).units(static_cast<float>(view_z));
}

// View space: x to the right, y down, z away from the camera. The image's height is 1 at distance 1.
class Builder {
 public:
  Builder(Size size, double near_z, double far_z) : scene_{size.width, size.height, near_z, far_z, {}, {}} {}

  // At least three corners.
  Builder& polygon(std::initializer_list<glm::dvec3> corners) {
    const auto* const v = corners.begin();
    const auto pieces = static_cast<std::uint32_t>(corners.size() - 2);
    scene_.faces.push_back({static_cast<std::uint32_t>(scene_.triangles.size()), pieces});
    for (std::uint32_t i = 0; i < pieces; ++i) add({v[0], v[i + 1], v[i + 2]});
    return *this;
  }
  Builder& triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) { return polygon({a, b, c}); }
  Builder& quad(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) { return polygon({a, b, c, d}); }
  VisibilityScene take() { return std::move(scene_); }

 private:
  void add(const glm::dvec3 (&corners)[3]) {
    VisibilityTriangle t{};
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 p = corners[i];
      t.x_px[i] = static_cast<float>(scene_.width / 2.0 + scene_.height * p.x / p.z);
      t.y_px[i] = static_cast<float>(scene_.height / 2.0 + scene_.height * p.y / p.z);
      t.screen.x_q15[i] = snap(t.x_px[i]);
      t.screen.y_q15[i] = snap(t.y_px[i]);
      t.screen.z[i] = front_end_depth(p.z, scene_.near_z, scene_.far_z);
      t.view_z[i] = p.z;
    }
    t.screen.payload = static_cast<std::uint32_t>(scene_.triangles.size());
    scene_.triangles.push_back(t);
  }

  VisibilityScene scene_;
};

constexpr Size kSize{128, 96};

VisibilityScene floor_under_box() {
  return Builder(kSize, 0.5, 200)
      .quad({-40, 20, 1}, {40, 20, 1}, {40, 20, 100}, {-40, 20, 100})
      .quad({18, 0, 60}, {38, 0, 60}, {38, 20, 60}, {18, 20, 60})
      .take();
}

// A floor with five corners and mean distance 46, under a wall at 50. Sorted by triangles instead of
// polygons, the floor's far part would be painted first.
VisibilityScene pentagon_under_wall() {
  return Builder(kSize, 0.5, 200)
      .polygon({{0, 8, 10}, {-20, 8, 30}, {-30, 8, 80}, {30, 8, 80}, {20, 8, 30}})
      .quad({-12, -6, 50}, {12, -6, 50}, {12, 8, 50}, {-12, 8, 50})
      .take();
}

// A quad that is not planar: three corners lie in front of a second quad, the fourth far behind it.
VisibilityScene bent_quad() {
  return Builder(kSize, 0.5, 200)
      .quad({-8, -6, 20}, {8, -6, 20}, {24, 18, 60}, {-8, 6, 20})
      .quad({-6, -5, 28}, {6, -5, 28}, {6, 5, 28}, {-6, 5, 28})
      .take();
}

// Each bar begins near the camera and occludes the end of the previous one.
VisibilityScene bars_in_a_cycle() {
  Builder builder(kSize, 0.5, 10);
  const auto at = [](double degrees, double radius, double z) {
    const double angle = degrees * 0.017453292519943295;
    return glm::dvec3(radius * cosine(angle) * z, radius * sine(angle) * z, z);
  };
  for (const double turn : {0.0, 120.0, 240.0})
    builder.triangle(at(turn - 25, 0.42, 2), at(turn - 10, 0.46, 2), at(turn + 125, 0.48, 4));
  return builder.take();
}

VisibilityScene interpenetrating() {
  return Builder(kSize, 0.5, 10)
      .triangle({-0.8, -0.7, 2}, {1.6, 0, 4}, {-0.8, 0.7, 2})
      .triangle({0.8, -0.7, 2}, {-1.6, 0, 4}, {0.8, 0.7, 2})
      .take();
}

VisibilityScene back_to_front() {
  Builder builder(kSize, 0.5, 100);
  for (const double z : {64.0, 32.0, 16.0, 8.0})
    builder.triangle({-0.4 * z, -0.3 * z, z * 1.2}, {0.1 * z, 0.35 * z, z}, {0.3 * z, -0.2 * z, z * 1.1});
  return builder.take();
}

VisibilityScene front_to_back() {
  VisibilityScene scene = back_to_front();  // every face is one triangle, so faces need no change
  std::reverse(scene.triangles.begin(), scene.triangles.end());
  return scene;
}

constexpr std::array kCases = {
    // Disjoint in depth, submitted back to front: all methods are right.
    VisibilityCase{"back_to_front", back_to_front},
    VisibilityCase{"front_to_back", front_to_back},
    VisibilityCase{"floor_under_box", floor_under_box},
    VisibilityCase{"pentagon_under_wall", pentagon_under_wall},
    VisibilityCase{"bent_quad", bent_quad},
    VisibilityCase{"bars_in_a_cycle", bars_in_a_cycle},
    VisibilityCase{"interpenetrating", interpenetrating},
    VisibilityCase{"planes_1_apart", [] { return two_planes(100, 1, 0.1, 1000); }},
    VisibilityCase{"planes_3e-3_apart", [] { return two_planes(100, 3e-3, 0.1, 1000); }},
    VisibilityCase{"planes_1e-5_apart", [] { return two_planes(100, 1e-5, 0.1, 1000); }},
    VisibilityCase{"slivers", [] { return slivers(20000); }},
};

}  // namespace

std::span<const VisibilityCase> visibility_cases() {
  return kCases;
}

VisibilityScene two_planes(double distance, double separation, double near_z, double far_z, double tilt) {
  Builder builder(kSize, near_z, far_z);
  const auto quad = [&](double nearer, double top, double bottom) {
    const double left = (1 - tilt) * distance - nearer, right = (1 + tilt) * distance - nearer;
    const auto at = [](double x, double y, double z) { return glm::dvec3(x * z, y * z, z); };
    builder.quad(at(-0.6, top, left), at(0.6, top, right), at(0.6, bottom, right), at(-0.6, bottom, left));
  };
  for (const double nearer : {0.0, separation}) quad(nearer, -0.45, 0);
  for (const double nearer : {separation, 0.0}) quad(nearer, 0, 0.45);
  return builder.take();
}

VisibilityScene slivers(double aspect, double nearest, double farthest) {
  using namespace contract;
  constexpr int kSide = 1024, kReach = 500;  // px
  const double near_z = 0.5, far_z = 100;
  VisibilityScene scene{kSide, kSide, near_z, far_z, {}, {}};
  for (int dx = -4; dx <= 4; ++dx)
    for (int dy = 1; dy <= 4; ++dy) {
      if (std::gcd(dx, dy) != 1) continue;
      // The left edge runs through samples, so that slivers of any width cover some.
      const int steps = kReach / std::max(std::abs(dx), dy);
      const double width_sub = std::sqrt(dx * dx + dy * dy) * steps * Coarse::kSub / aspect;
      const std::int32_t x = sample_q15(kSide / 2 + steps * dx), y = sample_q15(kSide / 2 + steps * dy);
      const auto third =
          x + (std::max(1, static_cast<std::int32_t>(std::min(width_sub, Coarse::kGuardSub / 2.0)))
               << Coarse::kSpareBits);
      VisibilityTriangle t{{{sample_q15(kSide / 2), x, third}, {sample_q15(kSide / 2), y, y}, {}, 0},
                           {},
                           {},
                           {nearest, nearest, farthest}};
      for (int i = 0; i < 3; ++i) {
        t.screen.z[i] = front_end_depth(t.view_z[i], near_z, far_z);
        t.x_px[i] = static_cast<float>(t.screen.x_q15[i]) / kPixel_q15;
        t.y_px[i] = static_cast<float>(t.screen.y_q15[i]) / kPixel_q15;
      }
      scene.faces.push_back({static_cast<std::uint32_t>(scene.triangles.size()), 1});
      scene.triangles.push_back(t);
    }
  return scene;
}

}  // namespace edgewise::lab
