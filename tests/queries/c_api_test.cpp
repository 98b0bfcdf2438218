// The C interface: each function does what its C++ counterpart does, and errors are told.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "edgewise/barycentrics.h"
#include "edgewise/contract.h"
#include "edgewise/draw.h"
#include "edgewise/edgewise.h"
#include "edgewise/hash.h"
#include "edgewise/visible.h"

namespace edgewise {
namespace {

constexpr int kWidth = 70, kHeight = 50, kStride = 77;
const glm::dmat4 kMatrix(1, 0.1, 0.2, 0, 0.3, 1.2, 0.1, 0, -0.2, 0.1, 0.9, 0, 0.4, -0.3, -0.5, 1);
const glm::dmat4 kView(1, 0, 0.1, 0, 0, 1, 0, 0, -0.1, 0, 1, 0, 0.1, 0.2, -3, 1);

struct Planes {
  std::vector<std::uint32_t> depth = std::vector<std::uint32_t>(kStride * kHeight, 7), payload = depth;
  edgewise_frame c() { return {depth.data(), payload.data(), kWidth, kHeight, kStride}; }
  FrameView view() { return {depth.data(), payload.data(), kWidth, kHeight, kStride}; }
  bool operator==(const Planes&) const = default;
};

// A scene of two instances of a mesh, both ways.
struct Both {
  Both() {
    // Vertices 20 bytes apart, triangles 16.
    const float positions[] = {-1, -1, 0, 9, 9, -1, 1, 0.2f, 9, 9, 1, 1, 0, 9, 9, 1, -1, -0.5f, 9, 9};
    const std::uint32_t triangles[] = {0, 1, 2, 99, 0, 2, 3, 99, 0, 3, 1, 99};
    const std::uint32_t colours[] = {0xFF112233, 0xFF445566, 0xFF778899};
    edgewise_mesh mesh{};
    mesh.positions = positions, mesh.vertex_count = 4, mesh.position_stride = 20;
    mesh.triangles = triangles, mesh.triangle_count = 3, mesh.triangle_stride = 16;
    mesh.colours = colours, mesh.two_sided = 1;
    EXPECT_EQ(edgewise_new_scene(&c), EDGEWISE_OK);
    std::size_t index = 9;
    EXPECT_EQ(edgewise_add_mesh(c, &mesh, &index), EDGEWISE_OK);
    EXPECT_EQ(index, 0u);
    EXPECT_EQ(edgewise_add_instance(c, 0, nullptr, &index), EDGEWISE_OK);
    EXPECT_EQ(edgewise_add_instance(c, 0, nullptr, &index), EDGEWISE_OK);
    EXPECT_EQ(index, 1u);
    EXPECT_EQ(edgewise_set_instance(c, 1, glm::value_ptr(kMatrix)), EDGEWISE_OK);
    const double light[] = {-0.5, 0.25, 1};
    EXPECT_EQ(edgewise_set_light(c, light), EDGEWISE_OK);
    scene.meshes.push_back({.positions = {{-1, -1, 0}, {-1, 1, 0.2f}, {1, 1, 0}, {1, -1, -0.5f}},
                            .triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}},
                            .colours = {colours, colours + 3},
                            .flags = {kTwoSided, kTwoSided, kTwoSided}});
    scene.instances = {Instance{}, Instance{.matrix = kMatrix}};
    scene.to_light = {-0.5f, 0.25f, 1};
    set_camera(kView, perspective_projection(1.1, 1.4, 0.3, 8));
  }
  ~Both() { edgewise_free_scene(c); }
  Both(const Both&) = delete;

  void set_camera(const glm::dmat4& view, const glm::dmat4& projection) {
    EXPECT_EQ(edgewise_set_camera(c, glm::value_ptr(view), glm::value_ptr(projection)), EDGEWISE_OK);
    scene.matrices = {view, projection};
  }

  edgewise_scene* c = nullptr;
  Scene scene;
};

struct Renderer {
  explicit Renderer(const char* backend) { EXPECT_EQ(edgewise_new_renderer(backend, &c), EDGEWISE_OK); }
  ~Renderer() { edgewise_free_renderer(c); }
  Renderer(const Renderer&) = delete;
  edgewise_renderer* c = nullptr;
};

// Draws a scene by both interfaces without culling, in colours. Returns the picture.
Planes expect_drawn(const edgewise_scene* c, const Drawable& drawable) {
  Planes actual, expected;
  EXPECT_EQ(edgewise_draw(Renderer(nullptr).c, c, nullptr, actual.c()), EDGEWISE_OK) << edgewise_error();
  Frontend frontend;
  draw(drawable, frontend, {.width = kWidth, .height = kHeight, .cull = Cull::none},
       *find_backend("naive").make(), expected.view(), {0xFF000000});
  EXPECT_EQ(actual, expected);
  return expected;
}

TEST(CInterface, ProjectsAsCameraHSays) {
  double made[16];
  const auto expect = [&](edgewise_status status, const glm::dmat4& expected) {
    EXPECT_EQ(status, EDGEWISE_OK);
    EXPECT_EQ(glm::make_mat4(made), expected);
  };
  const double position[] = {1, -2, 3};
  expect(edgewise_view(position, 0.5f, -0.2f, made),
         matrices_of({.position = {1, -2, 3}, .yaw = 0.5f, .pitch = -0.2f}, 1.0).view);
  expect(edgewise_perspective(1.1, 1.4, 0.3, 8, made), perspective_projection(1.1, 1.4, 0.3, 8));
  expect(edgewise_orthographic(-1, 2, -3, 4, 5, 6, made), orthographic_projection(-1, 2, -3, 4, 5, 6));
  const double k[] = {500, 3, 320, 0, 400, 200, 0, 0, 1};  // by rows
  expect(edgewise_intrinsics(k, 640, 480, 0.5, 0.1, 9, made),
         intrinsics_projection(glm::dmat3(500, 0, 0, 3, 400, 0, 320, 200, 1), 640, 480, 0.5, 0.1, 9));
  for (const int flags : {0, 1, 2, 4}) {
    const glm::dmat4 from = perspective_projection(1.1, 1.4, 0.3, 8);
    std::copy_n(glm::value_ptr(from), 16, made);
    expect(edgewise_convert_projection(flags & 1, flags & 2, flags & 4, made),
           projection_from({(flags & 1) != 0, (flags & 2) != 0, (flags & 4) != 0}, from));
  }
}

TEST(CInterface, DrawsTheSamePictures) {
  Both both;
  const Renderer renderers[] = {Renderer("scanline"), Renderer("tiles+spans")};
  for (int trial = 0; trial < 128; ++trial) {
    edgewise_options options = edgewise_default_options();
    options.cull = trial % 4;
    options.ids = trial & 4, options.unlit = trial & 8, options.keep = trial & 16;
    options.subpixel_bits = 4 + trial % 12, options.first_id = static_cast<std::uint32_t>(trial);
    options.threads = 1 + trial % 3, options.background = 0xFF000001u + static_cast<std::uint32_t>(trial);
    const int scissor[] = {5, 9, 40, 21};
    if ((trial & 32) != 0) std::copy_n(scissor, 4, options.scissor);
    constexpr Cull kCull[] = {Cull::none, Cull::back, Cull::front, Cull::both};
    FrontendOptions o{
        .width = kWidth, .height = kHeight, .cull = kCull[trial % 4], .shade = options.unlit == 0};
    o.payload = options.ids != 0 ? Payload::id : Payload::colour;
    o.subpixel_bits = options.subpixel_bits, o.first_id = options.first_id;
    RenderPass pass{options.background, options.keep == 0};
    if ((trial & 32) != 0) pass.scissor = {5, 9, 40, 21};
    Planes actual, expected;
    EXPECT_EQ(edgewise_draw(renderers[trial / 64].c, both.c, &options, actual.c()), EDGEWISE_OK)
        << edgewise_error();
    Frontend frontend;
    draw(both.scene, frontend, o, *find_backend("naive").make(), expected.view(), pass);
    EXPECT_EQ(actual, expected) << trial;
    std::uint64_t hash = 0;
    EXPECT_EQ(edgewise_hash(actual.c(), &hash), EDGEWISE_OK);
    EXPECT_EQ(hash, hash_of(ConstFrameView(expected.view())));
  }
}

TEST(CInterface, DrawsStreamsAndFramedScenes) {
  const edgewise_stream_triangle triangle{{{3, 4, 0.5f}, {60, 9, 0.25f}, {20, 45, 0.75f}}, 0xFF123456};
  edgewise_scene* stream = nullptr;
  ASSERT_EQ(edgewise_new_stream(&triangle, 1, &stream), EDGEWISE_OK);
  const Planes expected = expect_drawn(
      stream, TriangleStream{.triangles = {{{{3, 4, 0.5f}, {60, 9, 0.25f}, {20, 45, 0.75f}}, 0xFF123456}}});
  Planes actual;
  edgewise_frame depth_only = actual.c();
  depth_only.payload = nullptr;
  EXPECT_EQ(edgewise_draw(Renderer(nullptr).c, stream, nullptr, depth_only), EDGEWISE_OK);
  EXPECT_EQ(actual.depth, expected.depth);
  EXPECT_EQ(edgewise_set_camera(stream, glm::value_ptr(kView), glm::value_ptr(kView)),
            EDGEWISE_INVALID_ARGUMENT);
  edgewise_free_scene(stream);
  Both both;
  EXPECT_EQ(edgewise_frame_scene(both.c, 1.4), EDGEWISE_OK);
  frame_camera(both.scene, 1.4);
  expect_drawn(both.c, both.scene);
}

TEST(CInterface, KeepsPositionsInDouble) {
  const glm::dvec3 at(-2'487'002.881739342, -4'684'683.676570751, 3'529'638.9835389843);
  std::vector<glm::dvec4> points{
      {at, 9}, {at + glm::dvec3(0, 0.017, 0.004), 9}, {at + glm::dvec3(0.013, 0, 0), 9}};
  const std::uint32_t triangle[] = {0, 1, 2};
  edgewise_mesh mesh{};
  mesh.vertex_count = 3, mesh.position_stride = 32, mesh.triangles = triangle, mesh.triangle_count = 1;
  Both both;
  both.set_camera(glm::translate(glm::dmat4(1), -at - 0.03), perspective_projection(1.1, 1.4, 0.001, 8));
  EXPECT_EQ(edgewise_add_mesh_f64(both.c, &mesh, &points[0].x, nullptr), EDGEWISE_OK) << edgewise_error();
  EXPECT_EQ(edgewise_add_instance(both.c, 1, nullptr, nullptr), EDGEWISE_OK);
  both.scene.meshes.push_back({.positions = {}, .triangles = {{0, 1, 2}}, .colours = {rgb(200, 200, 200)}});
  both.scene.instances.push_back({.mesh = 1});
  Planes last;
  for (int trial = 0; trial < 2; ++trial) {
    both.scene.meshes[1].set_positions(std::vector<glm::dvec3>(points.begin(), points.end()));
    EXPECT_NE(std::exchange(last, expect_drawn(both.c, both.scene)), last) << "the triangle is seen";
    points[1] += glm::dvec4(0.01, 0.002, 0, 0);
    EXPECT_EQ(edgewise_set_positions_f64(both.c, 1, &points[0].x, 3, 32), EDGEWISE_OK) << edgewise_error();
  }
  const float floats[9] = {};
  mesh.positions = floats;
  EXPECT_EQ(edgewise_add_mesh_f64(both.c, &mesh, &points[0].x, nullptr), EDGEWISE_INVALID_ARGUMENT);
}

TEST(CInterface, CountsWhatItDraws) {
  Both both;
  std::vector<glm::vec3>& positions = both.scene.meshes[0].positions;
  positions[3].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(edgewise_set_positions(both.c, 0, &positions[0].x, 4, 0), EDGEWISE_OK);
  const Renderer renderer("tiled");
  Planes frame;
  EXPECT_EQ(edgewise_draw(renderer.c, both.c, nullptr, frame.c()), EDGEWISE_OK);
  edgewise_stats c;
  ASSERT_EQ(edgewise_stats_of(renderer.c, &c), EDGEWISE_OK);
  Frontend frontend;
  frontend.run(both.scene, {.width = kWidth, .height = kHeight, .cull = Cull::none});
  const FrontendStats made{c.meshes,        c.meshes_culled, c.triangles, c.whole_mesh,   c.not_finite,
                           c.outside,       c.not_in_front,  c.clipped,   c.clipped_near, c.clipped_far,
                           c.clipped_guard, c.pieces,        c.culled,    c.zero_area,    c.emitted};
  EXPECT_EQ(made, frontend.stats());
  EXPECT_EQ(c.triangles, 6u);
  EXPECT_EQ(c.not_finite, 4u);
  EXPECT_EQ(edgewise_stats_of(renderer.c, nullptr), EDGEWISE_INVALID_ARGUMENT);
}

TEST(CInterface, TellsWhatIsSeen) {
  Both both;
  const Renderer renderer("tiled");
  edgewise_options options = edgewise_default_options();
  options.ids = 1;
  Planes frame;
  ASSERT_EQ(edgewise_draw(renderer.c, both.c, &options, frame.c()), EDGEWISE_OK);
  const auto expected = visible_triangles(frame.view());
  ASSERT_GE(expected.size(), 3u);
  std::vector<std::uint32_t> ids(2);
  std::size_t count = 0;
  EXPECT_EQ(edgewise_visible_triangles(frame.c(), ids.data(), 2, &count), EDGEWISE_OK);
  EXPECT_EQ(count, expected.size());
  EXPECT_TRUE(std::equal(ids.begin(), ids.end(), expected.begin()));
  std::vector<std::uint32_t> pixels(6);
  EXPECT_EQ(edgewise_pixels_per_triangle(frame.c(), pixels.data(), 6), EDGEWISE_OK);
  EXPECT_EQ(pixels, pixels_per_triangle(frame.view(), 6));
  std::vector<std::uint32_t> instances(2), meshes(1);
  EXPECT_EQ(edgewise_pixels_per_instance(frame.c(), both.c, instances.data(), 2), EDGEWISE_OK);
  EXPECT_EQ(instances, pixels_per_instance(frame.view(), both.scene));
  EXPECT_EQ(edgewise_pixels_per_mesh(frame.c(), both.c, meshes.data(), 1), EDGEWISE_OK);
  EXPECT_EQ(meshes, pixels_per_mesh(frame.view(), both.scene));
  std::vector<std::size_t> first(3);
  EXPECT_EQ(edgewise_first_ids(both.c, first.data(), 2), EDGEWISE_OK);
  EXPECT_EQ(first, first_ids(both.scene));

  EXPECT_EQ(edgewise_name_triangles(both.c, 0, 1, 2, "rear"), EDGEWISE_OK);
  EXPECT_EQ(edgewise_name_triangles(both.c, 0, 0, 1, "front"), EDGEWISE_OK);
  EXPECT_EQ(edgewise_name_triangles(both.c, 0, 2, 1, "front"), EDGEWISE_OK);
  both.scene.meshes[0].parts = {{"rear", 1, 2}, {"front", 0, 1}, {"front", 2, 1}};
  using Objects = std::map<std::string, std::vector<std::uint32_t>>;
  Objects named;
  EXPECT_EQ(edgewise_objects(
                both.c,
                [](void* to, const char* name, const std::uint32_t* object, std::size_t size) {
                  (*static_cast<Objects*>(to))[name].assign(object, object + size);
                },
                &named),
            EDGEWISE_OK);
  EXPECT_EQ(named, (Objects{{"front", {0, 2, 3, 5}}, {"rear", {1, 2, 4, 5}}}));
  EXPECT_EQ(named, objects(both.scene));

  std::vector<float> uv(2 * kWidth * kHeight), distance(kWidth * kHeight), uv2 = uv, distance2 = distance;
  EXPECT_EQ(
      edgewise_barycentrics(both.c, &options, frame.c(), uv.data(), 2 * kWidth, distance.data(), kWidth),
      EDGEWISE_OK)
      << edgewise_error();
  FrontendOptions o{.width = kWidth, .height = kHeight, .cull = Cull::none};
  o.payload = Payload::id;
  barycentrics(frame.view(), both.scene, o, {uv2.data(), 2 * kWidth, distance2.data(), kWidth});
  EXPECT_EQ(uv, uv2);
  EXPECT_EQ(distance, distance2);
  options.subpixel_bits = 9;
  EXPECT_EQ(edgewise_barycentrics(both.c, &options, frame.c(), uv.data(), 2 * kWidth, nullptr, 0),
            EDGEWISE_INVALID_ARGUMENT);
  options.subpixel_bits = 8;

  for (const double z : {-0.1, -40.0}) {
    const double low[] = {-0.1, -0.1, z}, high[] = {0.1, 0.1, z + 0.05};
    int seen = 9;
    EXPECT_EQ(edgewise_box_visible(both.c, low, high, frame.c(), &seen), EDGEWISE_OK);
    EXPECT_EQ(seen != 0,
              visible(Bounds{glm::make_vec3(low), glm::make_vec3(high)}, both.scene, frame.view()));
  }
  EXPECT_EQ(edgewise_depth01(contract::kDepthHead + 12345), contract::depth01(contract::kDepthHead + 12345));
}

TEST(CInterface, ChangesAScene) {
  Both both;
  const Planes before = expect_drawn(both.c, both.scene);
  std::vector<glm::vec3>& positions = both.scene.meshes[0].positions;
  std::vector<glm::vec4> moved;  // 16 bytes apart
  for (glm::vec3& p : positions) moved.emplace_back(p = 0.5f * p + glm::vec3(0.3f, 0, 0), 9.0f);
  EXPECT_EQ(edgewise_set_positions(both.c, 0, &moved[0].x, 4, 16), EDGEWISE_OK);
  EXPECT_NE(expect_drawn(both.c, both.scene), before);
  EXPECT_EQ(edgewise_remove_instance(both.c, 0), EDGEWISE_OK);
  both.scene.instances.erase(both.scene.instances.begin());
  expect_drawn(both.c, both.scene);
}

// One of each kind. What frontend/checked_edits.h refuses, Python's arguments_test.py tests.
TEST(CInterface, TellsErrorsAndChangesNothing) {
  Both both;
  const Renderer renderer("tiled");
  const Planes before;
  Planes frame;
  const auto fails = [&](edgewise_status status, const std::string& text) {
    EXPECT_EQ(status, EDGEWISE_INVALID_ARGUMENT) << text;
    EXPECT_NE(std::string(edgewise_error()).find(text), std::string::npos) << edgewise_error();
    EXPECT_EQ(frame, before);
  };
  for (const auto& [change, text] : std::vector<std::pair<void (*)(edgewise_options&), std::string>>{
           {[](edgewise_options& o) { o.threads = 0; }, "0 threads"},
           {[](edgewise_options& o) { o.cull = 4; }, "EDGEWISE_CULL_BOTH"},
           {[](edgewise_options& o) { o.subpixel_bits = 16; }, "16 subpixel bits are outside 4 to 15"},
           {[](edgewise_options& o) { o.scissor[2] = -1; }, "negative"}}) {
    edgewise_options options = edgewise_default_options();
    change(options);
    fails(edgewise_draw(renderer.c, both.c, &options, frame.c()), text);
  }
  fails(edgewise_draw(nullptr, both.c, nullptr, frame.c()), "renderer is null");
  fails(edgewise_draw(renderer.c, both.c, nullptr, {nullptr, nullptr, kWidth, kHeight, kWidth}), "frame of");
  fails(edgewise_draw(renderer.c, both.c, nullptr,
                      {frame.depth.data(), frame.depth.data(), kWidth, kHeight, kStride}),
        "overlap");
  fails(edgewise_orthographic(-1, 1, -1, 1, 10, 0.5, std::array<double, 16>().data()), "not 10 and 0.5");
  const glm::dmat4 rows = glm::transpose(glm::translate(glm::dmat4(1.0), glm::dvec3(1.0)));
  fails(edgewise_set_instance(both.c, 1, glm::value_ptr(rows)), "last row");
  fails(edgewise_add_instance(both.c, 0, glm::value_ptr(rows), nullptr), "last row");
  const float origin[3] = {};
  fails(edgewise_set_positions(both.c, 0, origin, 1, 0), "1 vertices given instead of 4");
  fails(edgewise_set_positions(both.c, 0, origin, 4, 11), "stride of 11 bytes is below 12");
  std::uint32_t counts[3] = {5, 5, 5};
  std::size_t first[3] = {5, 5, 5}, count = 77;
  fails(edgewise_pixels_per_instance(frame.c(), both.c, counts, 3), "3 instances given instead of 2");
  fails(edgewise_pixels_per_instance(frame.c(), both.c, counts, 2), "a pixel has id 7 of 6 triangles");
  fails(edgewise_pixels_per_mesh(frame.c(), both.c, counts, 2), "2 meshes given instead of 1");
  fails(edgewise_first_ids(both.c, first, 3), "3 instances given instead of 2");
  fails(edgewise_objects(both.c, nullptr, nullptr), "each is null");
  fails(edgewise_name_triangles(both.c, 0, 2, 2, "a"), "2 triangles from 2 on does not fit a mesh of 3");
  fails(edgewise_name_triangles(both.c, 0, SIZE_MAX, 2, "a"), "does not fit a mesh of 3");
  fails(edgewise_visible_triangles(frame.c(), nullptr, 1, &count), "visible is null");
  EXPECT_EQ(count + counts[0] + counts[1] + counts[2] + first[0] + first[1] + first[2], 77u + 6 * 5);
  edgewise_renderer* none = nullptr;
  fails(edgewise_new_renderer("tilde", &none), "tiled");
  EXPECT_EQ(none, nullptr);
  const std::uint32_t indices[] = {0, 0, 0};
  edgewise_mesh mesh{};
  mesh.positions = origin, mesh.vertex_count = 1;
  mesh.triangles = indices, mesh.triangle_count = std::size_t{1} << 61;
  EXPECT_EQ(edgewise_add_mesh(both.c, &mesh, nullptr), EDGEWISE_OUT_OF_MEMORY);
}

}  // namespace
}  // namespace edgewise
