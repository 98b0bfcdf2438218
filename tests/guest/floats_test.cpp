// Pictures, numbers and the caller's floating-point state do not depend on the state that functions are
// called in.
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>

#include "edgewise/barycentrics.h"
#include "edgewise/builtin.h"
#include "edgewise/draw.h"
#include "edgewise/edgewise.h"
#include "edgewise/hash.h"
#include "edgewise/visible.h"
#include "float_modes.h"

namespace edgewise {
namespace {

using Bits = std::vector<std::uint64_t>;
constexpr int kWidth = 160, kHeight = 120;

// Of a value, or of the elements of a range.
template <typename T>
std::uint64_t bits(const T& value) {
  const auto bytes = [&] {
    if constexpr (std::ranges::range<T>)
      return std::as_bytes(std::span(value));
    else
      return std::as_bytes(std::span(&value, 1));
  }();
  std::vector<std::uint64_t> words((bytes.size() + 7) / 8);
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
  return hash_of_all(words);
}

// Triangles of which some are not finite, reach beyond the guard band or have denormal sides.
Scene hard_scene() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  mesh.positions = {{-0.7f, -0.61f, 0.1f}, {0.83f, -0.37f, -0.3f}, {0.11f, 0.93f, 0.27f},
                    {kNan, 0, 0},          {kInf, 1, 0},           {3e38f, -2e38f, 1},
                    {-1e7f, 3, 0.1f},      {0.3f, 0.2f, 40},       {1e-40f, 3e-40f, 2e-39f},
                    {7e-39f, 0, 0},        {0, 9e-39f, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 4, 2},  {2, 5, 0}, {0, 6, 2},
                    {7, 1, 2}, {0, 7, 6}, {8, 9, 10}, {8, 1, 2}};
  mesh.colours = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  mesh.flags.assign(9, kTwoSided);
  scene.instances = {{.mesh = 0, .angle = 0.3f}, {.mesh = 0, .translation = {0.1, 0.2, -0.7}}};
  scene.camera.position = {0.2, 0.3, 3.1};
  return scene;
}

TriangleStream hard_stream() {
  TriangleStream stream = random_stream({kWidth, kHeight, 0.0f, 1.0}, 200, 90.0, 0.0, 5);
  stream.triangles[3].vertex[1].x = std::numeric_limits<float>::quiet_NaN();
  stream.triangles[5].vertex[0].y = 1e30f;
  stream.triangles[7].vertex[2].z = 1e-42f;
  stream.triangles[9].vertex[2].x = -std::numeric_limits<float>::infinity();
  return stream;
}

Bits pictures_of(const Drawable& drawable, int threads) {
  Bits found;
  Framebuffer frame(kWidth, kHeight);
  Frontend frontend;
  for (const SimdTarget target : supported_targets())
    for (const BackendInfo& info : backends()) {
      const FrontendOptions options{
          .width = kWidth, .height = kHeight, .cull = Cull::none, .payload = Payload::id};
      const auto backend = info.make();
      const Execution execution{.threads = threads, .target = target};
      draw(drawable, frontend, options, *backend, frame.view(), {0}, execution);
      found.push_back(hash_of(frame));
      FrontendOptions lit = options;
      lit.payload = Payload::colour, lit.keep_unsnapped = true;
      backend->draw(frontend.run(drawable, lit, execution), frame.view(), {0}, execution);
      found.push_back(hash_of(frame));
      found.push_back(bits(frontend.unsnapped()));
      draw(drawable, frontend, options, *backend, frame.view(), {0}, execution);
      std::vector<float> uv(2 * kWidth * kHeight), distance(kWidth * kHeight);
      barycentrics(frame, drawable, options, {uv.data(), 2 * kWidth, distance.data(), kWidth}, execution);
      found.push_back(bits(uv)), found.push_back(bits(distance));
    }
  if (const auto* const scene = std::get_if<Scene>(&drawable))
    for (const double low : {-0.9, -0.1, 0.3})
      found.push_back(visible({{low, low, low}, {0.4, 0.5, 0.6}}, *scene, frame));
  return found;
}

TEST(FloatMode, ChangesNoPictureAndIsKept) {
  const Scene scene = hard_scene();
  const TriangleStream stream = hard_stream();
  // Other counts, so that oneTBB's threads may begin in the caller's state.
  testing::expect_same_in_every_float_mode([&](int i) {
    Bits found = pictures_of(scene, 1 + i);
    for (const std::uint64_t word : pictures_of(stream, 1 + i)) found.push_back(word);
    return found;
  });
}

TEST(FloatMode, ChangesNoSceneAndNoCamera) {
  testing::expect_same_in_every_float_mode([](int) {
    Bits found;
    for (const SceneInfo& info : builtin_scenes()) {
      const Drawable made = info.make({kWidth, kHeight, 0.7f, 0.01});
      if (const auto* const stream = std::get_if<TriangleStream>(&made)) {
        found.push_back(bits(stream->triangles));
        continue;
      }
      Scene scene = std::get<Scene>(made);
      for (const Mesh& mesh : scene.meshes) {
        found.push_back(bits(mesh.positions)), found.push_back(bits(mesh.colours));
        found.push_back(bits(clusters_of(mesh)));
        for (const std::size_t triangle : {0u, 5u}) found.push_back(bits(mesh.normal_of(triangle)));
      }
      found.push_back(bits(matrices_of(scene.camera, 1.3)));
      found.push_back(bits(bounds_of(scene)));
      frame_camera(scene, 1.7);
      fit(scene);
      found.push_back(bits(matrices_of(scene.camera, 1.7)));
      for (const Instance& instance : scene.instances)
        found.push_back(bits(model_matrix(scene.meshes[instance.mesh], instance)));
    }
    Mesh quad{
        .positions = {{0.1f, 0, 0}, {1, 0.3f, 0}, {1, 1, 0.7f}, {0, 1, 0}}, .triangles = {}, .colours = {}};
    quad.add_quad({0, 1, 2, 3}, 0);
    found.push_back(bits(quad.normals));
    Camera camera;
    camera.look_at({0.1, 0.2, -0.3});
    found.push_back(bits(matrices_of(camera, 1.7)));
    const glm::dmat4 matrices[] = {
        perspective_projection(0.7, 1.3, 0.1, 10), orthographic_projection(-0.3, 0.7, -0.1, 1, 0.3, 7),
        intrinsics_projection({510, 0, 0, 0, 507, 0, 31.7, 23.9, 1}, 63, 49, 0.5, 0.1, 9),
        projection_from({true, true, true}, perspective_projection(0.3, 1.1, 0.3, 7))};
    found.push_back(bits(matrices));
    try {
      (void)perspective_projection(4.0, 1.0, 0.1, 10.0);
    } catch (const std::invalid_argument& error) {
      found.push_back(bits(std::string(error.what())));
    }
    return found;
  });
}

TEST(FloatMode, IsKeptByTheCInterface) {
  const edgewise_stream_triangle triangle{
      {{10.1f, 11.3f, 0.1f}, {90.7f, 20.9f, 0.33f}, {40.3f, 99.1f, 0.77f}}, 7};
  testing::expect_same_in_every_float_mode([&](int) {
    edgewise_scene* stream = nullptr;
    edgewise_renderer* renderer = nullptr;
    edgewise_new_stream(&triangle, 1, &stream), edgewise_new_renderer(nullptr, &renderer);
    Framebuffer memory(kWidth, kHeight);
    const edgewise_frame frame{memory.view().depth, memory.view().payload, kWidth, kHeight, memory.stride()};
    const edgewise_status drawn = edgewise_draw(renderer, stream, nullptr, frame);
    std::uint64_t hash = 0;
    edgewise_hash(frame, &hash);
    double projection[16]{};
    edgewise_perspective(0.7, 1.3, 0.1, 10, projection);
    edgewise_free_renderer(renderer), edgewise_free_scene(stream);
    return Bits{drawn, hash, bits(projection), bits(edgewise_depth01(123456789))};
  });
}

}  // namespace
}  // namespace edgewise
