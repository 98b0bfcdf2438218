#include "core/parallel.h"

#ifdef EDGEWISE_THREADS

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>

#include "core/float_state.h"

#ifdef EDGEWISE_TELL_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace edgewise::detail {

namespace {

// The process that uses oneTBB. A child that it forks has none of oneTBB's workers, but perhaps locks that
// they held, so nothing may lock before this is read. A child of that child could only be taken for the user
// if the system gives it the same number again, after the user has ended: then its first draw may hang.
constinit std::atomic<pid_t> user{0};
// Threads may draw until the process has ended, but oneTBB's static objects are destroyed soon after this
// one.
struct Exit {
  ~Exit() { user = -1; }
} const at_exit;

bool may_use_tbb() {
  const pid_t self = getpid();
  pid_t first = 0;
  return user.compare_exchange_strong(first, self) || first == self;
}

// One arena per thread count, made on first use and kept: making one takes longer than drawing a small scene.
// They are never destroyed, since threads may draw until the process has ended. oneTBB warns on standard
// error of an arena that exceeds its limit.
tbb::task_arena& arena_for(int threads) {
  static std::mutex mutex;
  static auto& arenas = *new std::map<int, tbb::task_arena>;
  const auto limit = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  threads = static_cast<int>(std::min(static_cast<std::size_t>(threads), limit));
  const std::lock_guard lock(mutex);
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

void run(int threads, int count, void (*call)(void*, int), void* context) {
  if (!may_use_tbb()) {
    for (int i = 0; i < count; ++i) call(context, i);
    return;
  }
  Section section;
  arena_for(threads).execute([&] {
    tbb::parallel_for(
        0, count,
        [&](int i) {
          section.task_begins();
          const DefaultFloatState state;  // this may be one of oneTBB's threads
          call(context, i);
          section.task_ends();
        },
        tbb::simple_partitioner{});
  });
}

}  // namespace

constinit ParallelFor parallel_for = run;

}  // namespace edgewise::detail

void edgewise::allow_more_threads_than_cores() {
  static const tbb::global_control kept(tbb::global_control::max_allowed_parallelism, 1024);
}

#else

constinit edgewise::detail::ParallelFor edgewise::detail::parallel_for =
    [](int, int count, void (*call)(void*, int), void* context) {
      for (int i = 0; i < count; ++i) call(context, i);
    };

void edgewise::allow_more_threads_than_cores() {}

#endif
