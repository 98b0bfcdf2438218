#include "raster/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <map>
#include <mutex>

namespace edgewise::detail {

constinit thread_local ParallelObserver* parallel_observer = nullptr;

namespace {

// One arena for each thread count, made on first use and kept: making one costs more than drawing a small
// scene.
tbb::task_arena& arena_of(int threads) {
  static std::mutex mutex;
  static std::map<int, tbb::task_arena> arenas;
  static std::unique_ptr<tbb::global_control> more_threads_than_cores;
  const std::lock_guard lock(mutex);
  if (threads > tbb::info::default_concurrency() && !more_threads_than_cores) {
    constexpr std::size_t kPlenty = 1024;
    more_threads_than_cores =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, kPlenty);
  }
  return arenas.try_emplace(threads, threads).first->second;
}

}  // namespace

void parallel_for(int threads, int count, void (*call)(void*, int), void* context) {
  arena_of(threads).execute([&] {
    tbb::parallel_for(
        0, count, [&](int i) { call(context, i); }, tbb::simple_partitioner{});
  });
}

}  // namespace edgewise::detail
