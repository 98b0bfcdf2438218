// `edgewise accuracy --pictures`: each error has its colour, and identical close-ups are written once.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "cli/accuracy/accuracy.h"
#include "edgewise/image.h"
#include "run_program.h"
#include "temp_dir.h"

namespace edgewise::tools {
namespace {

// The colours that README and --help name.
constexpr std::uint32_t kVermilion = rgb(213, 94, 0), kBlue = rgb(0, 114, 178);

TEST(AccuracyPictures, ShowEachErrorInItsColour) {
  const TempDir folder;
  const std::string pictures = (folder.path() / "errors").string();
  ASSERT_EQ(testing::run_program(EDGEWISE_PROGRAM, "accuracy drtk_quad --pictures " + pictures).status, 0);
  const auto pixels_of_colour = [&](const char* method, std::uint32_t colour) {
    const Image image = read_image(pictures + "/coverage-drtk_quad-" + method + ".png");
    return std::count_if(image.pixels.begin(), image.pixels.end(),
                         [&](std::uint32_t pixel) { return (pixel & 0xFFFFFF) == (colour & 0xFFFFFF); });
  };
  const auto twice = pixels_of_colour("float_le", kBlue), gaps = pixels_of_colour("float_lt", kVermilion);
  EXPECT_GT(twice, 6 * 32 * 32);  // six squares of 64 x 64, without edges and samples
  EXPECT_EQ(twice, gaps);
  EXPECT_EQ(pixels_of_colour("float_le", kVermilion), 0);
  EXPECT_EQ(pixels_of_colour("float_lt", kBlue), 0);
  EXPECT_FALSE(std::filesystem::exists(pictures + "/coverage-drtk_quad-float_top_left.png"));
}

// The crack is vermilion. Splitting the edge closes it, since another triangle then covers its pixels.
TEST(AccuracyPictures, ShowTheTJunctionsCrackOnceAndThatSplittingClosesIt) {
  AccuracyPlan plan;
  plan.scenes = {"t_junction", "t_junction_split"};
  plan.methods = {"naive", "scanline", "tiled"};
  plan.pictures = true;
  const auto report = measure_accuracy(plan);
  ASSERT_EQ(report.closeups.size(), 2u) << "one picture per scene, since all methods draw the same";
  const auto count = [&](std::size_t scene, lab::Mark mark) {
    return std::ranges::count(report.closeups[scene].marks, mark);
  };
  EXPECT_GT(count(0, lab::Mark::gap), 40);
  EXPECT_EQ(count(1, lab::Mark::gap), 0);
  EXPECT_EQ(count(1, lab::Mark::missing), count(0, lab::Mark::gap));
  EXPECT_EQ(count(1, lab::Mark::extra), 0);
}

TEST(AccuracyPictures, AreOfCoverageAndClipping) {
  AccuracyPlan plan;
  plan.scenes = {"t_junction", "interpenetrating", "box_beside_the_axis", "floor_behind_eye"};
  plan.pictures = true;
  std::set<std::string> families;
  for (const Closeup& closeup : measure_accuracy(plan).closeups) {
    families.insert(closeup.name.substr(0, closeup.name.find('-')));
    EXPECT_LT(std::ranges::count(closeup.marks, lab::Mark::none), std::ssize(closeup.marks)) << closeup.name;
    const Image image = draw(closeup);
    EXPECT_LE(std::max(image.width, image.height), 1000) << closeup.name;
  }
  EXPECT_EQ(families, (std::set<std::string>{"clipping", "coverage"}));
}

}  // namespace
}  // namespace edgewise::tools
