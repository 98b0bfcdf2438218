// The clipping methods: their promises and their failures, against a truth that needs no clipping.
#include "lab/clipping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "lab/truth.h"
#include "lab_support.h"

namespace edgewise::lab {
namespace {

const ClippingMethod& method(std::string_view name) {
  return method_named(clipping_methods(), name);
}
ClippingScene make_case(std::string_view name) {
  return make_case_named(clipping_cases(), name);
}
ClippingScore judge(std::string_view name, const ClippingScene& scene) {
  return score(method(name), scene, clipping_truth(scene));
}

TEST(Clipping, EveryFileOfTheFolderIsRegistered) {
  expect_folder_registered("clipping_methods", clipping_methods());
}

TEST(Clipping, EveryMethodKeepsItsPromiseAndTheImpreciseFailSomewhere) {
  std::map<std::string_view, std::uint64_t> wrong, moved;
  for (const auto& c : clipping_cases()) {
    const ClippingScene scene = c.make();
    const auto truth = clipping_truth(scene);
    for (const auto& m : clipping_methods()) {
      const auto s = score(m, scene, truth);
      EXPECT_GT(s.covered, 200u) << c.name;
      EXPECT_EQ(s.broken, 0u) << m.info.name << " on " << c.name;
      EXPECT_LE(s.hairline, s.covered / 100) << m.info.name << " on " << c.name;
      wrong[m.info.name] += s.wrong();
      moved[m.info.name] += s.differs_from_ours;
    }
  }
  for (const auto& m : clipping_methods()) {
    EXPECT_EQ(wrong[m.info.name] == 0, m.fails_on == 0) << m.info.name;
    EXPECT_EQ(moved[m.info.name] == 0, m.info.exact) << m.info.name;
  }
}

// FAILURES.md, 6.
TEST(Clipping, AFloorUnderTheEye) {
  for (const float near_z : {0.5f, 0.1f, 0.001f}) {
    const ClippingScene scene = floor_through_eye(near_z);
    EXPECT_EQ(judge("near_guard", scene).wrong(), 0u);
    EXPECT_GT(judge("discard_behind", scene).missing, 500u);
    const auto divided = judge("none", scene);
    EXPECT_GT(divided.missing + divided.extra + divided.wrong_owner, 500u);
  }
}

TEST(Clipping, DividingByZeroIsCaughtAndCounted) {
  const auto s = judge("none", make_case("vertex_at_eye_plane"));
  EXPECT_EQ(s.not_a_number, 2u);
  EXPECT_EQ(judge("near_guard", make_case("vertex_at_eye_plane")).not_a_number, 0u);
  EXPECT_GT(judge("none", make_case("beyond_the_guard_band")).out_of_range, 0u);
}

// FAILURES.md, 7.
TEST(Clipping, QuadsBeforeTheNearPlaneAreNotDrawn) {
  const ClippingScene scene = make_case("quads_before_near");
  const auto truth = clipping_truth(scene);
  EXPECT_TRUE(std::all_of(truth.owner.begin(), truth.owner.end(),
                          [](auto owner) { return owner < 2 || owner == Owners::kNobody; }));
  for (const auto name : {"near_guard", "screen_edges", "discard_behind"})
    EXPECT_EQ(score(method(name), scene, truth).wrong(), 0u) << name;
  for (const auto name : {"near_too_near", "none"}) {
    const auto s = score(method(name), scene, truth);
    EXPECT_GT(s.wrong_owner, 100u) << name;
    EXPECT_EQ(s.out_of_range, 12u) << name;
  }
}

// FAILURES.md, 9.
TEST(Clipping, ClippingAtTheScreensEdgesMovesThem) {
  const auto s = judge("screen_edges", make_case("over_the_screens_edges"));
  EXPECT_GT(s.differs_from_ours, 0u);
  EXPECT_EQ(s.wrong(), 0u);
}

TEST(Clipping, LinearAttributesAreWrong) {
  EXPECT_NEAR(linear_attribute_error(1, 10, 0.5), 0.41, 0.001);
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) worst = std::max(worst, linear_attribute_error(1, 10, i / 1000.0));
  EXPECT_NEAR(worst, 0.5195, 0.0001);  // (sqrt 10 - 1) / (sqrt 10 + 1)
}

// FAILURES.md, 10.
TEST(Clipping, EveryDirectionKeepsItsWinding) {
  for (int direction = 0; direction < kOutsideDirections; ++direction)
    for (const bool reversed : {false, true}) {
      const ClippingScene scene = outside_direction(direction, reversed);
      const auto truth = clipping_truth(scene);
      const auto s = score(method("near_guard"), scene, truth);
      EXPECT_EQ(s.covered > 20, !reversed) << direction;
      EXPECT_EQ(s.wrong(), 0u) << direction << (reversed ? " reversed" : "");
      if (reversed) {
        ClippingFrame frame(scene.size);
        method("near_guard").draw(scene, frame);
        for (int y = 0; y < scene.size.height; ++y)
          EXPECT_TRUE(std::all_of(frame.picture.payload_row(y),
                                  frame.picture.payload_row(y) + scene.size.width,
                                  [](auto owner) { return owner == Owners::kNobody; }));
      }
    }
}

}  // namespace
}  // namespace edgewise::lab
