// What a scene needs: scenes made to need exactly so much, and witnesses that are checked.
#include "lab/needs/needs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edgewise/backend.h"
#include "edgewise/builtin.h"
#include "edgewise/contract.h"
#include "lab/clipping/clipping.h"
#include "lab/coverage/fixed_edges.h"
#include "lab/stage_methods.h"
#include "lab/view_space.h"
#include "lab/visibility/depth_buffer.h"
#include "support.h"

namespace edgewise::lab {
namespace {

constexpr int kWidth = 24, kHeight = 16;

int scenes_to_try(int quick) {
  return testing::full_size() ? 100'000 : quick;
}

using testing::between;

StreamTriangle triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  return {{a, b, c}, rgb(200, 100, 50)};
}

TriangleStream stream_of(std::vector<StreamTriangle> triangles) {
  return {kWidth, kHeight, std::move(triangles)};
}

Needs studied(const Drawable& drawable, const NeedsOptions& options = {}, Cull cull = Cull::none) {
  Needs needs(options);
  needs.add(drawable, {kWidth, kHeight, cull});
  return needs;
}

// The entry whose name starts so.
template <typename Entry>
Entry named(const std::vector<Entry>& list, std::string_view start) {
  const auto found = std::ranges::find_if(list, [&](const Entry& e) { return e.name.starts_with(start); });
  return list.at(static_cast<std::size_t>(found - list.begin()));
}

Curve curve_of(const Needs& needs, Stage stage) {
  const std::vector<Curve> all = needs.curves();
  return *std::ranges::find(all, stage, &Curve::stage);
}

// The first level that is enough.
std::string enough(const Needs& needs, Stage stage) {
  const Curve curve = curve_of(needs, stage);
  const auto found = std::ranges::find_if(curve.levels, &Level::enough);
  return found == curve.levels.end() ? "none" : found->name;
}

std::string bits_name(int bits) {
  return std::to_string(bits) + (bits == 1 ? " bit" : " bits");
}

// A triangle whose left edge is vertical, at this x.
StreamTriangle left_edge_at(double x, int right) {
  return triangle({x, 0, 0.5}, {right, kHeight / 2, 0.5}, {x, kHeight, 0.5});
}

// The triangles that cover a sample if vertices are rounded to so many bits.
std::vector<std::uint32_t> covering(const TriangleStream& stream, int bits, int x, int y) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < stream.triangles.size(); ++i) {
    UnsnappedTriangle t{};
    const double scale = std::ldexp(1.0, bits);
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 v = stream.triangles[i].vertex[k];
      t.x_px[k] = static_cast<float>(std::nearbyint(double{v.x} * scale) / scale);
      t.y_px[k] = static_cast<float>(std::nearbyint(double{v.y} * scale) / scale);
    }
    if (const FloatTruth truth(t); truth.facing() != 0 && truth.covers(x, y)) ids.push_back(i);
  }
  return ids;
}

// An edge 2^-k px to the right of a column of samples needs k bits: with fewer, k - 1 down to 1, it is
// rounded onto the samples, or beyond. Without any, an edge on an odd column of samples is rounded away from
// them.
TEST(Needs, FindsExactlyTheSubpixelBitsThatASceneNeeds) {
  Random random(1);
  for (int i = 0; i < scenes_to_try(1500); ++i) {
    const int bits = between(random, 3, kMostSubpixelBits);
    const int x = between(random, 1, 10);
    const TriangleStream scene =
        stream_of({left_edge_at(x + 0.5 + std::ldexp(1.0, -bits), between(random, 14, 30)),
                   left_edge_at(2 * between(random, 0, 5) + 1.5, between(random, 14, 30))});
    const Question question =
        named(studied(scene, {.displacement = 0.0}).edges(), "subpixel bits, at most 0");
    ASSERT_NE(question.needed(), nullptr);
    ASSERT_EQ(question.needed()->name, bits_name(bits)) << "scene " << i;
    for (int fewer = 0; fewer < bits; ++fewer) {
      const Answer& answer = question.answers[static_cast<std::size_t>(fewer)];
      ASSERT_FALSE(answer.enough());
      const Witness& w = *answer.witness;
      EXPECT_EQ(w.right, covering(scene, 24, w.x_px, w.y_px)) << "scene " << i << ", " << fewer << " bits";
      EXPECT_EQ(w.drawn, covering(scene, fewer, w.x_px, w.y_px)) << "scene " << i << ", " << fewer << " bits";
      EXPECT_NE(w.right, w.drawn);
    }
  }
}

// Covers the whole picture.
StreamTriangle wall(float z) {
  return triangle({-100, -100, z}, {300, -100, z}, {-100, 300, z});
}

// One triangle and a camera at the origin that looks along -z.
Scene scene_of(std::vector<glm::vec3> corners) {
  Scene scene;
  scene.camera.near_z = 1.0f, scene.camera.far_z = 50.0f;
  scene.instances.resize(1);
  Mesh& mesh = scene.meshes.emplace_back();
  mesh.positions = std::move(corners);
  for (unsigned i = 0; i + 2 < mesh.positions.size(); i += 3) {
    mesh.triangles.emplace_back(i, i + 1, i + 2);
    mesh.colours.push_back(rgb(200, 100, 50));
  }
  return scene;
}

TEST(Needs, FindsWhatTheNearPlaneNeeds) {
  const NeedsOptions kFew{.tolerance_px = 4};  // those that snapping displaces
  Random random(3);
  for (int i = 0; i < scenes_to_try(600); ++i) {
    const auto within = [&](float reach) { return random.uniform(-reach, reach); };
    std::vector<glm::vec3> in_front;
    for (int k = 0; k < 3; ++k) in_front.push_back({within(2), within(1), random.uniform(-9, -4)});
    const Needs easy = studied(scene_of(in_front), kFew);
    ASSERT_EQ(enough(easy, kNearPlane), "nothing");
    EXPECT_NE(curve_of(easy, kNearPlane).proof, "");

    // Mirrored by the division: it would cover the middle of the picture.
    std::vector<glm::vec3> behind = {{-9, -9, 4}, {9, -9, 4}, {within(2), 9, random.uniform(3, 5)}};
    const Needs mirrored = studied(scene_of(behind), kFew);
    ASSERT_EQ(enough(mirrored, kNearPlane), "drop whole triangles");
    const Curve dropped = curve_of(mirrored, kNearPlane);
    EXPECT_TRUE(dropped.levels[0].witness->right.empty());
    EXPECT_EQ(dropped.levels[0].witness->drawn, std::vector<std::uint32_t>{0});
    EXPECT_NE(dropped.proof, "");

    // A floor that passes below the camera.
    const std::vector<glm::vec3> floor = {{-9, -1, 6}, {9, -1, random.uniform(2, 6)}, {within(2), -1, -30}};
    const Needs through = studied(scene_of(floor), kFew);
    ASSERT_EQ(enough(through, kNearPlane), "clip");
    const auto witness = curve_of(through, kNearPlane).levels[1].witness;
    ASSERT_TRUE(witness);
    EXPECT_NE(witness->right, witness->drawn);
    EXPECT_EQ(enough(through, kFarPlane), "nothing");
  }
}

// Front faces that are culled do not hide what clipping is missing.
TEST(Needs, SeesOnlyTheFacesThatAreDrawn) {
  const std::vector<glm::vec3> wall_and_floor = {{-3, -3, -1.05f}, {0, 6, -1.05f}, {3, -3, -1.05f},
                                                 {-9, -1, 6},      {9, -1, 6},     {0, -1, -30}};
  const Scene scene = scene_of(wall_and_floor);  // the floor is a back face
  EXPECT_EQ(enough(studied(scene, {}, Cull::front), kNearPlane), "clip");
  EXPECT_EQ(enough(studied(scene, {}, Cull::back), kNearPlane), "nothing");
}

TEST(Needs, RangesLeaveOutVerticesThatNoTriangleUses) {
  Scene scene = scene_of({{0, 0, -4}, {1, 0, -4}, {0, 1, -4}});
  scene.meshes.front().positions.push_back({0, 0, 50});
  EXPECT_EQ(curve_of(studied(scene), kNearPlane).proof, "the nearest vertex is at 4, the plane at 1");
}

TEST(Needs, FindsWhatTheFarPlaneNeeds) {
  const Scene beyond = scene_of({{-90, -90, -60}, {90, -90, -60}, {0, 90, -60}});
  EXPECT_EQ(enough(studied(beyond), kFarPlane), "drop whole triangles");
  const Scene through = scene_of({{-9, -9, -10}, {9, -9, -10}, {0, 90, -200}});
  EXPECT_EQ(enough(studied(through), kFarPlane), "clip");
}

// The largest edge value at all samples of the box, by brute force.
int width_at_every_sample(const UnsnappedTriangle& t, int bits) {
  long long x[3], y[3], largest = 0;
  const int scale = 1 << bits;
  for (int i = 0; i < 3; ++i)
    x[i] = std::llrint(double{t.x_px[i]} * scale), y[i] = std::llrint(double{t.y_px[i]} * scale);
  const auto [low_x, high_x] = std::minmax({x[0], x[1], x[2]});
  const auto [low_y, high_y] = std::minmax({y[0], y[1], y[2]});
  bool sampled = false;
  for (int py = 0; py < kHeight; ++py)
    for (int px = 0; px < kWidth; ++px) {
      const long long sx = px * scale + scale / 2, sy = py * scale + scale / 2;
      if (sx < low_x || sx > high_x || sy < low_y || sy > high_y) continue;
      sampled = true;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        largest = std::max(largest, std::abs((x[j] - x[i]) * (sy - y[i]) - (y[j] - y[i]) * (sx - x[i])));
      }
    }
  const long long area = std::abs((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]));
  if (!sampled || area == 0) return 1;
  return 65 - std::countl_zero(static_cast<std::uint64_t>(std::max(largest, area)));
}

TEST(Needs, ComputesTheExactWidthOfEdgeValues) {
  Random random(4);
  for (int i = 0; i < scenes_to_try(1000); ++i) {
    const float reach = std::exp(random.uniform(0, 6));
    StreamTriangle t = wall(0.5f);
    UnsnappedTriangle at{};
    for (int k = 0; k < 3; ++k) {
      t.vertex[k].x = at.x_px[k] = random.uniform(-reach, reach);
      t.vertex[k].y = at.y_px[k] = random.uniform(-reach, reach);
    }
    const Needs needs = studied(stream_of({t}));
    for (const int bits : {1, 4, 8, 16})
      ASSERT_EQ(needs.ranges().edge_value_bits(bits), width_at_every_sample(at, bits)) << i << ' ' << bits;
  }
}

// Both sides of the largest box: a triangle over half of it, and one that is a pixel larger.
TEST(Needs, KnowsTheLargestTriangleOfIntegers) {
  for (const int bits : {5, 8}) {
    const double legs = std::floor(std::sqrt(largest_box_px2(32, bits)));
    for (const double more : {0.0, 1.0}) {
      StreamTriangle t = wall(0.5f);
      const float far = static_cast<float>(legs + more);
      t.vertex[0] = {0, 0, 0.5f}, t.vertex[1] = {far, 0, 0.5f}, t.vertex[2] = {0, far, 0.5f};
      const Needs needs = studied(stream_of({t}));
      EXPECT_EQ(needs.ranges().edge_value_bits(bits) > 32, more > 0) << bits;
    }
  }
  EXPECT_GE(largest_box_px2(32, 5), 1920 * 1080) << "SerenityOS's choice";
  EXPECT_LT(largest_box_px2(32, 6), 1920 * 1080);
}

template <int... kBits>
void draw_with_depth_bits(int bits, const VisibilityScene& scene, VisibilityFrame& frame,
                          std::integer_sequence<int, kBits...>) {
  ((bits == kBits + 1
        ? draw_depth_buffer<UnormPlane<kBits + 1, std::uint32_t>>(
              scene, frame, frame.depth32, std::uint32_t{UnormPlane<kBits + 1, std::uint32_t>::kMax})
        : void()),
   ...);
}

// The ids that a pipeline without clipping shows, from the public front end on.
std::vector<std::uint32_t> picture_of(const Levels& levels, const Scene& scene, Size size) {
  Frontend frontend;
  const auto all = frontend.run(scene, {.width = size.width,
                                        .height = size.height,
                                        .cull = Cull::none,
                                        .payload = Payload::id,
                                        .keep_unsnapped = true});
  const std::string& test = levels.at("facing test");
  const std::string depth = levels.contains("depth buffer") ? levels.at("depth buffer") : "contract31";
  const double scale = std::ldexp(1.0, std::stoi(levels.at("subpixel bits")));
  const bool by_normal = test.starts_with("normal_");
  const auto fronts = by_normal ? fronts_of(find_facing_method(test), in_view_space(scene, size))
                                : std::vector<std::uint8_t>();
  std::vector<ScreenTriangle> kept;
  std::vector<UnsnappedTriangle> kept_at;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const UnsnappedTriangle& at = frontend.unsnapped()[i];
    ScreenTriangle t = all[i];
    for (int k = 0; k < 3; ++k) {
      t.x_q15[k] = static_cast<std::int32_t>(std::nearbyint(double{at.x_px[k]} * scale) / scale *
                                             contract::kPixel_q15);
      t.y_q15[k] = static_cast<std::int32_t>(std::nearbyint(double{at.y_px[k]} * scale) / scale *
                                             contract::kPixel_q15);
    }
    const bool front = test == "no test"      ? true
                       : by_normal            ? fronts[t.payload] != 0
                       : test == "float_area" ? FloatTruth(at).facing() > 0
                                              : contract::signed_area(t) > 0;
    if (!front) continue;
    kept.push_back(t);
    kept_at.push_back(at);
  }
  const VisibilityScene seen = visibility_scene(kept, kept_at, scene, size);
  VisibilityFrame frame;
  if (levels.at("visibility") != "depth buffer")
    find_visibility_method(levels.at("visibility")).draw(seen, frame);
  else if (depth == "contract31")
    find_visibility_method(depth).draw(seen, frame);
  else
    draw_with_depth_bits(std::stoi(depth), seen, frame, std::make_integer_sequence<int, 30>());
  for (std::uint32_t& id : frame.visible)
    if (id != kNoTriangle) id = kept[id].payload;
  return frame.visible;
}

std::vector<std::uint32_t> library_picture(const Drawable& drawable, Size size) {
  Frontend frontend;
  Framebuffer frame(size.width, size.height);
  find_backend("tiled").make()->draw(
      frontend.run(drawable, {.width = size.width, .height = size.height, .payload = Payload::id}),
      frame.view(), {kNoTriangle});
  return payloads_of(frame);
}

// What each pipeline of the benchmark's rows computes anew: clipping on all sides, and facing by normals also
// if an instance mirrors.
TEST(Needs, PipelinesDrawTheLibrarysPictureFromTheVerticesOn) {
  const Size size{96, 54};
  PipelineMemory memory;
  const auto check = [&](const Drawable& drawable, const Levels& levels = {}) {
    const PipelineFrame frame(drawable, {.width = size.width, .height = size.height});
    frame.draw(pipeline_of(levels), memory);
    EXPECT_EQ(memory.picture(), library_picture(drawable, size));
  };
  for (int direction = 0; direction < kOutsideDirections; ++direction)
    for (const bool reversed : {false, true}) check(outside_direction(direction, reversed).scene);
  check(floor_through_eye(0.1f).scene);
  check(find_scene("terrain").make({size.width, size.height}), {{"facing test", "normal_dot_object"}});
  check(TriangleStream{
      size.width, size.height, {triangle({-1e5, -20, 0.4}, {40, -10, -0.5}, {1e5, 80, 0.9}), wall(0.3f)}});
  Scene mirrored = std::get<Scene>(find_scene("sphere").make({size.width, size.height}));
  mirrored.instances.front().scale = {-1.0, 0.5, 2.0};
  for (const char* test : {"normal_dot_eye", "snapped_area"})
    check(mirrored, {{"facing test", test}, {"visibility", "painter_mean"}});
}

using Picture = std::vector<std::uint32_t>;
std::uint64_t differing(const Picture& a, const Picture& b) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1u : 0u;
  return count;
}

using Worst = std::vector<std::pair<Levels, std::uint64_t>>;

// All pipelines that do not clip, drawn one by one, with the wrong pixels of their worst frame.
Worst brute_force(const std::vector<Scene>& scenes, const std::vector<Picture>& truths, Size size) {
  constexpr const char* kOrders[] = {"submission_order", "painter_mean", "painter_farthest", "depth buffer"};
  Worst worst;
  for (const char* test :
       {"no test", "normal_z", "normal_dot_object", "normal_dot_eye", "float_area", "snapped_area"})
    for (int bits = 0; bits <= 8; ++bits)
      for (int order = 0; order < 3 + 31; ++order) {
        Levels levels{{"near plane", "nothing"},          {"far plane", "nothing"},
                      {"guard band", "nothing"},          {"facing test", test},
                      {"subpixel bits", bits_name(bits)}, {"visibility", kOrders[std::min(order, 3)]}};
        if (order >= 3) levels["depth buffer"] = order == 3 + 30 ? "contract31" : bits_name(order - 2);
        std::uint64_t most = 0;
        for (std::size_t i = 0; i < scenes.size(); ++i)
          most = std::max(most, differing(picture_of(levels, scenes[i], size), truths[i]));
        worst.emplace_back(levels, most);
      }
  return worst;
}

// Of the pipelines with at most so many wrong pixels, those of which none is weaker.
std::vector<Levels> least(const Worst& worst, std::uint64_t tolerance_px) {
  const auto number = [](const Levels& levels, const char* stage) {
    if (!levels.contains(stage)) return 0;
    return levels.at(stage) == "contract31" ? 31 : std::stoi(levels.at(stage));
  };
  const auto rank = [](const std::string& visibility) {
    return visibility == "submission_order" ? 0 : visibility == "depth buffer" ? 2 : 1;
  };
  const auto no_more = [&](const Levels& a, const Levels& b) {
    const std::string &test = a.at("facing test"), &seen = a.at("visibility");
    return (test == "no test" || test == b.at("facing test")) &&
           (seen == b.at("visibility") || rank(seen) < rank(b.at("visibility"))) &&
           number(a, "depth buffer") <= number(b, "depth buffer") &&
           number(a, "subpixel bits") <= number(b, "subpixel bits");
  };
  std::vector<Levels> found;
  for (const auto& [levels, px] : worst)
    if (px <= tolerance_px && std::ranges::none_of(worst, [&](const auto& other) {
          return other.second <= tolerance_px && other.first != levels && no_more(other.first, levels);
        }))
      found.push_back(levels);
  std::ranges::sort(found);
  return found;
}

// Wrong pixels of a pipeline, those that are hidden, and the farthest of the others, pixel by pixel.
void check_level(const Level& level, Stage stage, const std::vector<Scene>& scenes,
                 const std::vector<Picture>& truths, Size size) {
  Level expected;
  PipelineMemory memory;
  for (std::size_t n = 0; n < scenes.size(); ++n) {
    const FrontendOptions options{.width = size.width, .height = size.height, .cull = Cull::back};
    PipelineFrame(scenes[n], options).draw(pipeline_of({{name_of(stage), level.name}}), memory);
    const Picture drawn = memory.picture(), &right = truths[n];
    expected.wrong_px += differing(drawn, right);
    expected.worst_px = std::max(expected.worst_px, differing(drawn, right));
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (drawn[i] == right[i]) continue;
      std::int64_t nearest = -1;
      const auto width = static_cast<std::int64_t>(size.width);
      for (std::size_t j = 0; j < right.size(); ++j) {
        const auto from = static_cast<std::int64_t>(i), to = static_cast<std::int64_t>(j);
        const std::int64_t dx = from % width - to % width, dy = from / width - to / width;
        if (right[j] == drawn[i] && (nearest < 0 || dx * dx + dy * dy < nearest)) nearest = dx * dx + dy * dy;
      }
      if (nearest < 0) ++expected.hidden_px;
      expected.farthest_squared_px = std::max(expected.farthest_squared_px, nearest);
    }
  }
  EXPECT_EQ(level.wrong_px, expected.wrong_px) << level.name;
  EXPECT_EQ(level.worst_px, expected.worst_px) << level.name;
  EXPECT_EQ(level.hidden_px, expected.hidden_px) << level.name;
  EXPECT_EQ(level.farthest_squared_px, expected.farthest_squared_px) << level.name;
}

void check_minima(const std::vector<Scene>& scenes, Size size) {
  std::vector<Picture> truths;
  for (const Scene& scene : scenes)
    truths.push_back(
        SceneTruth(scene, size, Cull::back).visible_triangles({size.width, size.height}, 1).triangle);
  const Worst worst = brute_force(scenes, truths, size);
  const std::uint64_t fewest = std::ranges::min(worst, {}, &Worst::value_type::second).second;
  for (const std::uint64_t tolerance_px : {0u, 3u, 20u}) {
    Needs needs({.tolerance_px = tolerance_px, .threads = 2});
    for (const Scene& scene : scenes) needs.add(scene, {size.width, size.height});
    Minima minima = needs.minima();
    std::ranges::sort(minima.right);
    EXPECT_EQ(minima.judged, worst.size());
    EXPECT_EQ(minima.right, least(worst, tolerance_px)) << tolerance_px;
    if (minima.right.empty()) {
      EXPECT_EQ(minima.closest_px, fewest);
      EXPECT_TRUE(std::ranges::count(worst, std::pair{minima.closest, fewest}));
    }
    if (tolerance_px != 0) continue;
    for (const Curve& curve : needs.curves())
      for (const Level& level : curve.levels) check_level(level, curve.stage, scenes, truths, size);
  }
}

TEST(Needs, MinimaAndCurvesAreThoseOfBruteForce) {
  const Size size{48, 27};
  for (const char* name : {"cube", "cubes"}) {
    SCOPED_TRACE(name);
    std::vector<Scene> scenes;
    for (const float seconds : {0.0f, 0.4f})
      scenes.push_back(std::get<Scene>(find_scene(name).make({size.width, size.height, seconds})));
    check_minima(scenes, size);
  }
}

// It needs no facing test if it is painted. A greedy search from the exact pipeline never came there.
TEST(Needs, MinimaOfAnOctahedronAreThoseOfBruteForce) {
  const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  Scene scene =
      scene_of({y, x, z, -x, y, z, -y, -x, z, x, -y, z, x, y, -z, y, -x, -z, -x, -y, -z, -y, x, -z});
  scene.camera = Camera{};
  scene.camera.position = {1.2, 0.9, 2.4};
  scene.camera.look_at({0, 0, 0});
  check_minima({scene}, {80, 45});
}

// The second triangle lies just above the edge that both share. Rounded to whole pixels, its third vertex
// lies below.
TEST(Needs, CountsFoldsAsCracks) {
  const Needs needs = studied(stream_of({triangle({0, 7, 0.5}, {24, 7.8, 0.5}, {12, 16, 0.5}),
                                         triangle({0, 7, 0.5}, {24, 7.8, 0.5}, {18, 7.55, 0.5})}));
  const Question question = named(needs.edges(), "subpixel bits: no crack, no fold");
  ASSERT_FALSE(question.answers[0].enough());
  const Witness& w = *question.answers[0].witness;
  EXPECT_EQ(w.right, std::vector<std::uint32_t>{0});
  EXPECT_EQ(w.drawn, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(named(question.answers, "8 bits").enough());
}

// The diagonal of a square passes through seven samples between its ends. Strict tests draw none of them.
TEST(Needs, CountsGapsOfSharedEdgesAsCracks) {
  const glm::vec3 a{1.5, 1.5, 0.5}, b{9.5, 1.5, 0.5}, c{9.5, 9.5, 0.5}, d{1.5, 9.5, 0.5};
  const Needs needs = studied(stream_of({triangle(a, b, c), triangle(a, c, d)}));
  const Question question = named(needs.edges(), "float edges without a crack");
  const Answer strict = named(question.answers, "float_lt");
  ASSERT_FALSE(strict.enough());
  EXPECT_EQ(strict.wrong_px, 7u);
  EXPECT_EQ(strict.witness->drawn, std::vector<std::uint32_t>{});
  EXPECT_TRUE(named(question.answers, "float_top_left").enough());
}

// A frame that needs more than the ones before it decides.
TEST(Needs, TheHardestFrameDecides) {
  Needs needs({.displacement = 0.0});
  for (const int bits : {3, 7, 5})
    needs.add(stream_of({left_edge_at(4.5 + std::ldexp(1.0, -bits), 20), left_edge_at(7.5, 20)}),
              {kWidth, kHeight, Cull::none});
  const Question question = named(needs.edges(), "subpixel bits, at most 0");
  EXPECT_EQ(question.needed()->name, "7 bits");
  EXPECT_EQ(named(question.answers, "4 bits").witness->frame, 1u);
  EXPECT_EQ(named(question.answers, "2 bits").witness->frame, 0u);
}

}  // namespace
}  // namespace edgewise::lab
