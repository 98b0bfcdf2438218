// What a timer of parallel sections is told, and on which threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include "core/parallel.h"

namespace edgewise {
namespace {

// Logs the calls of each thread, in order: S and E for the section, ( and ) for a task, w and d for a wait.
class Log final : public ParallelTimer {
 public:
  void section_begins() override { add(0, 'S'); }
  void task_begins(int thread) override {
    add(thread, '(');
    const std::lock_guard lock(mutex_);
    ids[thread].insert(std::this_thread::get_id());
  }
  void wait_begins(int thread) override { add(thread, 'w'); }
  void wait_ends(int thread) override { add(thread, 'd'); }
  void task_ends(int thread) override { add(thread, ')'); }
  void section_ends() override { add(0, 'E'); }

  std::string calls[2];
  std::set<std::thread::id> ids[2];  // of the threads that run tasks
  int tasks() const { return static_cast<int>(std::ranges::count(calls[0] + calls[1], '(')); }

 private:
  void add(int thread, char call) {
    const std::lock_guard lock(mutex_);
    calls[thread] += call;
  }
  std::mutex mutex_;
};

// Two tasks that run at the same time, so on different threads. The deadline turns a hang into a failure.
template <typename Body>
void on_two_threads(Body&& body) {
  std::atomic<int> arrived{0};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  parallel_for(2, 2, [&](int i) {
    ++arrived;
    while (arrived < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    body(i);
  });
}

TEST(ParallelTimer, SeesTheTasksOfBothThreads) {
  Log log;
  {
    const TimeParallel scope(log);
    on_two_threads([](int) {});
  }
  EXPECT_EQ(log.calls[0], "S()E");
  EXPECT_EQ(log.calls[1], "()");
  EXPECT_EQ(log.ids[0], std::set{std::this_thread::get_id()}) << "thread 0 is the caller";
  EXPECT_EQ(log.ids[1].count(std::this_thread::get_id()), 0u);
  on_two_threads([](int) {});
  EXPECT_EQ(log.tasks(), 2) << "no longer timed";
}

TEST(ParallelTimer, SeesEveryTaskOnce) {
  Log log;
  {
    const TimeParallel scope(log);
    parallel_for(2, 100, [](int) {});
    parallel_in_chunks(2, 130, [](int) {});  // 33 chunks of four
  }
  EXPECT_EQ(log.tasks(), 133);
  EXPECT_EQ(std::ranges::count(log.calls[0], 'S'), 2);
  EXPECT_EQ(std::ranges::count(log.calls[0], 'E'), 2);
}

TEST(ParallelTimer, TakesSectionsOnOneThreadForSerialCode) {
  Log log;
  {
    const TimeParallel scope(log);
    parallel_for(1, 3, [](int) {});
    parallel_for(2, 1, [](int) { const TimeWait wait; });
  }
  EXPECT_EQ(log.calls[0] + log.calls[1], "");
}

TEST(ParallelTimer, SeesTheWaitsOfItsTasks) {
  Log log;
  const TimeWait outside;
  {
    const TimeParallel scope(log);
    const TimeWait between;
    on_two_threads([](int i) {
      if (i == 0) return;
      const TimeWait wait;
    });
  }
  const std::string both = log.calls[0] + log.calls[1];
  EXPECT_EQ(std::ranges::count(both, 'w'), 1) << both;
  EXPECT_NE(both.find("(wd)"), std::string::npos) << both;
}

TEST(ParallelTimer, TakesSectionsInsideATaskForPartsOfIt) {
  Log log;
  std::atomic<int> inner{0};
  {
    const TimeParallel scope(log);
    parallel_for(2, 2, [&](int) { parallel_for(2, 50, [&](int) { ++inner; }); });
  }
  EXPECT_EQ(inner, 100);
  EXPECT_EQ(std::ranges::count(log.calls[0], 'S'), 1);
  // A thread that waits for an inner section may run the other outer task inside its own.
  EXPECT_GE(log.tasks(), 1);
  EXPECT_LE(log.tasks(), 2);
}

TEST(ParallelTimer, EndsTasksAndSectionsOfAnException) {
  Log log;
  {
    const TimeParallel scope(log);
    EXPECT_THROW(on_two_threads([](int i) {
                   if (i == 0) throw std::runtime_error("no");
                 }),
                 std::runtime_error);
    on_two_threads([](int) {});
  }
  EXPECT_EQ(log.calls[0], "S()ES()E");
  EXPECT_EQ(log.calls[1], "()()");
}

TEST(ParallelTimer, GivesPrecedenceToAnObserver) {
  struct Ignore final : ParallelObserver {
    void section_begins(const CallSite&) override {}
    void task_ends() override {}
    void section_ends() override {}
  } observer;
  Log log;
  {
    const TimeParallel scope(log);
    const ObserveParallel observed(observer);
    parallel_for(2, 10, [](int) {});
  }
  EXPECT_EQ(log.calls[0] + log.calls[1], "");
}

}  // namespace
}  // namespace edgewise
