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
#endif

namespace edgewise::detail {

namespace {

#ifdef EDGEWISE_THREADS
// The process that uses oneTBB. A child that it forks has none of oneTBB's workers, but perhaps locks that
// they held, so nothing may lock before this is read. A child of that child could only be taken for the user
// if the system gives it the same number again, after the user has ended: then its first draw may hang.
constinit std::atomic<pid_t> user{0};
// oneTBB's static objects are destroyed soon after this one, while threads may still draw.
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
#ifdef EDGEWISE_TELL_TSAN
constexpr auto* kRelease = __tsan_release;
constexpr auto* kAcquire = __tsan_acquire;
#else
constexpr auto kRelease = [](void*) {}, kAcquire = kRelease;
#endif
struct Section {
  Section() { kRelease(&begun); }
  ~Section() { kAcquire(&ended); }
  void task_begins() { kAcquire(&begun); }
  void task_ends() { kRelease(&ended); }
  char begun, ended;
};
#endif

void run([[maybe_unused]] int threads, int count, void (*call)(void*, int), void* context) {
#ifdef EDGEWISE_THREADS
  if (may_use_tbb()) {
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
    return;
  }
#endif
  for (int i = 0; i < count; ++i) call(context, i);
}

}  // namespace

constinit ParallelFor parallel_for = run;

}  // namespace edgewise::detail

void edgewise::allow_more_threads_than_cores() {
#ifdef EDGEWISE_THREADS
  static const tbb::global_control kept(tbb::global_control::max_allowed_parallelism, 1024);
#endif
}
