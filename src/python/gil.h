// Work without Python's global interpreter lock (GIL), and calls of Python in the middle of it.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <cstddef>

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

// The GIL must be held. Runs the handlers of signals that came, in the main thread, and throws what they
// raise.
inline void handle_signals() {
  if (never_unwound(PyErr_CheckSignals) != 0) throw py::error_already_set();
}

// The GIL must be held. Throws what the callback raises; None is no callback.
inline void report(const py::object& progress, std::size_t steps) {
  if (progress.is_none()) return;
  auto* const result = never_unwound(
      [&] { return PyObject_CallFunction(progress.ptr(), "n", static_cast<Py_ssize_t>(steps)); });
  if (result == nullptr) throw py::error_already_set();
  Py_DECREF(result);
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
