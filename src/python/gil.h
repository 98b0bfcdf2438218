// Work without Python's global interpreter lock (GIL).
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

namespace edgewise::python {

namespace py = pybind11;

// Calls f(), C code that takes the GIL. While Python ends, taking it unwinds the thread's stack: destructors
// would then use Python without the GIL, or terminate the process. The thread sleeps instead, as in
// Python 3.14.
template <typename F>
auto never_unwound(F&& f) {
  try {
    return f();
  } catch (...) {
    for (;;) pause();
  }
}

// Releases the GIL for as long as it exists.
class Released {
 public:
  Released() : state_(PyEval_SaveThread()) {}
  ~Released() {
    never_unwound([&] { PyEval_RestoreThread(state_); });
  }
  Released(const Released&) = delete;
  Released& operator=(const Released&) = delete;

 private:
  PyThreadState* state_;
};

}  // namespace edgewise::python
