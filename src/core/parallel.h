// The one door to oneTBB, and to who wants to see what passes through it.
#pragma once

#include <memory>
#include <type_traits>

namespace edgewise {

// Where a section of parallel work starts. Clang 14 has no std::source_location.
struct CallSite {
  const char* function;  // its name alone, without scope and arguments
  const char* file;
};

// Is told of the sections of parallel work that its thread starts. While one watches, a section's tasks run
// one after the other on that thread, so that each has the core to itself: what `threads` still decides is
// how the work is cut. It may take the time at each call; nothing here does.
class ParallelObserver {
 public:
  virtual ~ParallelObserver() = default;
  virtual void section_begins(const CallSite& where) = 0;
  virtual void task_ends() = 0;  // the next one begins at once
  virtual void section_ends() = 0;
};

namespace detail {
extern constinit thread_local ParallelObserver* parallel_observer;
void parallel_for(int threads, int count, void (*call)(void*, int), void* context);
}  // namespace detail

// Lets an observer watch the calling thread's sections for as long as the scope lives.
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

// Calls body(0) … body(count - 1), each once, on up to `threads` threads, and returns when all are done.
// Calls with different arguments must not touch the same memory. An exception thrown by one is rethrown here.
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

// For bodies that share out pieces of work among themselves: between pieces, says that any other thread could
// have taken the one that is done.
inline void piece_done() {
  if (ParallelObserver* const observer = detail::parallel_observer) observer->task_ends();
}

}  // namespace edgewise
