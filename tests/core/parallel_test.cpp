#ifdef EDGEWISE_THREADS
#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace edgewise {
namespace {

// The tasks wait for each other. The deadline turns a hang into a failure.
TEST(ParallelFor, RunsTasksAtTheSameTimeAndRethrows) {
  std::atomic<int> arrived{0};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  const auto meet = [&](int i) {
    ++arrived;
    while (arrived < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    if (arrived == 2 && i == 1) throw std::runtime_error("met");
  };
  EXPECT_THROW(parallel_for(2, 2, meet), std::runtime_error);
}

TEST(ParallelFor, MayBeNested) {
  std::atomic<int> calls{0};
  parallel_for(2, 2, [&](int) { parallel_for(2, 50, [&](int) { ++calls; }); });
  EXPECT_EQ(calls, 100);
}

}  // namespace
}  // namespace edgewise
#endif
