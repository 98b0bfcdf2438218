// Runs of triangles in parallel, their output in order, without a second pass over it. Runs are handed out in
// order, each worker fills a buffer of its own, and when all runs before it know how long they are, a run
// knows its place, lets the next one know, and is copied there.
//
// The lowest run that is under way waits for nobody, so the others will get their turn.
#pragma once

#include <hwy/cache_control.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "frontend/tasks.h"

namespace edgewise {

class InOrder {
 public:
  void start_frame(int threads, bool with_unsnapped) {
    threads_ = threads;
    total_ = 0;
    if (outputs_.size() < static_cast<std::size_t>(threads))
      outputs_.resize(static_cast<std::size_t>(threads));
    for (RunOutput& out : outputs_) {
      out.reserve(with_unsnapped);
      out.stats = {};
    }
  }

  // Calls make(run, output) for each of so many runs, of `count` triangles together, which fills an empty
  // output, and place(output, at) where `at` triangles come before it. Neither may throw.
  template <typename Make, typename Place>
  void for_each_run(std::size_t runs, std::size_t count, Make&& make, Place&& place) {
    const int workers = workers_for(count, threads_);
    std::atomic<std::size_t> next{0};
    std::atomic<std::uint32_t> turn{0};
    parallel_for(workers, workers, [&](int worker) {
      RunOutput& out = outputs_[static_cast<std::size_t>(worker)];
      for (std::size_t run; (run = next.fetch_add(1, std::memory_order_relaxed)) < runs;) {
        out.count = 0;
        make(run, out);
        wait_until(turn, static_cast<std::uint32_t>(run));
        const std::size_t at = total_;
        total_ += out.count;
        turn.store(static_cast<std::uint32_t>(run + 1), std::memory_order_release);
        turn.notify_all();
        place(out, at);
        piece_done();
      }
    });
  }

  std::size_t total() const { return total_; }  // triangles since the frame's start
  FrontendStats stats() const {
    FrontendStats sum;
    for (const RunOutput& out : outputs_) sum += out.stats;
    return sum;
  }

 private:
  // Looks again and again for some 20 us before it sleeps: a run takes less, and waking a thread takes more.
  static void wait_until(const std::atomic<std::uint32_t>& turn, std::uint32_t run) {
    constexpr int kLooks = 2000;
    for (int i = 0; i < kLooks; ++i) {
      if (turn.load(std::memory_order_acquire) == run) return;
      hwy::Pause();
    }
    for (std::uint32_t now; (now = turn.load(std::memory_order_acquire)) != run;)
      turn.wait(now, std::memory_order_acquire);
  }

  int threads_ = 1;
  std::size_t total_ = 0;
  std::vector<RunOutput> outputs_;  // one a worker
};

}  // namespace edgewise
