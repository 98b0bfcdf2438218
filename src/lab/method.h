// What the laboratory says of every method, whatever its family: the methods people really use, and ours
// among them.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "edgewise/frontend.h"

namespace edgewise::lab {

struct MethodInfo {
  std::string_view name;     // the one key in command line, tests, results and charts
  std::string_view idea;     // one line
  std::string_view source;   // where it is used or described
  std::string_view promise;  // one line: how wrong it may be, and never more; the tests hold it to that
  bool exact;                // covers no wrong pixel against the snapped truth
};

struct Size {
  int width, height;  // px
};

// A triangle as a program has it that does not snap: pixels with y down, depth in [0, 1].
struct FloatTriangle {
  UnsnappedTriangle at;
  std::uint32_t payload;
};

// One pixel that a method drew for one triangle. May lie outside the image: that is what is counted.
struct Hit {
  std::uint32_t triangle;  // index
  std::int32_t x, y;
  auto operator<=>(const Hit&) const = default;
};

// What rule of three says where no error was seen in n trials: with 95 % confidence the rate is below 3 / n.
constexpr double rate_bound(std::uint64_t trials) {
  return trials == 0 ? std::numeric_limits<double>::infinity() : 3.0 / static_cast<double>(trials);
}

}  // namespace edgewise::lab
