// The command `edgewise accuracy`: the JSON schema, counts that theory predicts, and pictures: each error has
// its colour, and identical close-ups are written once.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/accuracy/accuracy.h"
#include "edgewise/image.h"
#include "edgewise/tri_file.h"
#include "lab/peers/peer.h"
#include "run_program.h"
#include "temp_dir.h"

namespace edgewise::tools {
namespace {

using nlohmann::json;
using testing::Outcome;

Outcome accuracy(const std::string& arguments) {
  return testing::run_program(EDGEWISE_PROGRAM, "accuracy " + arguments);
}

json json_of(const std::string& arguments) {
  const Outcome outcome = accuracy(arguments + " --json -");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(outcome.out);
}

const json& named(const json& list, std::string_view name) {
  return *std::find_if(list.begin(), list.end(), [&](const json& entry) { return entry.at("name") == name; });
}

// facts_test.cpp compares all keys of small scenes with the committed ones.
TEST(Accuracy, DescribesMethodsAndScenes) {
  const json report = json_of("drtk_quad lattice_square --family coverage");
  EXPECT_EQ(named(report.at("methods"), "fixed_8_int32").at("max_side_px"), 181);
  const json& quad = named(report.at("scenes"), "drtk_quad");
  EXPECT_EQ(quad.at("crossings"), 36);
  EXPECT_EQ(quad.at("shared_crossings"), 6) << "crossings of the diagonal";
  EXPECT_NEAR(quad.at("largest_side_px").get<double>(), 6.0, 1e-4);
  EXPECT_GT(named(quad.at("methods"), "float_le").at("source").at("errors_per_million"), 0);
  const json& square = named(report.at("scenes"), "lattice_square");
  EXPECT_EQ(named(square.at("methods"), "float_le").at("cracks").at("double_hits"), 64);
  EXPECT_EQ(named(square.at("methods"), "float_lt").at("cracks").at("gaps"), 64);
}

TEST(Accuracy, FollowsTheTurningCube) {
  const json report = json_of("turning-cube --quick --family coverage");
  const json& cube = report.at("turning_cube");
  EXPECT_EQ(cube.at("frames"), 120);
  for (const json& method : report.at("methods")) {
    if (!method.at("exact")) continue;
    const json& counts = named(cube.at("methods"), method.at("name").get<std::string>());
    for (const char* kind : {"missing", "extra"})
      EXPECT_GT(counts.at(kind).at("total"), 0) << method << ": snapping moves the outline";
    EXPECT_EQ(counts.at("gaps").at("total"), 0) << method << ": snapping opens no crack";
  }
  for (const json& motion : report.at("motions")) {
    const auto superfluous = [&](std::string_view method) {
      return named(motion.at("methods"), method).at("superfluous").get<int>();
    };
    EXPECT_GT(motion.at("changes"), 0) << motion.at("name");
    EXPECT_LT(superfluous("double_top_left") * 8, superfluous("fixed_8"))
        << "it errs only where floats project vertices across a sample";
    EXPECT_GT(superfluous("whole_pixel"), superfluous("fixed_8"));
    EXPECT_GT(superfluous("fixed_8"), 0) << "snapping moves edges to and fro";
  }
}

TEST(Accuracy, TablesFitEightyColumns) {
  AccuracyPlan plan;
  plan.scenes = {"cube",    "drtk_quad",        "lattice_square", "planes_1e-5_apart",
                 "edge_on", "floor_behind_eye", "turning-cube"};
  plan.quick = true;
  const std::string text = accuracy_tables(measure_accuracy(plan));
  EXPECT_NE(text.find("  floor_behind_eye\n"), std::string::npos) << "it has all errors of clipping";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(Accuracy, CountsTheFramesOfTheChartForChoosing) {
  const json report = json_of("choice --quick --method tiled,float_lt");
  ASSERT_EQ(report.at("choices").size(), 4u);
  for (const json& choice : report.at("choices")) {
    EXPECT_EQ(choice.at("frames"), 6);
    EXPECT_EQ(choice.contains("float_projection"), choice.at("name") == "torus-knot");
    EXPECT_EQ(choice.at("methods").size(), 4u) << "tiled has three numbers of subpixel bits";
    for (const json& method : choice.at("methods")) {
      EXPECT_LE(6 * method.at("least").get<int>(), method.at("wrong_pixels")) << method;
      EXPECT_LE(method.at("wrong_pixels"), 6 * method.at("most").get<int>()) << method;
    }
  }
}

// Two quads, .0012 px apart on both sides of a row of samples: no edge is shared there, and the exact picture
// shows the background, too.
TEST(Accuracy, CountsTheSlitThatAViewerSeesAlongASeam) {
  const TempDir folder;
  const std::string path = (folder.path() / "seam.tri").string();
  TriangleStream seam{64, 24, {}};
  const auto quad = [&](float top, float bottom) {
    const auto add = [&](glm::vec2 a, glm::vec2 b, glm::vec2 c) {
      seam.triangles.push_back({{{a, 0.5f}, {b, 0.5f}, {c, 0.5f}}, 1});
    };
    add({2.3f, top}, {60.7f, bottom}, {2.3f, bottom});
    add({2.3f, top}, {60.7f, top}, {60.7f, bottom});
  };
  quad(2.2f, 10.4994f), quad(10.5006f, 20.1f);
  std::ofstream out(path, std::ios::binary);
  write_tri(out, seam);
  out.close();
  const json scene = json_of(path + " --family coverage").at("scenes").at(0);
  EXPECT_EQ(scene.at("kind"), "meshes");
  EXPECT_EQ(scene.at("slits"), 59);
  const json& exact = named(scene.at("methods"), "double_top_left");
  EXPECT_EQ(exact.at("source").at("wrong_pixels"), 0);
  EXPECT_EQ(exact.at("source").at("slits"), 59);
  EXPECT_EQ(named(scene.at("methods"), "tiled").at("source").at("slits"), 0) << "1/256 px closes it";
}

TEST(Accuracy, MeasuresPeersInPlaceOfTheMethods) {
  const lab::StartedPeers started = lab::start_peers(lab::peers());
  const Outcome outcome = accuracy("--peers --quick --json -");
  if (started.peers.empty()) {
    EXPECT_EQ(outcome.status, 2) << "peers_test.cpp has the message";
    return;
  }
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(accuracy("cube --peers").err.find("--peers measures the scene 'choice' only"), std::string::npos);
  const json report = json::parse(outcome.out);
  EXPECT_FALSE(report.contains("turning_cube"));
  EXPECT_TRUE(report.at("scenes").empty());
  for (const auto& [peer, version] : started.peers)
    EXPECT_EQ(named(report.at("methods"), peer->name).at("source"), version);
  for (const json& choice : report.at("choices"))
    for (const json& method : choice.at("methods"))
      EXPECT_LE(method.at("least"), method.at("most")) << choice.at("name") << ' ' << method;
}

TEST(Accuracy, RunsOnlyTheRequestedMethodsAndFamily) {
  const json report = json_of("cube --quick --method float_le,painter_mean --method float_lt");
  ASSERT_EQ(report.at("methods").size(), 3u);
  ASSERT_EQ(report.at("scenes").size(), 2u);
  EXPECT_EQ(report.at("scenes")[0].at("methods").size(), 2u);
  EXPECT_EQ(report.at("scenes")[1].at("methods").at(0).at("name"), "painter_mean");
  EXPECT_EQ(json_of("cube --quick --family visibility").at("scenes").size(), 1u);
}

// The colours that README and --help name.
constexpr std::uint32_t kVermilion = rgb(213, 94, 0), kBlue = rgb(0, 114, 178);

TEST(AccuracyPictures, ShowEachErrorInItsColour) {
  const TempDir folder;
  const std::string pictures = (folder.path() / "errors").string();
  ASSERT_EQ(accuracy("drtk_quad --pictures " + pictures).status, 0);
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
