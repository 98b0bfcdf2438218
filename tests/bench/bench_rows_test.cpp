// The benchmark's rows have different names, and rows that draw wrong pixels are never timed.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "bench/suite.h"
#include "bench/workloads/laboratory.h"
#include "bench/workloads/stage.h"
#include "message_of.h"
#include "run_program.h"
#include "support/options.h"
#include "temp_dir.h"

namespace edgewise::bench {
namespace {

class DrawsNothing : public Backend {
  void draw_checked(std::span<const ScreenTriangle>, const FramePart&, const Execution&) override {}
};

Row row_of(const BackendInfo& backend, const std::shared_ptr<Workload>& workload) {
  Row row;
  row.name = backend.name;
  row.workload = workload;
  row.backend = &backend;
  return row;
}

std::shared_ptr<Workload> cube() {
  auto workload = std::make_shared<Workload>(96, 64, Cull::back, [] {
    return tools::load_source("cube", {96, 64, 0.0f, 1.0}, false);
  });
  workload->prepare(false);
  return workload;
}

TEST(BenchStage, FindsABackendThatDrawsNothing) {
  const auto workload = cube();
  const BackendInfo lazy{"lazy", "draws nothing",
                         [] { return std::unique_ptr<Backend>(std::make_unique<DrawsNothing>()); }};
  Stage stage;
  Row right = row_of(backends()[0], workload), wrong = row_of(lazy, workload);
  stage.compare(right);
  stage.compare(wrong);
  EXPECT_EQ(right.error, "");
  EXPECT_NE(wrong.error.find(std::to_string(96 * 64) + " pixels differ"), std::string::npos) << wrong.error;
}

SuiteOptions only(std::vector<std::string> scenes) {
  SuiteOptions options;
  options.width = options.height = 32;
  options.scenes = std::move(scenes);
  return options;
}

TEST(BenchSuite, DrawsAllScenesWithTheSubpixelBits) {
  SuiteOptions options;
  options.subpixel_bits = 13;
  for (const Row& row : make_suite(options)) {
    if (row.workload) {
      EXPECT_EQ(row.workload->frontend_options().subpixel_bits, 13) << row.name;
    }
  }
}

TEST(BenchSuite, RefusesTwoSourcesOfOneName) {
  const TempDir a, b;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string first = a.write("x.obj", mesh).string(), second = b.write("x.obj", mesh).string();
  const std::string clash = b.write("a_b.obj", mesh).string(), colon = a.write("a:b.obj", mesh).string();
  EXPECT_EQ(message_of([&] {
              make_suite(only({first, second}));
            }),
            "--scene " + first + " and --scene " + second + " would both be named 'x'");
  EXPECT_NE(message_of([&] { make_suite(only({"cube", "cube"})); }), "");
  EXPECT_NE(message_of([&] { make_suite(only({clash, colon})); }), "");
}

TEST(BenchSuite, HasTwelveCells) {
  EXPECT_EQ(cells().size(), 12u);
  EXPECT_EQ(cells()[4].factors, "traversal:tiles/fill:spans/simd:scalar");
  EXPECT_EQ(cells()[4].backend->name, "tiles+spans");
  EXPECT_TRUE(cells().back().factors.ends_with("/with:hiz+masks")) << cells().back().factors;
}

TEST(BenchSuite, RowNamesCanBeSplitIntoTheirParts) {
  const TempDir folder;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string odd = folder.write("threads:1\x1b\xff.obj", mesh).string();
  std::set<std::string> names;
  SuiteOptions options = only({odd});
  options.threads = {1, 2, 5};
  for (const Row& row : make_suite(options)) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_NE(row.name.find("/threads_1\?\?/"), std::string::npos) << row.name;
  }
  const auto targets = supported_targets();
  const auto narrower = std::count_if(targets.begin(), targets.end(), [](SimdTarget target) {
    return target != SimdTarget::scalar && target != resolve(SimdTarget::best);
  });
  int of_peers = 0;
  for (const lab::PeerInfo& peer : lab::benchmark_peers()) of_peers += peer.most_threads + peer.own_clock;
  EXPECT_EQ(names.size(), 3 + 6 * backends().size() + static_cast<std::size_t>(of_peers + 2 * narrower) +
                              12 * (tools::default_threads() > 1 ? 2 : 1));
}

TEST(BenchStage, ComparesWireframesWithWireframes) {
  const auto workload = cube();
  Stage stage;
  for (const BackendInfo& backend : backends()) {
    Row row = row_of(backend, workload);
    row.execution.threads = 3;
    stage.compare(row);
    EXPECT_EQ(row.error, "") << backend.name;
  }
}

TEST(BenchSuite, NamesAllRowsDifferently) {
  std::set<std::string> names;
  for (const Row& row : make_suite({})) EXPECT_TRUE(names.insert(row.name).second) << row.name;
}

// With or without peers. There are no rows for the scalar target. The best target's row is the scene's own.
TEST(BenchSuite, TimesWholeFramesOfOursWithEachNarrowerTarget) {
  std::map<std::string, int> count;
  for (const Row& row : make_suite({})) ++count[row.name];
  for (const SceneInfo& scene : builtin_scenes())
    for (const SimdTarget target : supported_targets())
      for (const std::string threads : {"1", "2"}) {
        const bool wanted = target != SimdTarget::scalar && target != resolve(SimdTarget::best);
        const std::string name = "tiled+frontend/" + std::string(scene.name) +
                                 "/target:" + std::string(name_of(target)) + "/threads:" + threads;
        EXPECT_EQ(count[name], wanted ? 1 : 0) << name;
      }
}

// The suite's rows by name, with a tenth of the triangles of each scalable scene.
std::map<std::string, Row> small_rows(int width, int height) {
  SuiteOptions options;
  options.scale = 0.1;
  options.width = width, options.height = height;
  std::map<std::string, Row> rows;
  for (Row& row : make_suite(options)) rows.emplace(row.name, std::move(row));
  return rows;
}

TEST(BenchSuite, TimesFramesOfFourScenesAndCoverageMethodsInAQuickRun) {
  SuiteOptions options;
  options.quick = true;
  const TempDir folder;
  options.more_scenes = {folder.write("mine.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string()};
  std::set<std::string> scenes;
  for (const Row& row : make_suite(options)) {
    if (row.prepare || is_choice(row)) continue;
    EXPECT_TRUE(is_cell(row) || std::count(row.name.begin(), row.name.end(), '/') == 2) << row.name;
    EXPECT_NE(row.timed, Timed::raster) << row.name;
    scenes.insert(row.name.substr(row.name.find('/') + 1, row.name.rfind('/') - row.name.find('/') - 1));
  }
  std::erase_if(scenes, [](const std::string& scene) { return scene.find('/') != std::string::npos; });
  EXPECT_EQ(scenes, (std::set<std::string>{"cubes", "grid4", "large", "mine", "torus-knot"}));
}

TEST(BenchSuite, TimesTheEngineWithOtherNumbers) {
  std::map<std::string, Row> rows = small_rows(480, 270);
  Stage stage;
  const auto wrong_px = [&](const std::string& scene, const std::string& run) {
    Row& row = rows.at("tiled/" + scene + "/engine:" + run + "/threads:1");
    row.workload->prepare(true);
    stage.compare(row);
    EXPECT_EQ(row.error, "") << row.name;
    return row.wrong_px;
  };
  for (const std::string scene : {"large", "medium", "small", "grid64"}) {
    EXPECT_FALSE(wrong_px(scene, "exact").has_value());
    for (const std::string run : {"int64", "double"})
      EXPECT_EQ(wrong_px(scene, run), 0u) << scene << ' ' << run;
    for (const std::string run : {"float", "float_rebased"})
      EXPECT_LT(wrong_px(scene, run).value(), 480u * 270 / 100) << scene << ' ' << run;
  }
  EXPECT_GT(wrong_px("small", "float").value(), 0u);
  EXPECT_GT(wrong_px("large", "int32").value(), 0u);
}

TEST(BenchSuite, TimesCellsThatDrawTheReference) {
  std::map<std::string, Row> rows = small_rows(160, 90);
  Stage stage;
  for (const SceneInfo& scene : builtin_scenes())
    for (const Cell& cell : cells())
      for (const int threads : {1, tools::default_threads()}) {
        const auto row = rows.find("cell/" + std::string(scene.name) + "/" + cell.factors +
                                   "/threads:" + std::to_string(threads));
        ASSERT_NE(row, rows.end()) << scene.name << ", " << cell.factors;
        EXPECT_FALSE(is_plain(row->second)) << row->first;
        row->second.workload->prepare(true);
        stage.compare(row->second);
        EXPECT_EQ(row->second.error, "") << row->first;
      }
}

std::map<std::string, Row> timed_methods(const SuiteOptions& options) {
  std::map<std::string, Row> rows;
  for (Row& row : make_suite(options))
    if (row.name.starts_with("lab/")) rows.emplace(row.name, std::move(row));
  return rows;
}

// Scalar and SIMD, on one thread and on two, where a method has these.
TEST(BenchMethods, AreTimedInEachForm) {
  const TempDir folder;
  SuiteOptions options = only({folder.write("mine.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string()});
  EXPECT_TRUE(timed_methods(options).empty());
  options.methods = true;
  std::set<std::string> expected, found;
  const std::string best(name_of(resolve(SimdTarget::best)));
  for (const lab::CoverageMethod& method : lab::coverage_methods())
    for (const std::string& simd : {std::string("scalar"), method.simd ? best : "scalar"})
      for (int threads = 1; threads <= (method.threaded ? 2 : 1); ++threads)
        expected.insert("lab/mine/family:coverage/method:" + std::string(method.info.name) + "/simd:" + simd +
                        "/threads:" + std::to_string(threads));
  Stage stage;
  for (auto& [name, row] : timed_methods(options)) {
    found.insert(name);
    stage.compare(row);
    EXPECT_EQ(row.error, "") << name;
    EXPECT_GT(row.once_s, 0.0) << name;
  }
  EXPECT_EQ(found, expected);
}

TEST(BenchMethods, AreTimedOnThreeScenes) {
  const auto scenes = [](bool quick) {
    SuiteOptions options;
    options.quick = quick;
    std::set<std::string> found;
    for (const auto& [name, row] : timed_methods(options))
      found.insert(name.substr(4, name.find('/', 4) - 4));
    return found;
  };
  EXPECT_EQ(scenes(false), (std::set<std::string>{"mesh", "mesh_on_grid", "torus-knot"}));
  EXPECT_TRUE(scenes(true).empty()) << "the main chart has rows of its own";
}

TEST(BenchMethods, AreNotTimedWhereAFormDrawsOtherPixels) {
  const lab::CoverageMethod wrong{.info = {"wrong", "", "", "", false},
                                  .promise = {},
                                  .draw =
                                      [](const auto&, lab::Canvas& canvas, const Execution& how) {
                                        if (how.threads == 1) canvas.depth[0] = 1.0f;  // else nothing
                                      },
                                  .runs = {}};
  const auto scene =
      std::make_shared<MethodScene>(MethodScene{lab::LabScene{lab::Family::coverage, "empty", true, [] {
                                                                return lab::CoverageScene{{8, 8}, {}, {}};
                                                              }}});
  const auto error = [&](int threads) {
    Row row = method_row(scene, wrong, {.threads = threads, .target = SimdTarget::scalar});
    Stage().compare(row);
    return row.error;
  };
  EXPECT_EQ(error(1), "");
  EXPECT_EQ(error(2), "draws other pixels than its scalar form on one thread");
}

TEST(BenchChoices, AreTheMethodsOfTheChartInEachOfItsScenes) {
  SuiteOptions options;
  options.quick = true;
  Stage stage;
  std::map<std::string, int> count;
  for (Row& row : make_suite(options)) {
    if (!is_choice(row)) continue;
    const std::string scene = row.name.substr(7, row.name.find('/', 7) - 7);
    if (row.peer == nullptr) ++count[scene];
    if (row.peer != nullptr || scene == "sliver") continue;
    stage.compare(row);
    EXPECT_EQ(row.error, "") << row.name;
  }
  EXPECT_EQ(count,
            (std::map<std::string, int>{{"torus-knot", 8}, {"quads", 8}, {"large", 8}, {"sliver", 8}}));
}

TEST(BenchPipelines, AreTimedBesideTheExactOne) {
  const TempDir folder;
  SuiteOptions options;
  options.needs = folder
                      .write("needs.json", R"([{"scene": "cubes", "width": 96, "height": 54, "scale": 1,
      "tolerance_px": 9, "minima": [{"visibility": "painter_mean"}, {"facing test": "float_area"}]},
      {"scene": "cube", "width": 96, "height": 54, "scale": 1, "tolerance_px": 0, "minima": []}])")
                      .string();
  Stage stage;
  std::map<std::string, std::string> errors;
  for (Row& row : make_suite(options))
    if (row.name.starts_with("needs/")) stage.compare(row), errors[row.name] = row.error;
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_EQ(errors.at("needs/cubes/pipeline:exact/threads:1"), "");
  EXPECT_EQ(errors.at("needs/cubes/pipeline:2/threads:1"), "");
  EXPECT_NE(errors.at("needs/cubes/pipeline:1/threads:1").find("pixels differ from the exact picture"),
            std::string::npos);
}

TEST(BenchProgram, RepeatsAllRowsEquallyOften) {
  const TempDir folder;
  const std::string out = (folder.path() / "out.json").string();
  const auto outcome = testing::run_program(
      EDGEWISE_BENCH,
      "--no-peers --benchmark_out=" + out +
          " '--benchmark_filter=^(tiled/cube|lab/mesh_on_grid/.*float_lt/simd:scalar)/threads:1$'");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::map<std::string, int> times;
  const auto json = nlohmann::json::parse(file_content(out));
  for (const auto& entry : json["benchmarks"])
    if (entry["run_type"] == "iteration") ++times[entry["name"]];
  EXPECT_EQ(times.size(), 2u);
  for (const auto& [name, count] : times) EXPECT_EQ(count, 9) << name;
}

}  // namespace
}  // namespace edgewise::bench
