// The floating-point state of a thread: rounding, trapped exceptions, denormals that are flushed to zero.
#pragma once

#include <cfenv>

namespace edgewise {

// Sets C's default state on this thread: results are rounded to nearest, denormals are kept, and no exception
// is trapped. The destructor puts back what it found, with the exceptions that had been raised. Every public
// function that computes with floats begins with one, and so does every task of parallel_for(): a program may
// have changed the state, and bits of the picture depend on it.
class DefaultFloatState {
 public:
  // Not inline: compilers move arithmetic across a change of the state, but not across calls.
  DefaultFloatState();
  ~DefaultFloatState();
  DefaultFloatState(const DefaultFloatState&) = delete;
  DefaultFloatState& operator=(const DefaultFloatState&) = delete;

 private:
#ifdef __x86_64__
  unsigned callers_;  // MXCSR
#else
  std::fenv_t callers_;
#endif
};

}  // namespace edgewise
