// Random numbers that are the same on every machine and standard library. The order in which a call's
// arguments are evaluated depends on the compiler, so draw at most one number per argument list.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

namespace edgewise {

// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
  }
  // In [0, end). `end` must be at most 2^32: then the bias is below 2^-32, and results fit std::size_t.
  std::size_t below(std::uint64_t end) { return static_cast<std::size_t>(next() % end); }
  // A multiple of 2^-24 in [low, high).
  float uniform(float low, float high) {
    return low + (high - low) * (static_cast<float>(next() >> 40) * 0x1p-24f);
  }
  // A unit vector, by rejection sampling: the last bit of trigonometric functions differs between libraries.
  glm::vec2 direction() {
    for (;;) {
      const float x = uniform(-1.0f, 1.0f), y = uniform(-1.0f, 1.0f), square = x * x + y * y;
      if (square > 0.01f && square <= 1.0f) return glm::vec2(x, y) / std::sqrt(square);
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace edgewise
