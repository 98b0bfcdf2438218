// What a frame shows, against naive counts, and queries of boxes, against drawing what lies in them.
#include "edgewise/visible.h"
#include "edgewise/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
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

std::map<std::uint32_t, std::uint32_t> naive_counts(const Framebuffer& frame) {
  std::map<std::uint32_t, std::uint32_t> counts;
  for (int y = 0; y < frame.height(); ++y)
    for (int x = 0; x < frame.width(); ++x)
      if (frame.depth_row(y)[x] != contract::kDepthClear) ++counts[frame.payload_row(y)[x]];
  return counts;
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
      const auto expected = naive_counts(frame);
      const auto visible = visible_triangles(frame);
      const auto counts = pixels_per_triangle(frame, triangles_of(drawable));
      ASSERT_EQ(visible.size(), expected.size()) << family.name << trial;
      ASSERT_EQ(counts.size(), triangles_of(drawable));
      auto next = visible.begin();
      std::uint32_t total = 0;
      for (const auto& [id, pixels] : expected) {
        ASSERT_EQ(*next++, id) << family.name << trial;
        ASSERT_EQ(counts[id], pixels) << family.name << trial;
        total += pixels;
      }
      ASSERT_EQ(std::accumulate(counts.begin(), counts.end(), 0u), total);
      if (const auto* scene = std::get_if<Scene>(&drawable)) {
        const auto by_instance = pixels_per_instance(frame, *scene), by_mesh = pixels_per_mesh(frame, *scene);
        ASSERT_EQ(std::accumulate(by_instance.begin(), by_instance.end(), 0u), total);
        ASSERT_EQ(std::accumulate(by_mesh.begin(), by_mesh.end(), 0u), total);
      }
    }
}

// A square of two triangles at z = -3, 2 wide, which faces the camera at the origin.
Mesh square() {
  return {{{-1, -1, -3}, {-1, 1, -3}, {1, 1, -3}, {1, -1, -3}}, {{0, 1, 2}, {0, 2, 3}}, {0, 0}};
}

TEST(Visible, InstancesAndMeshesHaveTheirTrianglesPixels) {
  Scene scene;
  scene.meshes = {square(), Mesh{}, square()};
  scene.meshes[2].triangles.push_back({0, 0, 0});
  scene.meshes[2].colours.push_back(0);
  scene.instances = {{.mesh = 2, .translation = {-1, 0, 0}},
                     {.mesh = 1},
                     {.mesh = 0, .translation = {1, 1, 0}},
                     {.mesh = 2, .translation = {0, -1, -20}}};
  EXPECT_EQ(first_ids(scene), (std::vector<std::size_t>{0, 3, 3, 5, 8}));
  const Framebuffer frame = ids_of(scene, 80, 80);
  const auto triangles = pixels_per_triangle(frame, 8);
  const auto instances = pixels_per_instance(frame, scene), meshes = pixels_per_mesh(frame, scene);
  EXPECT_EQ(instances,
            (std::vector<std::uint32_t>{triangles[0] + triangles[1], 0, triangles[3] + triangles[4],
                                        triangles[5] + triangles[6]}));
  EXPECT_EQ(meshes, (std::vector<std::uint32_t>{instances[2], 0, instances[0] + instances[3]}));
  for (const std::size_t i : {0u, 2u, 3u}) EXPECT_GT(instances[i], 0u) << i;
  EXPECT_EQ(visible_triangles(frame), (std::vector<std::uint32_t>{0, 1, 3, 4, 5, 6}));

  EXPECT_EQ(message_of([&] { pixels_per_triangle(frame, 6); }), "a pixel has id 6 of 6 triangles");
  scene.instances.pop_back();
  EXPECT_NE(message_of([&] { pixels_per_instance(frame, scene); }), "");
  scene.instances[1].mesh = 3;
  EXPECT_EQ(message_of([&] { pixels_per_mesh(frame, scene); }), "an instance names mesh 3 of 3");
  EXPECT_EQ(message_of([&] { first_ids(scene); }), "an instance names mesh 3 of 3");
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
  const auto message = [&](auto&& change) {
    ConstFrameView view = frame;
    change(view);
    const std::string text = message_of([&] { visible_triangles(view); });
    EXPECT_EQ(message_of([&] { pixels_per_triangle(view, 9); }), text);
    EXPECT_EQ(message_of([&] { pixels_per_instance(view, {}); }), text);
    return text;
  };
  EXPECT_EQ(message([](ConstFrameView&) {}), "");
  EXPECT_EQ(message([](ConstFrameView& v) { v.depth = nullptr; }),
            "frame of 4 x 4 px, stride 16, cannot be read");
  EXPECT_EQ(message([](ConstFrameView& v) { v.payload = nullptr; }), "the frame has no payload");
  EXPECT_EQ(message([](ConstFrameView& v) { v.stride = 3; }), "frame of 4 x 4 px, stride 3, cannot be read");
  EXPECT_EQ(message([](ConstFrameView& v) { v.width = 0; }), "frame of 0 x 4 px, stride 16, cannot be read");
  EXPECT_EQ(message([](ConstFrameView& v) { v.height = 16385; }),
            "frame of 4 x 16385 px, stride 16, cannot be read");
}

// A wall at z = -3 that covers the middle of the view of a camera at the origin.
class VisibleBox : public ::testing::Test {
 protected:
  VisibleBox() {
    scene_.meshes.push_back(square());
    scene_.instances.emplace_back();
    frame_ = ids_of(scene_, 200, 200);
  }
  bool sees(glm::dvec3 low, glm::dvec3 high) const { return visible({low, high}, scene_, frame_); }

  Scene scene_;
  Framebuffer frame_{1, 1};
};

TEST_F(VisibleBox, IsHiddenBehindAWall) {
  EXPECT_FALSE(sees({-0.5, -0.5, -5}, {0.5, 0.5, -3.1}));
  EXPECT_FALSE(sees({-0.9, -0.9, -3.01}, {0.9, 0.9, -3.001}));
  EXPECT_FALSE(sees({-20, -20, -99}, {20, 20, -61})) << "the wall hides up to 20 at z = -60";
  EXPECT_FALSE(sees({0.1, 0.1, -4}, {0.1, 0.1, -4})) << "a point";
}

TEST_F(VisibleBox, IsSeenBeforeAWallAndBesideIt) {
  EXPECT_TRUE(sees({-0.5, -0.5, -2.9}, {0.5, 0.5, -2.5}));
  EXPECT_TRUE(sees({-0.5, -0.5, -5}, {0.5, 0.5, -2.9})) << "in the wall";
  EXPECT_TRUE(sees({0.5, 0.5, -5}, {1.9, 0.9, -4})) << "half of it";
  EXPECT_TRUE(sees({1.1, -0.1, -3.2}, {1.2, 0.1, -3.1})) << "on the background";
}

TEST_F(VisibleBox, IsNotSeenOutOfView) {
  EXPECT_FALSE(sees({5, -1, -5}, {7, 1, -4})) << "to the right";
  EXPECT_FALSE(sees({-1, -1, 4}, {1, 1, 9})) << "behind the camera";
  EXPECT_FALSE(sees({84, 1, -210}, {90, 2, -200})) << "beyond the far plane";
  const auto [low, high] = bounds_of(Scene{});
  EXPECT_FALSE(sees(low, high)) << "no box";
}

TEST_F(VisibleBox, MayBeSeenWhereItCannotBeProjected) {
  EXPECT_TRUE(sees({-1, -1, -9}, {1, 1, 9})) << "around the camera";
  EXPECT_TRUE(sees({-0.1, -0.1, -4}, {0.1, 0.1, -0.05})) << "cut by the near plane";
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(sees({-0.1, -0.1, -kInfinity}, {0.1, 0.1, -4}));
  EXPECT_TRUE(sees({-0.1, kNan, -5}, {0.1, 0.1, -4}));
  EXPECT_TRUE(sees({-1e200, -1e200, -1e300}, {1e200, 1e200, -4}));
}

TEST_F(VisibleBox, RejectsBadArguments) {
  const Bounds box{{0, 0, -2}, {0.1, 0.1, -1}};
  const ConstFrameView no_ids{frame_.depth_row(0), nullptr, 200, 200, frame_.stride()};
  EXPECT_TRUE(visible(box, scene_, no_ids));
  EXPECT_EQ(message_of([&] {
              visible(box, scene_, {nullptr, nullptr, 200, 200, 200});
            }),
            "frame of 200 x 200 px, stride 200, cannot be read");
  scene_.camera.near_z = 0;
  EXPECT_EQ(message_of([&] { visible(box, scene_, frame_); }),
            "the camera needs 0 < near < far, not 0 and 100");
}

// The faces of a box.
Scene faces_of(const Bounds& box, const Camera& camera) {
  Scene scene;
  scene.camera = camera;
  Mesh& mesh = scene.meshes.emplace_back();
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  constexpr std::array<glm::uvec4, 6> kFaces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const glm::uvec4 face : kFaces) mesh.add_quad(face, 0);
  scene.instances.push_back({.scale = box.high - box.low, .translation = box.low});
  return scene;
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
      // Rule 10 needs a camera that is not too far from the faces' origin.
      if (const double size = glm::length(box.high - box.low); size < 0x1p12) {
        Scene faces = faces_of(box, scene.camera);
        faces.matrices = scene.matrices;
        expect_seen(faces, box, width, height, bits, what + ", faces", seen);
      }
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
    Scene scene = faces_of({low, high}, camera);
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
