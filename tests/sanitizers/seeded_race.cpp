// Two tasks of one parallel_for write the same variable, which ThreadSanitizer must report. With the argument
// "no" they write different variables, which it must not report. This shows that parallel.cpp's annotations
// are sufficient, and hide no race.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <string_view>
#include <thread>

#include "core/parallel.h"

namespace {

// Whether both tasks ran at the same time, on different threads.
bool run_two_tasks(int& of_first, int& of_second) {
  std::atomic<int> arrived{0};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
  edgewise::parallel_for(2, 2, [&](int task) {
    // Relaxed, so that the rendezvous adds no happens-before order.
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
  // Repeated, since oneTBB reuses its memory.
  int shared = 0, other = 0, met = 0;
  for (int attempt = 0; attempt < 200; ++attempt)
    if (run_two_tasks(shared, race ? shared : other)) ++met;
  std::printf("two tasks met %d times\n", met);
  return met > 0 && shared + other > 0 ? 0 : 1;
}
