// Divides the time of two threads into waits and the rest.
#include "bench/models/second_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <vector>

#include "bench/models/model.h"
#include "bench/suite.h"
#include "bench/workloads/stage.h"
#include "edgewise/builtin.h"
#include "frontend/in_order.h"
#include "spin.h"

namespace edgewise::bench {
namespace {

double fake_now_s = 0;
double fake_clock_s() {
  return fake_now_s;
}

TEST(WaitTimer, DividesTheTimeOfBothThreads) {
  fake_now_s = 100;
  WaitTimer timer(fake_clock_s);
  const auto at = [](double now_s) { fake_now_s = 100 + now_s; };
  at(2), timer.section_begins();
  at(2.25), timer.task_begins(0);
  at(3), timer.task_begins(1);  // 1 after the section's start
  at(4), timer.task_ends(0);
  at(4.5), timer.task_begins(0);
  at(5), timer.wait_begins(1);
  at(7), timer.wait_ends(1);
  at(8), timer.task_ends(1);
  at(12), timer.task_ends(0);
  at(12.5), timer.section_ends();
  at(15.5);
  const Waits waits = timer.finish();
  EXPECT_DOUBLE_EQ(waits.serial_s, 2 + 3);
  EXPECT_DOUBLE_EQ(waits.start_s, 0.25 + 1);
  EXPECT_DOUBLE_EQ(waits.between_s, 0.5);
  EXPECT_DOUBLE_EQ(waits.turn_s, 2);
  EXPECT_DOUBLE_EQ(waits.end_s, 0.5 + 4.5);
}

TEST(WaitTimer, StartsAnewInEachSection) {
  fake_now_s = 0;
  WaitTimer timer(fake_clock_s);
  for (const double start_s : {1.0, 11.0}) {
    fake_now_s = start_s, timer.section_begins();
    fake_now_s = start_s + 1, timer.task_begins(0);
    fake_now_s = start_s + 7, timer.task_ends(0);
    fake_now_s = start_s + 9, timer.section_ends();  // before the second thread had a task
  }
  const Waits waits = timer.finish();
  EXPECT_DOUBLE_EQ(waits.serial_s, 1 + 1);
  EXPECT_DOUBLE_EQ(waits.start_s, 2 * (1 + 9));
  EXPECT_DOUBLE_EQ(waits.between_s, 0);
  EXPECT_DOUBLE_EQ(waits.end_s, 2 * 2);
}

// Whether a measurement succeeds in one of a few attempts: the machine may suspend a thread at any time.
bool succeeds(const std::function<bool()>& attempt) {
  for (int i = 0; i < 10; ++i)
    if (attempt()) return true;
  return false;
}

TEST(SecondThread, FindsSerialCodeAndALongLastTask) {
  EXPECT_TRUE(succeeds([] {
    const auto [one_s, two_s, waits] = time_round(
        [](int threads) {
          spin(2e-3);
          parallel_for(threads, 2, [](int i) { spin(i == 0 ? 0.0 : 4e-3); });
        },
        false, true);
    EXPECT_GE(one_s, 6e-3);
    EXPECT_GE(two_s, 6e-3);
    EXPECT_GE(waits.serial_s, 2e-3);
    EXPECT_EQ(waits.turn_s, 0.0);
    EXPECT_LE(waits.serial_s + waits.start_s + waits.between_s + waits.end_s, 2 * two_s);
    return waits.start_s + waits.between_s + waits.end_s >= 3.9e-3;  // one thread has no more to do
  }));
}

TEST(SecondThread, DrawsShortFramesTwiceAndInEitherOrder) {
  const auto drawn = [](bool is_short, bool two_first) {
    std::vector<int> threads;
    time_round([&](int n) { threads.push_back(n); }, is_short, two_first);
    return threads;
  };
  EXPECT_EQ(drawn(true, true), (std::vector{2, 2, 1, 1}));
  EXPECT_EQ(drawn(true, false), (std::vector{1, 1, 2, 2}));
  EXPECT_EQ(drawn(false, true), (std::vector{2, 1}));
}

// Chunk 0 ends last, so the thread of chunk 1 waits for its turn.
TEST(SecondThread, FindsWaitsForTheTurnInTheFrontEnd) {
  EXPECT_TRUE(succeeds([] {
    InOrder order;
    order.start_frame(2, false);
    WaitTimer timer;
    {
      const TimeParallel scope(timer);
      std::atomic<bool> later_made{false};
      order.for_each_chunk(
          2, kWorthThreads,
          [&](std::size_t chunk, ChunkOutput&) {
            if (chunk == 1) later_made = true;
            const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
            while (!later_made && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
            if (chunk == 0) spin(5e-3);
          },
          [](const ChunkOutput&, std::size_t) {});
    }
    return timer.finish().turn_s >= 4e-3;
  }));
}

TEST(BenchSuite, DividesTheFramesOfTiledOnTwoThreads) {
  std::set<std::string> expected, found;
  for (const SceneInfo& scene : builtin_scenes())
    expected.insert("tiled+frontend/" + std::string(scene.name) + "/threads:2");
  for (const Row& row : make_suite({}))
    if (row.wants_second_thread) found.insert(row.name);
  EXPECT_EQ(found, expected);
}

TEST(BenchStage, AddsARoundOnlyIfRequestedAndEstimating) {
  const auto workload = std::make_shared<Workload>(480, 270, Cull::back, [] {
    return tools::load_source("torus-knot", {480, 270, 0.0f, 1.0}, false);
  });
  workload->prepare(true);
  const auto rounds = [&](bool requested, bool estimates, double once_s) {
    Row row;
    row.workload = workload;
    row.timed = Timed::frame;
    row.backend = &find_backend("tiled");
    row.execution.threads = 2;
    row.wants_second_thread = requested;
    row.once_s = once_s;
    Stage stage(estimates);
    stage.add_round(row);
    stage.add_round(row);
    return row.second_thread;
  };
  EXPECT_TRUE(rounds(false, true, 1e-3).empty());
  EXPECT_TRUE(rounds(true, false, 1e-3).empty());
  EXPECT_TRUE(rounds(true, true, 1.0).empty()) << "too long";
  const auto found = rounds(true, true, 1e-3);
  ASSERT_EQ(found.size(), 2u);
  for (const auto& [one_s, two_s, waits] : found) {
    EXPECT_GT(one_s, 0.0);
    EXPECT_GT(waits.serial_s, 0.0);
    EXPECT_GT(waits.start_s, 0.0);
    EXPECT_GT(waits.between_s, 0.0);
    EXPECT_LT(waits.serial_s + waits.start_s + waits.between_s + waits.turn_s + waits.end_s, 2 * two_s);
  }
}

TEST(BenchModel, WritesTheWaitsOfEachRound) {
  std::vector<Row> rows(2);
  rows[0].name = "tiled+frontend/x/threads:2";
  rows[0].second_thread = {{3e-3, 2e-3, {.serial_s = 1e-3, .end_s = 0.5e-3}},
                           {4e-3, 2.5e-3, {.turn_s = 1e-6}}};
  const auto model = nlohmann::json::parse(model_json(rows, 0.0));
  ASSERT_EQ(model["second_thread"].size(), 1u);
  const auto& waits = model["second_thread"][0];
  EXPECT_EQ(waits["name"], "tiled+frontend/x/threads:2");
  const auto figures = [&](const char* key) { return waits[key].get<std::vector<double>>(); };
  using Figures = std::vector<double>;
  EXPECT_EQ(figures("one_ms"), (Figures{3, 4}));
  EXPECT_EQ(figures("two_ms"), (Figures{2, 2.5}));
  EXPECT_EQ(figures("serial_ms"), (Figures{1, 0}));
  EXPECT_EQ(figures("start_ms"), (Figures{0, 0}));
  EXPECT_EQ(figures("between_ms"), (Figures{0, 0}));
  EXPECT_EQ(figures("turn_ms"), (Figures{0, 0.001}));
  EXPECT_EQ(figures("end_ms"), (Figures{0.5, 0}));
}

}  // namespace
}  // namespace edgewise::bench
