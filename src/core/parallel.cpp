#include "core/parallel.h"

#ifdef EDGEWISE_THREADS

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <map>
#include <memory>
#include <mutex>

#ifdef EDGEWISE_TELL_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace edgewise::detail {

namespace {

// One arena per thread count, made on first use and kept: making one takes longer than drawing a small scene.
tbb::task_arena& arena_for(int threads) {
  static std::mutex mutex;
  static std::map<int, tbb::task_arena> arenas;
  static std::unique_ptr<tbb::global_control> more_threads_than_cores;
  const std::lock_guard lock(mutex);
  if (threads > tbb::info::default_concurrency() && !more_threads_than_cores) {
    constexpr std::size_t kMaxParallelism = 1024;
    more_threads_than_cores =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, kMaxParallelism);
  }
  return arenas.try_emplace(threads, threads).first->second;
}

// oneTBB is not built with ThreadSanitizer, which would report accesses that oneTBB orders as races. So this
// file is not instrumented either, and announces only the guaranteed order: tasks begin after their section
// begins, and end before it ends. Two tasks that access the same memory are still reported
// (tests/sanitizers/seeded_race.cpp).
class Section {
 public:
#ifdef EDGEWISE_TELL_TSAN
  Section() {
    __tsan_release(&begun_);
  }
  ~Section() {
    __tsan_acquire(&ended_);
  }
  void task_begins() {
    __tsan_acquire(&begun_);
  }
  void task_ends() {
    __tsan_release(&ended_);
  }

 private:
  char begun_, ended_;
#else
  void task_begins() {}
  void task_ends() {}
#endif
};

}  // namespace

void parallel_for(int threads, int count, void (*call)(void*, int), void* context) {
  Section section;
  arena_for(threads).execute([&] {
    tbb::parallel_for(
        0, count,
        [&](int i) {
          section.task_begins();
          call(context, i);
          section.task_ends();
        },
        tbb::simple_partitioner{});
  });
}

}  // namespace edgewise::detail

#else

void edgewise::detail::parallel_for(int, int count, void (*call)(void*, int), void* context) {
  for (int i = 0; i < count; ++i) call(context, i);
}

#endif
