// The only interface to oneTBB. Without it (EDGEWISE_THREADS=OFF), everything runs on the caller's thread.
#pragma once

#include <memory>
#include <type_traits>

namespace edgewise {

namespace detail {
// A pointer, so that two copies of the library in one process can share one (src/python/laboratory.cpp): a
// forked child must know of every use of oneTBB by its parent.
using ParallelFor = void (*)(int threads, int count, void (*call)(void*, int), void* context);
extern ParallelFor parallel_for;
}  // namespace detail

// Lets oneTBB start more threads than there are cores, for the rest of the process. For programs that want
// it: the library leaves such limits to them.
void allow_more_threads_than_cores();

// Calls body(0) … body(count - 1), each once, on up to `threads` threads, and returns when all are done.
// oneTBB may have fewer. A forked child whose parent has called this runs everything on the caller's thread.
// Calls must not write memory that another one accesses. An exception thrown by one is rethrown here.
template <typename Body>
void parallel_for(int threads, int count, Body&& body) {
  if (threads <= 1 || count <= 1) {
    for (int i = 0; i < count; ++i) body(i);
    return;
  }
  using Plain = std::remove_reference_t<Body>;
  detail::parallel_for(
      threads, count, [](void* context, int i) { (*static_cast<Plain*>(context))(i); },
      const_cast<void*>(static_cast<const void*>(std::addressof(body))));
}

}  // namespace edgewise
