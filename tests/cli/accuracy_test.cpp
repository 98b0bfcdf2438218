// The command `edgewise accuracy`: the JSON schema, and counts that theory predicts.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "cli/accuracy/accuracy.h"
#include "edgewise/builtin.h"
#include "edgewise/tri_file.h"
#include "lab/coverage/coverage.h"
#include "lab/coverage_support.h"
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

TEST(Accuracy, CountsTheDrtkQuadAndTheLatticeSquareAsPredicted) {
  const json report = json_of("drtk_quad lattice_square small_triangles");
  const auto count = [&](const char* scene, const char* method, const char* what) {
    const json& entry = named(named(report.at("scenes"), scene).at("methods"), method);
    return entry.at(entry.at("cracks").contains(what) ? "cracks" : "source").at(what).get<int>();
  };
  EXPECT_EQ(count("drtk_quad", "float_le", "double_hits"), 6);
  EXPECT_EQ(count("drtk_quad", "float_le", "gaps"), 0);
  EXPECT_EQ(count("drtk_quad", "float_lt", "gaps"), 6);
  EXPECT_EQ(count("drtk_quad", "float_lt", "double_hits"), 0);
  EXPECT_EQ(count("drtk_quad", "float_top_left", "errors"), 0);
  EXPECT_EQ(count("lattice_square", "float_le", "double_hits"), 64);
  EXPECT_EQ(count("lattice_square", "float_lt", "gaps"), 64);
  EXPECT_EQ(count("small_triangles", "whole_pixel", "double_hits"), 23) << "rounding turns some over";
}

TEST(Accuracy, JudgesQuadsAndKnotsOnlyWhenNamed) {
  const auto count = [](std::vector<std::string> named) {
    AccuracyPlan plan;
    plan.scenes = std::move(named);
    const auto scenes = scenes_of(plan).scenes;
    return std::count_if(scenes.begin(), scenes.end(), [](const lab::LabScene& scene) {
      return scene.name == "quads" || scene.name == "knots";
    });
  };
  EXPECT_EQ(count({}), 0);
  EXPECT_EQ(count({"quads", "knots"}), 4);  // knots in coverage, visibility and projection
}

// facts_test.cpp compares all keys of small scenes with the committed ones.
TEST(Accuracy, DescribesMethodsAndScenes) {
  const json report = json_of("drtk_quad in_view turning-cube --quick");
  EXPECT_EQ(named(report.at("methods"), "fixed_8_int32").at("max_side_px"), 181);

  ASSERT_EQ(report.at("scenes").size(), 2u);
  const json& quad = named(report.at("scenes"), "drtk_quad");
  EXPECT_EQ(quad.at("crossings"), 36);
  EXPECT_EQ(quad.at("shared_crossings"), 6) << "crossings of the diagonal";
  EXPECT_NEAR(quad.at("largest_side_px").get<double>(), 6.0, 1e-4);
  EXPECT_EQ(quad.at("kind"), "small scenes");
  EXPECT_GT(named(quad.at("methods"), "float_le").at("source").at("errors_per_million"), 0);

  const json& cube = report.at("turning_cube");
  EXPECT_EQ(cube.at("frames"), 120);
  for (const json& method : cube.at("methods"))
    for (const char* count : {"gaps", "double_hits", "missing", "extra"})
      EXPECT_TRUE(method.at(count).contains("total")) << count << " in " << method;
  for (const json& motion : report.at("motions")) {
    EXPECT_GT(motion.at("changes"), 0) << motion.at("name");
    EXPECT_LT(named(motion.at("methods"), "double_top_left").at("superfluous").get<int>() * 8,
              named(motion.at("methods"), "fixed_8").at("superfluous"))
        << "it errs only where floats project vertices across a sample";
    EXPECT_GT(named(motion.at("methods"), "whole_pixel").at("superfluous"),
              named(motion.at("methods"), "fixed_8").at("superfluous"));
    EXPECT_GT(named(motion.at("methods"), "fixed_8").at("superfluous"), 0)
        << "snapping moves edges to and fro";
  }
}

TEST(Accuracy, CountsTheFramesOfTheChartForChoosing) {
  const json report = json_of("choice --quick --method tiled,float_lt");
  ASSERT_EQ(report.at("choices").size(), 4u);
  for (const json& choice : report.at("choices")) {
    EXPECT_EQ(choice.at("frames"), 6);
    EXPECT_EQ(choice.contains("float_projection"), choice.at("name") == "torus-knot");
    ASSERT_EQ(choice.at("methods").size(), 4u) << "tiled has three numbers of subpixel bits";
    for (const json& method : choice.at("methods")) {
      const auto count = [&](const char* key) { return method.at(key).get<std::uint64_t>(); };
      EXPECT_LE(6 * count("least"), count("wrong_pixels")) << method;
      EXPECT_LE(count("wrong_pixels"), 6 * count("most")) << method;
      EXPECT_LE(count("holes"), count("wrong_pixels")) << method;
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

TEST(Accuracy, KindsOfScenesStandApart) {
  const auto kind = [](const std::string& scene) {
    return json_of(scene + " --quick --family coverage --method float_lt").at("scenes").at(0).at("kind");
  };
  EXPECT_EQ(kind("cube"), "meshes");
  EXPECT_EQ(kind("large"), "single triangles");
  EXPECT_EQ(kind("mesh_on_grid"), "vertices on our grid");
}

TEST(Accuracy, TheZNormalTestAloneMisjudgesTheBox) {
  const json report = json_of("box_beside_the_axis");
  for (const json& method : report.at("scenes").at(0).at("methods"))
    for (const char* truth : {"snapped", "source"})
      EXPECT_EQ(method.at(truth).at("misclassified"), method.at("name") == "normal_z" ? 1 : 0) << method;
}

TEST(Accuracy, ExactMethodsScoreZeroAgainstTheSnappedTruth) {
  const json report = json_of(
      "cube cubes grid64 drtk_quad t_junction double_tie turning-cube --quick "
      "--family coverage");
  std::set<std::string> exact;
  for (const json& method : report.at("methods"))
    if (method.at("exact")) exact.insert(method.at("name"));
  EXPECT_GE(exact.size(), 3u);
  std::set<int> at_t_junction;
  for (const json& scene : report.at("scenes"))
    for (const std::string& name : exact) {
      const json& method = named(scene.at("methods"), name);
      EXPECT_EQ(method.at("snapped").at("errors"), 0) << scene.at("name") << ' ' << name;
      if (testing::find_coverage_method(name).contract_depth) {
        EXPECT_EQ(method.at("snapped").at("wrong_pixels"), 0) << scene.at("name") << ' ' << name;
      }
      const json& cracks = method.at("cracks");
      EXPECT_EQ(cracks.at("gaps"), 0) << scene.at("name") << ' ' << name;
      EXPECT_EQ(cracks.at("double_hits"), 0) << scene.at("name") << ' ' << name;
      if (scene.at("name") == "t_junction") at_t_junction.insert(cracks.at("t_junctions").get<int>());
    }
  EXPECT_EQ(at_t_junction.size(), 1u);
  EXPECT_GT(*at_t_junction.begin(), 0);
  for (const std::string& name : exact) {
    const json& counts = named(report.at("turning_cube").at("methods"), name);
    EXPECT_GT(counts.at("missing").at("total"), 0) << name << ": snapping moves the outline";
    EXPECT_EQ(counts.at("gaps").at("total"), 0) << name << ": snapping opens no crack";
  }
}

TEST(Accuracy, MeasuresPeersInPlaceOfTheMethods) {
  EXPECT_NE(accuracy("cube --peers").err.find("--peers measures the scene 'choice' only"), std::string::npos);
  const lab::StartedPeers started = lab::start_peers(lab::peers());
  const Outcome outcome = accuracy("--peers --quick --json -");
  if (started.peers.empty()) {
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(lab::peers().empty() ? "--peers: there is none" : "--peers: none starts: "),
              std::string::npos)
        << outcome.err;
    return;
  }
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const std::string& reason : started.left_out)
    EXPECT_NE(outcome.err.find("left out: " + reason), std::string::npos) << outcome.err;
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

TEST(Accuracy, TablesFitEightyColumns) {
  AccuracyPlan plan;
  plan.scenes = {"cube",    "drtk_quad",        "lattice_square", "planes_1e-5_apart",
                 "edge_on", "floor_behind_eye", "turning-cube"};
  plan.quick = true;
  std::string text = accuracy_tables(measure_accuracy(plan));
  EXPECT_NE(text.find("0 (<"), std::string::npos);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    EXPECT_LE(end, 80u) << text.substr(0, end);
    text.erase(0, end + 1);
  }
}

TEST(Accuracy, BackFacesOfMeshesAreCulledByTheExactSign) {
  const lab::Size size{200, 150};
  const lab::CoverageScene scene = lab::coverage_scene(find_scene("cube").make({size.width, size.height}),
                                                       {size.width, size.height, Cull::back, false});
  ASSERT_EQ(scene.floats.size(), scene.snapped.size());
  EXPECT_EQ(scene.floats.size(), 6u);
  for (const lab::FloatTriangle& triangle : scene.floats) EXPECT_EQ(lab::FloatTruth(triangle.at).facing(), 1);
}

}  // namespace
}  // namespace edgewise::tools
