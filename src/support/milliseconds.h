// Measures wall-clock time in ms.
#pragma once

#include <chrono>

namespace edgewise::tools {

template <typename Work>
double milliseconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace edgewise::tools
