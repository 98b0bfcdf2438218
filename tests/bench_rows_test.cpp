// The benchmark's rows: told apart by name, and never timed when they draw other pixels.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "message_of.h"
#include "stage.h"
#include "suite.h"
#include "temp_dir.h"

namespace edgewise::bench {
namespace {

class DrawsNothing : public Backend {
  void draw_checked(std::span<const ScreenTriangle>, FrameView, std::uint32_t, const Execution&) override {}
};

Row row_of(const BackendInfo& backend, const std::shared_ptr<Workload>& workload) {
  Row row;
  row.name = backend.name;
  row.workload = workload;
  row.backend = &backend;
  return row;
}

TEST(BenchStage, FindsABackendThatLeavesTheFrameAsItWas) {
  const auto workload = std::make_shared<Workload>(96, 64, Cull::back, [] {
    return app::load_source("cube", {96, 64, 0.0f, 1.0}, false);
  });
  workload->prepare(false);
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

TEST(BenchSuite, NamesRowsSoThatTheirPartsCanBeTold) {
  const TempDir folder;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string odd = folder.write("threads:1\x1b\xff.obj", mesh).string();
  std::set<std::string> names;
  for (const Row& row : make_suite(only({odd}))) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_NE(row.name.find("/threads_1\?\?/threads:"), std::string::npos) << row.name;
  }
  EXPECT_EQ(names.size(), 2 + 4 * backends().size() + 2 * peers().size());
}

TEST(BenchSuite, NamesAllRowsDifferently) {
  std::set<std::string> names;
  for (const Row& row : make_suite({})) EXPECT_TRUE(names.insert(row.name).second) << row.name;
}

}  // namespace
}  // namespace edgewise::bench
