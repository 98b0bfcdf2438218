// The only interface to oneTBB, with an optional observer and an optional timer.
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>

namespace edgewise {

// The caller of parallel_for(). Clang 14 has no std::source_location.
struct CallSite {
  const char* function;  // unqualified name, without arguments
  const char* file;
};

// Observes the parallel sections (calls of parallel_for()) that its thread starts. While an observer is set,
// the tasks of a section run one after the other on that thread, so that each has a core to itself; `threads`
// then decides only how callers partition the work. Observers measure time themselves, at each call.
class ParallelObserver {
 public:
  virtual ~ParallelObserver() = default;
  virtual void section_begins(const CallSite& where) = 0;
  virtual void task_ends() = 0;  // the next one begins at once
  virtual void section_ends() = 0;
};

// Times the parallel sections that its thread starts, if they may use several threads. In contrast to an
// observer, it leaves every task on the thread that runs it. Sections inside tasks are not reported. `thread`
// is 0 for the caller of the section and less than `threads`. Calls for different threads may be concurrent.
class ParallelTimer {
 public:
  virtual ~ParallelTimer() = default;
  virtual void section_begins() = 0;
  virtual void task_begins(int thread) = 0;
  virtual void wait_begins(int thread) = 0;  // inside a task: see TimeWait
  virtual void wait_ends(int thread) = 0;
  virtual void task_ends(int thread) = 0;
  virtual void section_ends() = 0;
};

namespace detail {
extern constinit thread_local ParallelObserver* parallel_observer;

struct Timing {
  ParallelTimer* timer = nullptr;
  int thread = -1;  // that runs the task; -1 outside of tasks
};
extern constinit thread_local Timing timing;

void parallel_for(int threads, int count, void (*call)(void*, int), void* context);
}  // namespace detail

// Sets the observer of the calling thread for the lifetime of this object.
class ObserveParallel {
 public:
  explicit ObserveParallel(ParallelObserver& observer) : before_(detail::parallel_observer) {
    detail::parallel_observer = &observer;
  }
  ~ObserveParallel() { detail::parallel_observer = before_; }
  ObserveParallel(const ObserveParallel&) = delete;
  ObserveParallel& operator=(const ObserveParallel&) = delete;

 private:
  ParallelObserver* before_;
};

// Sets the timer of the calling thread for the lifetime of this object. Observed sections are not timed.
class TimeParallel {
 public:
  explicit TimeParallel(ParallelTimer& timer) : before_(detail::timing) { detail::timing = {&timer, -1}; }
  ~TimeParallel() { detail::timing = before_; }
  TimeParallel(const TimeParallel&) = delete;
  TimeParallel& operator=(const TimeParallel&) = delete;

 private:
  detail::Timing before_;
};

// Reports to the timer, if there is one, that the calling task waits for another task of its section for the
// lifetime of this object.
class TimeWait {
 public:
  TimeWait() : timing_(detail::timing) {
    if (timing_.thread >= 0) timing_.timer->wait_begins(timing_.thread);
  }
  ~TimeWait() {
    if (timing_.thread >= 0) timing_.timer->wait_ends(timing_.thread);
  }
  TimeWait(const TimeWait&) = delete;
  TimeWait& operator=(const TimeWait&) = delete;

 private:
  detail::Timing timing_;
};

// Calls body(0) … body(count - 1), each once, on up to `threads` threads, and returns when all are done.
// Calls must not write memory that another one accesses. An exception thrown by one is rethrown here.
template <typename Body>
void parallel_for(int threads, int count, Body&& body,
                  const CallSite& where = {__builtin_FUNCTION(), __builtin_FILE()}) {
  if (ParallelObserver* const observer = detail::parallel_observer) {
    observer->section_begins(where);
    for (int i = 0; i < count; ++i) {
      body(i);
      observer->task_ends();
    }
    observer->section_ends();
    return;
  }
  if (threads <= 1 || count <= 1) {
    for (int i = 0; i < count; ++i) body(i);
    return;
  }
  using Plain = std::remove_reference_t<Body>;
  detail::parallel_for(
      threads, count, [](void* context, int i) { (*static_cast<Plain*>(context))(i); },
      const_cast<void*>(static_cast<const void*>(std::addressof(body))));
}

// For bodies that take pieces of work from a common queue: call it after each piece. The observer then counts
// the piece as a task of its own, since any thread could have taken it.
inline void piece_done() {
  if (ParallelObserver* const observer = detail::parallel_observer) observer->task_ends();
}

// parallel_for() for many short calls. A thread takes up to four consecutive calls at once, since taking work
// costs oneTBB about 0.1 us.
template <typename Body>
void parallel_in_chunks(int threads, int count, Body&& body,
                        const CallSite& where = {__builtin_FUNCTION(), __builtin_FILE()}) {
  const int chunk = std::clamp(count / (16 * threads), 1, 4);
  parallel_for(
      threads, (count + chunk - 1) / chunk,
      [&](int i) {
        for (int k = i * chunk; k < std::min(count, (i + 1) * chunk); ++k) body(k);
      },
      where);
}

}  // namespace edgewise
