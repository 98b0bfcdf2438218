// Records a frame's tasks, and estimates their time on more cores.
#include "bench/models/scaling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <thread>

#include "bench/workloads/stage.h"
#include "spin.h"
#include "support.h"

namespace edgewise::bench {
namespace {

using Tasks = std::vector<double>;

TEST(FrameWork, AssignsTasksToTheCoreThatIsFreeFirst) {
  const FrameWork frame{{{"a", 1.0, Tasks{4, 3, 2, 2, 1}}, {"b", 0.5, Tasks{2, 2, 2}}}, 0.25};
  EXPECT_DOUBLE_EQ(frame.work_s(), 1 + 12 + 0.5 + 6 + 0.25);
  EXPECT_DOUBLE_EQ(frame.path_s(), 1 + 4 + 0.5 + 2 + 0.25);
  EXPECT_DOUBLE_EQ(frame.time_s(1, 9.0), frame.work_s());
  // In section a, one core runs tasks 4 and 2, the other 3, 2 and 1.
  EXPECT_DOUBLE_EQ(frame.time_s(2, 0.0), 1 + 6 + 0.5 + 4 + 0.25);
  EXPECT_DOUBLE_EQ(frame.time_s(100, 0.0), frame.path_s());
  EXPECT_DOUBLE_EQ(frame.time_s(100, 3.0), frame.path_s() + 2 * 3.0);
}

TEST(FrameWork, StaysWithinGrahamsBounds) {
  Random random(5);
  FrameWork frame{{{"a", 0.0, {}}}, 0.0};
  for (int i = 0; i < 500; ++i) frame.sections[0].tasks_s.push_back(random.uniform(0.0f, 1.0f));
  for (const int cores : {1, 2, 3, 4, 8, 64, 499, 500, 1000}) {
    const double time_s = frame.time_s(cores, 0.0), average_s = frame.work_s() / cores;
    EXPECT_GE(time_s, std::max(average_s, frame.path_s()) - 1e-9) << cores;
    EXPECT_LE(time_s, average_s + frame.path_s() + 1e-9) << cores;
  }
}

TEST(FrameWork, NamesTheLongestPartOfItsPath) {
  // Each of a's two sections has a shorter longest task than b, but their sum is longer.
  FrameWork frame{{{"a", 1, Tasks{2, 2}}, {"b", 1, Tasks{3}}, {"a", 1, Tasks{2}}}, 0.5};
  EXPECT_EQ(frame.longest_part().name, "the longest task of a");
  EXPECT_DOUBLE_EQ(frame.longest_part().time_s, 4.0);
  frame.sections[1].before_s = 5;
  EXPECT_EQ(frame.longest_part().name, "serial code before b");
  frame.after_s = 6;
  EXPECT_EQ(frame.longest_part().name, "serial code after the last section");
}

TEST(FrameWork, TakesMinimaUnlessTheTasksDiffer) {
  FrameWork frame{{{"a", 2, Tasks{1, 5}}}, 1};
  frame.take_minima({{{"a", 1, Tasks{2, 3}}}, 4});
  EXPECT_DOUBLE_EQ(frame.work_s(), 1 + 1 + 3 + 1);
  frame.take_minima({{{"a", 1, Tasks{9, 9, 9}}}, 4});
  EXPECT_EQ(frame.sections[0].tasks_s, (Tasks{9, 9, 9}));
}

TEST(SectionName, IsTheFunctionAndItsFile) {
  EXPECT_EQ(section_name({"build", "/x/raster/binning/bins.cpp"}), "build in bins.cpp");
  EXPECT_EQ(section_name({"make", "make.h"}), "make in make.h");
}

TEST(FrameRecorder, RecordsTasksInOrderOnOneThread) {
  FrameRecorder recorder;
  std::vector<int> order;
  std::set<std::thread::id> threads;
  {
    const ObserveParallel scope(recorder);
    parallel_for(8, 5, [&](int i) {
      order.push_back(i);
      threads.insert(std::this_thread::get_id());
    });
    parallel_for(8, 2, [](int) {
      piece_done();
      piece_done();
    });
  }
  parallel_for(1, 3, [](int) {});  // no longer observed
  const FrameWork frame = recorder.finish();
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
  ASSERT_EQ(frame.sections.size(), 2u);
  EXPECT_EQ(frame.sections[0].tasks_s.size(), 5u);
  EXPECT_EQ(frame.sections[0].name, "TestBody in scaling_test.cpp");
  EXPECT_EQ(frame.sections[1].tasks_s.size(), 6u) << "two pieces and the rest, for each of two tasks";
}

TEST(ParallelInChunks, CallsEachIndexOnce) {
  for (const int threads : {1, 2, 8})
    for (const int count : {0, 1, 63, 64, 65, 129, 1000}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count));
      parallel_in_chunks(threads, count, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
      EXPECT_TRUE(std::ranges::all_of(calls, [](const auto& n) { return n == 1; })) << count;
    }
}

TEST(ParallelInChunks, MakesAChunkOneTask) {
  FrameRecorder recorder;
  {
    const ObserveParallel scope(recorder);
    parallel_in_chunks(2, 130, [](int) {});
    parallel_in_chunks(2, 32, [](int) {});
  }
  const FrameWork frame = recorder.finish();
  EXPECT_EQ(frame.sections[0].tasks_s.size(), 33u) << "chunks of four";
  EXPECT_EQ(frame.sections[1].tasks_s.size(), 32u) << "too few for chunks of several calls";
}

TEST(FrameRecorder, FindsTheLongestTask) {
  FrameRecorder recorder;
  {
    const ObserveParallel scope(recorder);
    parallel_for(4, 3, [&](int i) { spin(i == 1 ? 0.02 : 0.0); });
  }
  const FrameWork frame = recorder.finish();
  EXPECT_EQ(frame.longest_part().name, "the longest task of TestBody in scaling_test.cpp");
  EXPECT_GT(frame.sections[0].tasks_s[1], 10 * (frame.sections[0].tasks_s[0] + frame.sections[0].tasks_s[2]));
}

// Counts the tasks of each parallel section.
class Counter final : public ParallelObserver {
 public:
  void section_begins(const CallSite&) override { tasks.push_back(0); }
  void task_ends() override { ++tasks.back(); }
  void section_ends() override {}
  std::vector<int> tasks;
};

class ObservedBackend : public ::testing::TestWithParam<std::string_view> {};

TEST_P(ObservedBackend, DrawsTheSameBitsAndSplitsItsWork) {
  const auto triangles = testing::adversarial("cloud", 20'000, 200, 150, 3);
  const auto backend = testing::find_drawer(GetParam()).make();
  Framebuffer expected(200, 150), actual(200, 150);
  backend->draw(triangles, expected.view(), 0, {});
  for (const int threads : {1, 2, 64}) {
    Counter counter;
    {
      const ObserveParallel scope(counter);
      backend->draw(triangles, actual.view(), 0, {.threads = threads});
    }
    testing::expect_same(expected, actual, std::to_string(threads) + " threads");
    if (threads == 1) continue;
    ASSERT_GE(counter.tasks.size(), GetParam() == wireframe().name ? 1u : 2u) << "binning, and drawing";
    for (const int tasks : counter.tasks) EXPECT_GT(tasks, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ObservedBackend, ::testing::ValuesIn(testing::all_drawers()),
                         [](const auto& param) { return testing::test_name(param); });

TEST(BenchStage, RecordsTheTasksOfScheduledRows) {
  const auto workload = std::make_shared<Workload>(640, 480, Cull::back, [] {
    return tools::load_source("torus-knot", {640, 480, 0.0f, 1.0}, false);
  });
  workload->prepare(true);
  Row row;
  row.workload = workload;
  row.timed = Timed::frame;
  row.backend = &find_backend("tiled");
  row.cores = row.execution.threads = 4;
  Stage stage;
  stage.compare(row);
  EXPECT_EQ(row.error, "");
  EXPECT_GE(row.recorded.sections.size(), 4u) << "front end and backend";
  EXPECT_GT(row.once_s, 0.0);
  EXPECT_LE(row.recorded.path_s(), row.recorded.work_s());
}

}  // namespace
}  // namespace edgewise::bench
