// Work of a known duration.
#pragma once

#include <chrono>

namespace edgewise::bench {

inline void spin(double for_s) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(for_s);
  while (std::chrono::steady_clock::now() < end) {
  }
}

}  // namespace edgewise::bench
