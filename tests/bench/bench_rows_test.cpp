// The benchmark's rows have different names, and rows that draw wrong pixels are never timed.
#include <gtest/gtest.h>

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

constexpr const char* kMesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(BenchSuite, NamesAllRowsDifferentlyAndDrawsThemWithTheSubpixelBits) {
  const TempDir folder;
  SuiteOptions options;
  options.subpixel_bits = 13;
  options.threads = {1, 2, 5};
  options.more_scenes = {folder.write("threads:1\x1b\xff.obj", kMesh).string()};
  std::set<std::string> names;
  for (const Row& row : make_suite(options)) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(row.name.find('\x1b'), std::string::npos) << row.name;
    if (row.workload) {
      EXPECT_EQ(row.workload->frontend_options().subpixel_bits, 13) << row.name;
    }
  }
  for (const SceneInfo& scene : builtin_scenes())
    for (const SimdTarget target : supported_targets()) {
      const bool narrower = target != SimdTarget::scalar && target != resolve(SimdTarget::best);
      EXPECT_EQ(names.contains("tiled+frontend/" + std::string(scene.name) +
                               "/target:" + std::string(name_of(target)) + "/threads:1"),
                narrower);
    }
}

TEST(BenchSuite, TimesWholeFramesOfAFewScenesInAQuickRun) {
  const TempDir folder;
  SuiteOptions options;
  options.quick = true;
  options.more_scenes = {folder.write("mine.obj", kMesh).string()};
  std::set<std::string> scenes;
  for (const Row& row : make_suite(options)) {
    EXPECT_FALSE(row.name.starts_with("lab/")) << "the main chart has rows of its own";
    if (is_choice(row) || is_cell(row)) continue;
    EXPECT_NE(row.timed, Timed::raster) << row.name;
    const std::size_t begin = row.name.find('/') + 1;
    scenes.insert(row.name.substr(begin, row.name.find('/', begin) - begin));
  }
  EXPECT_TRUE(scenes.contains("mine"));
  EXPECT_LT(scenes.size(), builtin_scenes().size());
}

TEST(BenchSuite, RefusesTwoSourcesOfOneName) {
  const TempDir a, b;
  const std::string first = a.write("x.obj", kMesh), second = b.write("x.obj", kMesh);
  const std::string clash = b.write("a_b.obj", kMesh), colon = a.write("a:b.obj", kMesh);
  EXPECT_EQ(message_of([&] {
              make_suite(only({first, second}));
            }),
            "--scene " + first + " and --scene " + second + " would both be named 'x'");
  EXPECT_NE(message_of([&] { make_suite(only({"cube", "cube"})); }), "");
  EXPECT_NE(message_of([&] { make_suite(only({clash, colon})); }), "");
}

// The engine with numbers that are not exact may err, but in few pixels.
TEST(BenchSuite, TimesCellsAndEnginesThatDrawTheReference) {
  SuiteOptions options;
  options.scale = 0.1;
  options.width = 160, options.height = 90;
  Stage stage;
  std::size_t compared_cells = 0, compared_engines = 0;
  for (Row& row : make_suite(options)) {
    const bool engine = row.name.find("/engine:") != std::string::npos;
    if (!is_cell(row) && !engine) continue;
    ++(engine ? compared_engines : compared_cells);
    row.workload->prepare(true);
    stage.compare(row);
    EXPECT_EQ(row.error, "") << row.name;
    const bool may_err =
        row.name.find(":float") != std::string::npos || row.name.find(":int32") != std::string::npos;
    EXPECT_TRUE(may_err || row.wrong_px.value_or(0) == 0) << row.name;
    if (row.name.find(":float") != std::string::npos) {
      EXPECT_LT(row.wrong_px.value_or(0), 160u * 90 / 100) << row.name;
    }
  }
  EXPECT_GE(compared_cells, builtin_scenes().size() * cells().size());
  EXPECT_GT(compared_engines, 6u);
}

// Scalar and SIMD, on one thread and on two, where a method has these.
TEST(BenchMethods, AreTimedInEachForm) {
  const TempDir folder;
  SuiteOptions options = only({folder.write("mine.obj", kMesh).string()});
  options.methods = true;
  std::map<std::string, int> forms;
  Stage stage;
  for (Row& row : make_suite(options)) {
    if (!row.name.starts_with("lab/")) continue;
    const auto method = row.name.find("method:");
    ++forms[row.name.substr(method + 7, row.name.find('/', method) - method - 7)];
    stage.compare(row);
    EXPECT_EQ(row.error, "") << row.name;
    EXPECT_GT(row.once_s, 0.0) << row.name;
  }
  const bool has_simd = resolve(SimdTarget::best) != SimdTarget::scalar;
  for (const lab::CoverageMethod& method : lab::coverage_methods())
    EXPECT_EQ(forms[std::string(method.info.name)],
              (method.simd && has_simd ? 2 : 1) * (method.threaded ? 2 : 1))
        << method.info.name;
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
  int compared = 0;
  for (Row& row : make_suite(options)) {
    if (!is_choice(row) || row.peer != nullptr || row.name.starts_with("choice/sliver/")) continue;
    stage.compare(row);
    EXPECT_EQ(row.error, "") << row.name;
    ++compared;
  }
  EXPECT_GT(compared, 3);
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
