// What a frame shows, against naive counts, and queries of boxes, against drawing what lies in them.
#include "edgewise/visible.h"
#include "edgewise/builtin.h"
#include "edgewise/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lab/cases/random_cases.h"
#include "message_of.h"
#include "support.h"

namespace edgewise {
namespace {

Framebuffer ids_of(const Drawable& drawable, int width, int height, Cull cull = Cull::none, int bits = 8) {
  Framebuffer frame(width, height);
  Frontend frontend;
  draw(drawable, frontend,
       {.width = width, .height = height, .cull = cull, .payload = Payload::id, .subpixel_bits = bits},
       *find_backend("naive").make(), frame.view());  // a background that is an id too
  return frame;
}

std::size_t triangles_of(const Drawable& drawable) {
  if (const auto* scene = std::get_if<Scene>(&drawable)) return first_ids(*scene).back();
  return std::get<TriangleStream>(drawable).triangles.size();
}

TEST(Visible, TrianglesAndPixelsEqualANaiveCount) {
  for (const auto& family : randomized::scene_families())
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
      Random random(trial);
      const Drawable drawable = family.make(random, 90, 60);
      const Framebuffer frame = ids_of(drawable, 90, 60);
      std::vector<std::uint32_t> counts(triangles_of(drawable)), seen;
      for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x)
          if (frame.depth_row(y)[x] != contract::kDepthClear) ++counts.at(frame.payload_row(y)[x]);
      for (std::uint32_t id = 0; id < counts.size(); ++id)
        if (counts[id] != 0) seen.push_back(id);
      ASSERT_EQ(visible_triangles(frame), seen) << family.name << trial;
      ASSERT_EQ(pixels_per_triangle(frame, counts.size()), counts) << family.name << trial;
      const auto* const scene = std::get_if<Scene>(&drawable);
      if (scene == nullptr) continue;
      std::vector<std::uint32_t> by_instance, by_mesh(scene->meshes.size());
      auto next = counts.begin();
      for (const Instance& instance : scene->instances) {
        const auto end = next + static_cast<std::ptrdiff_t>(scene->meshes[instance.mesh].triangles.size());
        by_instance.push_back(std::accumulate(next, end, 0u));
        by_mesh[instance.mesh] += by_instance.back();
        next = end;
      }
      ASSERT_EQ(pixels_per_instance(frame, *scene), by_instance) << family.name << trial;
      ASSERT_EQ(pixels_per_mesh(frame, *scene), by_mesh) << family.name << trial;
    }
}

// A square of two triangles at z = -3, 2 wide, which faces the camera at the origin.
Mesh square() {
  return {{{-1, -1, -3}, {-1, 1, -3}, {1, 1, -3}, {1, -1, -3}}, {{0, 1, 2}, {0, 2, 3}}, {0, 0}};
}

TEST(Visible, ObjectsHaveTheIdsOfTheirPartsInAllInstances) {
  Scene scene;
  scene.meshes = {square(), Mesh{}, square()};
  scene.meshes[0].parts = {{"whole", 0, 2}, {"none", 2, 0}, {"half", 1, 1}, {"half", 0, 1}, {"half", 0, 2}};
  scene.meshes[2].parts = {{"half", 1, 1}};
  scene.instances = {{.mesh = 0}, {.mesh = 1}, {.mesh = 2}, {.mesh = 0}};
  using Objects = std::map<std::string, std::vector<std::uint32_t>>;
  EXPECT_EQ(objects(scene), (Objects{{"whole", {0, 1, 4, 5}}, {"none", {}}, {"half", {0, 1, 3, 4, 5}}}));
  scene.meshes[2].parts.push_back({"beyond", 1, 2});
  EXPECT_EQ(message_of([&] { objects(scene); }), "a part of 2 triangles from 1 on does not fit a mesh of 2");
  scene.instances[2].mesh = 3;
  EXPECT_EQ(message_of([&] { objects(scene); }), "an instance names mesh 3 of 3");
  EXPECT_EQ(message_of([&] { pixels_per_mesh(Framebuffer(8, 8), scene); }), "an instance names mesh 3 of 3");
}

TEST(Visible, HoldsTheHighestId) {
  std::vector<std::uint32_t> depth{5, contract::kDepthClear, 5, 5}, id{kMaxTriangles - 1, 9, 63, 64};
  const ConstFrameView frame{depth.data(), id.data(), 2, 2, 2};
  EXPECT_EQ(visible_triangles(frame), (std::vector<std::uint32_t>{63, 64, kMaxTriangles - 1}));
  id[0] = kMaxTriangles;
  EXPECT_THROW(visible_triangles(frame), std::invalid_argument);
}

TEST(Visible, RejectsFramesThatCannotBeRead) {
  const Framebuffer frame = ids_of(TriangleStream{4, 4, {}}, 4, 4);
  ConstFrameView narrow = frame, depth_only = frame;
  narrow.stride = 3, depth_only.payload = nullptr;
  EXPECT_EQ(message_of([&] { visible_triangles(narrow); }), "frame of 4 x 4 px, stride 3, cannot be read");
  EXPECT_EQ(message_of([&] { pixels_per_instance(depth_only, {}); }), "the frame has no payload");
}

// Behind, in and before a wall at z = -3 that covers the middle of the view of a camera at the origin; and
// out of view, or where a box cannot be projected.
TEST(Visible, BoxIsHiddenByAWallOnlyIfItIsBehindAndProjected) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Scene scene;
  scene.meshes.push_back(square());
  scene.instances.emplace_back();
  const Framebuffer frame = ids_of(scene, 200, 200);
  for (const auto& [box, seen] : std::vector<std::pair<Bounds, bool>>{
           {{{-0.5, -0.5, -5}, {0.5, 0.5, -3.1}}, false},
           {{{-0.9, -0.9, -3.01}, {0.9, 0.9, -3.001}}, false},
           {{{-20, -20, -99}, {20, 20, -61}}, false},
           {{{0.1, 0.1, -4}, {0.1, 0.1, -4}}, false},
           {{{-0.5, -0.5, -5}, {0.5, 0.5, -2.9}}, true},
           {{{0.5, 0.5, -5}, {1.9, 0.9, -4}}, true},
           {{{5, -1, -5}, {7, 1, -4}}, false},       // to the right
           {{{-1, -1, 4}, {1, 1, 9}}, false},        // behind the camera
           {{{84, 1, -210}, {90, 2, -200}}, false},  // beyond the far plane
           {bounds_of(Scene{}), false},
           {{{-1, -1, -9}, {1, 1, 9}}, true},              // around the camera
           {{{-0.1, -0.1, -4}, {0.1, 0.1, -0.05}}, true},  // cut by the near plane
           {{{-0.1, -0.1, -kInfinity}, {0.1, 0.1, -4}}, true},
           {{{-0.1, kNan, -5}, {0.1, 0.1, -4}}, true},
           {{{-1e200, -1e200, -1e300}, {1e200, 1e200, -4}}, true}})
    EXPECT_EQ(visible(box, scene, frame), seen) << box.low.x << ' ' << box.low.z;
  const Bounds before{{0, 0, -2}, {0.1, 0.1, -1}};
  EXPECT_THROW(visible(before, scene, {nullptr, nullptr, 200, 200, 200}), std::invalid_argument);
  scene.camera.near_z = 0;
  EXPECT_THROW(visible(before, scene, frame), std::invalid_argument);
}

// A frame that hides the box in all pixels but one, where what lies in the box barely wins. It does so at
// each end of the pixels that it has, and where it is nearest.
void expect_seen(const Scene& scene, const Bounds& box, int width, int height, int bits,
                 const std::string& what, int& seen) {
  const Framebuffer alone = ids_of(scene, width, height, Cull::none, bits);
  Framebuffer frame(width, height);
  for (int y = 0; y < height; ++y) std::fill_n(frame.view().depth + y * frame.stride(), width, 0u);
  std::map<std::string, std::pair<std::int64_t, glm::ivec2>>
      ends;  // value and pixel; the lowest value counts
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint32_t depth = alone.depth_row(y)[x];
      if (depth == contract::kDepthClear) continue;
      for (const auto& [end, value] : std::map<std::string, std::int64_t>{
               {"left", x}, {"right", -x}, {"top", y}, {"bottom", -y}, {"nearest", depth}})
        if (const auto at = ends.find(end); at == ends.end() || value < at->second.first)
          ends[end] = {value, {x, y}};
    }
  for (const auto& [end, found] : ends) {
    const glm::ivec2 pixel = found.second;
    std::uint32_t& depth = frame.view().depth[pixel.y * frame.stride() + pixel.x];
    depth = alone.depth_row(pixel.y)[pixel.x] + 1;
    ASSERT_TRUE(visible(box, scene, frame)) << what << ", " << end;
    depth = 0;
  }
  seen += !ends.empty();
}

TEST(Visible, BoxIsSeenWhereverWhatLiesInItWinsAPixel) {
  for (const auto& family : randomized::scene_families()) {
    int seen = 0, hidden = 0;
    for (std::uint64_t trial = 0; trial < (testing::full_size() ? 20'000u : 1000u); ++trial) {
      Random random(trial);
      const int width = testing::between(random, 1, 70), height = testing::between(random, 1, 70);
      const Drawable drawable = family.make(random, width, height);
      if (!std::holds_alternative<Scene>(drawable)) continue;
      // One triangle of one instance, or all of them.
      Scene scene = std::get<Scene>(drawable);
      if (trial % 3 == 0) scene.matrices = randomized::random_matrices(random, scene.camera, width, height);
      scene.instances = {scene.instances[random.below(scene.instances.size())]};
      Mesh& mesh = scene.meshes[scene.instances[0].mesh];
      if (random.below(2) == 0) mesh.triangles.resize(1), mesh.colours.resize(1);
      const Bounds box = bounds_of(scene);
      const std::string what = std::string(family.name) + " " + std::to_string(trial);
      const int bits = kMinSubpixelBits + static_cast<int>(trial % 12);
      expect_seen(scene, box, width, height, bits, what, seen);
      if (HasFatalFailure()) return;
      Framebuffer nearest(width, height);
      for (int y = 0; y < height; ++y) std::fill_n(nearest.view().depth + y * nearest.stride(), width, 0u);
      hidden += !visible(box, scene, nearest);
    }
    if (family.name == "stream") continue;
    EXPECT_GT(seen, 100) << family.name;
    EXPECT_GT(hidden, 100) << family.name;
  }
}

// Boxes that face the camera, also far from the origin, and by matrices of both kinds: whole columns and rows
// of pixels depend on the last bits of a position, and all pixels of the front have the nearest depth.
TEST(Visible, FacingBoxIsSeenInEachColumnAndAtItsDepth) {
  Random random(48);
  int seen = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const auto vector = [&](float low, float high) {
      const float x = random.uniform(low, high), y = random.uniform(low, high);
      return glm::dvec3(x, y, random.uniform(low, high));
    };
    Camera camera;
    camera.near_z = std::ldexp(1.0f, -static_cast<int>(random.below(15))), camera.far_z = 5.0f;
    camera.position = vector(-999, 999) * (trial % 3 == 0 ? 1e9 : 1.0);
    if (trial % 2 == 0)
      camera.yaw = random.uniform(-0.001f, 0.001f);  // depth errs most where it hardly changes
    const glm::dvec3 low = camera.position + vector(-0.5f, 0.0f) + glm::dvec3(0, 0, -3),
                     high = camera.position + vector(0.0f, 0.5f) + glm::dvec3(0, 0, -1.6);
    Scene scene = std::get<Scene>(find_scene("cube").make({}));
    scene.camera = camera;
    scene.instances[0] = {.scale = 0.5 * (high - low), .translation = 0.5 * (low + high)};
    if (const CameraMatrices m = matrices_of(camera, 40 / 30.0); trial % 5 == 1)
      scene.matrices = m;
    else if (trial % 5 == 2 && trial % 3 != 0)  // a product far from the origin has no inverse in double
      scene.matrices = {glm::dmat4(1.0), m.projection * m.view};
    else if (trial % 5 == 3)
      scene.matrices = {m.view, orthographic_projection(-2, 2, -1.5, 1.5, 0.5, 5.0)};
    expect_seen(scene, bounds_of(scene), 40, 30, kMinSubpixelBits + trial % 12, std::to_string(trial), seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen, 4900);
}

}  // namespace
}  // namespace edgewise
