// The floating-point states that a program may be in when it calls the library.
#pragma once

#include <gtest/gtest.h>

#include <cfenv>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include "edgewise/hash.h"

namespace edgewise::testing {

struct FloatMode {
  std::string name;
  std::function<void()> set;
};

// All that the machine has.
inline std::vector<FloatMode> float_modes() {
  std::vector<FloatMode> modes{{"upward", [] { std::fesetround(FE_UPWARD); }},
                               {"downward", [] { std::fesetround(FE_DOWNWARD); }},
                               {"toward zero", [] { std::fesetround(FE_TOWARDZERO); }}};
#if defined(__x86_64__)
  modes.push_back({"denormals are zero", [] { _mm_setcsr(_mm_getcsr() | 0x8040); }});
#elif defined(__aarch64__)
  modes.push_back({"denormals are zero", [] { asm volatile("msr fpcr, %0" ::"r"(1l << 24)); }});
#endif
#ifdef __GLIBC__
  constexpr int kEach[] = {FE_INVALID, FE_DIVBYZERO, FE_OVERFLOW, FE_UNDERFLOW, FE_INEXACT};
  for (const int exception : kEach) {
    if (feenableexcept(exception) == -1 || fegetexcept() != exception) continue;  // the processor cannot
    fedisableexcept(exception);
    modes.push_back({"traps exception " + std::to_string(exception), [=] { feenableexcept(exception); }});
  }
#endif
  return modes;
}

// The rounding, the exceptions that were raised and those that are trapped; on x86-64, all of MXCSR.
inline std::vector<unsigned> float_state() {
  std::vector<unsigned> state{static_cast<unsigned>(std::fegetround()),
                              static_cast<unsigned>(std::fetestexcept(FE_ALL_EXCEPT))};
#ifdef __GLIBC__
  state.push_back(static_cast<unsigned>(fegetexcept()));
#endif
#if defined(__x86_64__)
  state.push_back(_mm_getcsr());
#elif defined(__aarch64__)
  unsigned long control;
  asm volatile("mrs %0, fpcr" : "=r"(control));
  state.push_back(static_cast<unsigned>(control));
#endif
  return state;
}

// Numbers that tell values apart, without computing with floats.
using Bits = std::vector<std::uint64_t>;
template <typename T>
std::uint64_t bits_of(std::span<const T> values) {
  std::vector<std::uint64_t> words((values.size_bytes() + 7) / 8);
  if (!words.empty()) std::memcpy(words.data(), values.data(), values.size_bytes());
  return hash_of_all(words);
}
template <typename T>
std::uint64_t bits_of(const std::vector<T>& values) {
  return bits_of(std::span<const T>(values));
}
template <typename T>
std::uint64_t bits(const T& value) {
  return bits_of(std::span<const T>(&value, 1));
}

// Calls f(i) in the default state, then in each other one. It must return the same each time, and leave the
// state as it was. It must not compute with floats itself.
template <typename F>
void expect_same_in_every_float_mode(F&& f) {
  const auto expected = f(0);
  int i = 0;
  for (const FloatMode& mode : float_modes()) {
    mode.set();
    const std::vector<unsigned> before = float_state();
    const auto found = f(++i);
    const std::vector<unsigned> after = float_state();
    std::fesetenv(FE_DFL_ENV);
    EXPECT_EQ(found, expected) << mode.name;
    EXPECT_EQ(after, before) << mode.name;
  }
}

}  // namespace edgewise::testing
