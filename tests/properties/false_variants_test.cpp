// Tests the property search itself with deliberately wrong backends: it must find each mistake and reduce it
// to a very small .tri file that reproduces it.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cstring>
#include <ostream>

#include "cli/verify/verify.h"
#include "edgewise/tri_file.h"
#include "properties/false_variants.h"
#include "properties/pictures.h"
#include "properties/property.h"
#include "properties/streams.h"
#include "run_program.h"
#include "support.h"

namespace edgewise::testing {
namespace {

struct Variant {
  std::string_view name;
  BackendInfo wrong;
  std::size_t triangles;  // the number needed to show the mistake

  friend std::ostream& operator<<(std::ostream& out, const Variant& plant) { return out << plant.name; }
};

class WrongBackend : public ::testing::TestWithParam<Variant> {};

TEST_P(WrongBackend, IsFoundAndReducedToASmallStreamThatReproducesIt) {
  const auto wrong = painters(std::span(&GetParam().wrong, 1));
  const SearchResult result = search(grid_streams(), 300, like_the_oracles(wrong, {lab::AblatedExecution{}}));
  ASSERT_TRUE(result.found.has_value());
  ASSERT_EQ(result.found->verdict.replay.size(), 1u);
  const TriangleStream& smallest = result.found->verdict.replay.front();
  EXPECT_EQ(smallest.triangles.size(), GetParam().triangles);
  EXPECT_LE(smallest.width * smallest.height, 8);

  const TempDir folder;
  const std::string message = report(*result.found, folder.path(), "wrong"),
                    path = (folder.path() / "wrong.tri").string();
  EXPECT_NE(message.find("'" EDGEWISE_PROGRAM "' verify '" + path + "'"), std::string::npos) << message;
  const TriangleStream read = read_tri(path);
  ASSERT_EQ(read.triangles.size(), smallest.triangles.size());
  EXPECT_EQ(std::memcmp(read.triangles.data(), smallest.triangles.data(),
                        read.triangles.size() * sizeof(StreamTriangle)),
            0);

  tools::VerifyPlan plan;
  plan.scenes = {path};
  plan.backends = {backends()[0], GetParam().wrong};
  const tools::SceneVerdict verdict = tools::verify(plan, {}).scenes.at(0);
  EXPECT_GT(verdict.differing_pixels, 0u);
  EXPECT_GT(verdict.oracle_differences, 0u);
  EXPECT_EQ(verdict.oracle_width, smallest.width);
  EXPECT_EQ(verdict.oracle_height, smallest.height);

  const Outcome program =
      run_program(EDGEWISE_PROGRAM, "verify '" + path + "'");  // the program has the correct backends
  EXPECT_EQ(program.status, 0) << program.out << program.err;
}

INSTANTIATE_TEST_SUITE_P(All, WrongBackend,
                         ::testing::Values(Variant{"samples_on_all_edges_are_inside",
                                                   mistaken<Mistake::samples_on_all_edges_are_inside>(), 1},
                                           Variant{"later_wins_a_tie", mistaken<Mistake::later_wins_a_tie>(),
                                                   2},
                                           Variant{"one_lane_is_a_unit_deeper",
                                                   mistaken<Mistake::one_lane_is_a_unit_deeper>(), 1}),
                         [](const auto& variant) { return std::string(variant.param.name); });

TEST(PropertyCheck, FailureNamesTheFileAndTheCommand) {
  const auto file = failure_folder() / "PropertyCheck.FailureNamesTheFileAndTheCommand.tri";
  EXPECT_NONFATAL_FAILURE(
      check(grid_streams(), 10,
            [](const TriangleStream& stream) {
              return Verdict{1, stream.triangles.size() > 2 ? "three or more" : "", {stream}};
            }),
      "'" EDGEWISE_PROGRAM "' verify '" + file.string() + "'");
  EXPECT_EQ(read_tri(file).triangles.size(), 3u);
  std::filesystem::remove(file);
}

TEST(PropertyCheck, FailureComparesPicturesThatShouldBeEqual) {
  TriangleStream stream{9, 9, {{{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, 0xFF00FF00}}};
  Counterexample found{{1, "look different", {stream, stream}, true}, 0};
  const TempDir folder;
  const auto status = [&] {
    const std::string message = report(found, folder.path(), "pair");
    return run_program("sh", "-c \"" + message.substr(message.find("again:") + 6) + "\"").status;
  };
  EXPECT_EQ(status(), 0);
  found.verdict.replay.back().triangles.front().vertex[1].x = 5;
  EXPECT_EQ(status(), 1);
}

TEST(PropertyCheck, CountsAnExceptionAsAFailure) {
  const auto refuse = [](const TriangleStream& stream) -> Verdict {
    if (stream.triangles.size() > 1) throw std::runtime_error("cannot draw two");
    return {};
  };
  const SearchResult result = search(grid_streams(), 10, refuse);
  ASSERT_TRUE(result.found.has_value());
  EXPECT_NE(result.found->verdict.wrong.find("cannot draw two"), std::string::npos);
  EXPECT_EQ(result.found->verdict.replay.at(0).triangles.size(), 2u);
}

}  // namespace
}  // namespace edgewise::testing
