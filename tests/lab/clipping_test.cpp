// The clipping methods: their promises and their failures, against a truth that needs no clipping.
#include "lab/clipping/clipping.h"
#include "lab/clipping/truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "lab/cases/backend_comparison.h"
#include "lab/portable/portable.h"
#include "lab/stage_methods.h"
#include "lab/truth/truth.h"
#include "lab/view_space.h"
#include "message_of.h"

namespace edgewise::lab {
namespace {

constexpr auto& method = find_clipping_method;
ClippingScore judge(std::string_view name, const ClippingScene& scene) {
  return score(method(name), scene, clipping_truth(scene));
}

TEST(Clipping, EveryMethodKeepsItsPromiseAndTheImpreciseFailSomewhere) {
  std::map<std::string_view, std::uint64_t> wrong;
  for (const auto& c : clipping_cases()) {
    const ClippingScene scene = c.make();
    const auto truth = clipping_truth(scene);
    for (const auto& m : clipping_methods()) {
      const auto s = score(m, scene, truth);
      EXPECT_GT(s.covered, 200u) << c.name;
      EXPECT_EQ(s.broken, 0u) << m.info.name << " on " << c.name;
      if (c.name != "along_the_rows") {
        EXPECT_LE(s.hairline, s.covered / 100) << m.info.name << " on " << c.name;
      }
      wrong[m.info.name] += s.wrong();
    }
  }
  for (const auto& m : clipping_methods()) EXPECT_EQ(wrong[m.info.name] == 0, m.info.exact) << m.info.name;
}

TEST(Clipping, APictureIsCorrectedWhereItDiffersBeyondHairline) {
  const ClippingScene scene = floor_far_from_origin(1 << 20);
  const ClippingTruth truth = clipping_truth(scene);
  ClippingFrame frame(scene.size);
  method("near_guard").draw(scene, frame);
  const std::vector<std::uint32_t> drawn = payloads_of(frame.picture);
  std::vector<std::uint32_t> corrected = drawn;
  EXPECT_EQ(correct(corrected, scene.size, *truth.oracle, 2), 0u);
  EXPECT_EQ(corrected, drawn);
  // The triangle that covers most pixels is lost.
  std::map<std::uint32_t, std::uint64_t> pixels;
  for (const std::uint32_t id : drawn)
    if (id != kNoTriangle) ++pixels[id];
  const auto [lost, count] =
      *std::max_element(pixels.begin(), pixels.end(), [](auto a, auto b) { return a.second < b.second; });
  std::replace(corrected.begin(), corrected.end(), lost, kNoTriangle);
  const std::uint64_t replaced = correct(corrected, scene.size, *truth.oracle, 2);
  EXPECT_LE(replaced, count);
  EXPECT_GE(replaced, count * 9 / 10);
}

// Floats move an edge if both its ends are far beyond the method's reach, and the promise excludes such
// edges.
TEST(Clipping, FloatsMoveEdgesWhoseEndsAreFarOutOnBothSides) {
  const double reach_px = method("screen_edges").reach_px;
  const ClippingScene inside = far_slivers(reach_px - 300, 100), beyond = far_slivers(8 * reach_px, 100);
  EXPECT_EQ(judge("screen_edges", inside).wrong(), 0u);
  EXPECT_GT(judge("screen_edges", beyond).wrong(), 100u);
  EXPECT_EQ(judge("screen_edges", beyond).broken, 0u);
  // Ours cuts edges in double.
  for (const ClippingScene& scene : {beyond, far_slivers(method("near_guard").reach_px - 300, 100)})
    EXPECT_EQ(judge("near_guard", scene).wrong(), 0u);
}

TEST(Clipping, TrianglesClippedInEveryDirectionKeepTheirWinding) {
  for (int direction = 0; direction < kOutsideDirections; ++direction)
    for (const bool reversed : {false, true}) {
      const ClippingScene scene = outside_direction(direction, reversed);
      const auto truth = clipping_truth(scene);
      const auto s = score(method("near_guard"), scene, truth);
      EXPECT_EQ(s.covered > 20, !reversed) << direction;
      EXPECT_EQ(s.wrong(), 0u) << direction << (reversed ? " reversed" : "");
    }
}

TEST(Clipping, LikeAllMethodsThatKnowOnlyCamerasRefusesMatrices) {
  ClippingScene seen = clipping_cases()[0].make();
  seen.scene.matrices = matrices_of(seen.scene.camera, 1);
  const Scene& scene = seen.scene;
  const char* const kMessage = "this needs a camera, and the scene has matrices";
  EXPECT_EQ(message_of([&] { clipping_truth(seen); }), kMessage);
  EXPECT_EQ(message_of([&] { in_view_space(scene, {64, 64}); }), kMessage);
  EXPECT_EQ(message_of([&] { portable_triangles(scene, {64, 64, Cull::none}); }), kMessage);
}

}  // namespace
}  // namespace edgewise::lab
