// Two tasks of one parallel_for that write the same variable, which ThreadSanitizer must report; or, with the
// argument "no", variables of their own, which it must not. Shows that what parallel.cpp tells it does not
// make it blind, and suffices.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <string_view>
#include <thread>

#include "core/parallel.h"

namespace {

// Whether both tasks were under way at once, each on a thread of its own.
bool run_two_tasks(int& of_first, int& of_second) {
  std::atomic<int> arrived{0};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
  edgewise::parallel_for(2, 2, [&](int task) {
    // Relaxed, so that meeting orders nothing.
    arrived.fetch_add(1, std::memory_order_relaxed);
    while (arrived.load(std::memory_order_relaxed) < 2 && std::chrono::steady_clock::now() < deadline)
      std::this_thread::yield();
    ++(task == 0 ? of_first : of_second);
  });
  return std::chrono::steady_clock::now() < deadline;
}

}  // namespace

int main(int argc, char** argv) {
  const bool race = argc < 2 || std::string_view(argv[1]) != "no";
  // Many times, since oneTBB uses its memory again.
  int shared = 0, other = 0, met = 0;
  for (int attempt = 0; attempt < 200; ++attempt)
    if (run_two_tasks(shared, race ? shared : other)) ++met;
  std::printf("two tasks met %d times\n", met);
  return met > 0 && shared + other > 0 ? 0 : 1;
}
