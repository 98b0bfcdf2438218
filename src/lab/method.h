// What the methods of all families have in common. They are methods in real use, ours among them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "edgewise/frontend.h"

namespace edgewise::lab {

// The subpixel bits with which ours stand beside other methods.
inline constexpr int kShownBits[] = {8, 12, 15};

struct MethodInfo {
  std::string_view name;     // the same in the command line, tests, results and charts
  std::string_view summary;  // one line
  std::string_view source;   // a program that uses it, or a publication that describes it
  std::string_view promise;  // one line: an upper bound of its errors, which the tests check
  bool exact;                // no errors against the snapped truth
};

template <typename Methods>
std::vector<MethodInfo> infos_of(const Methods& methods) {
  std::vector<MethodInfo> list;
  for (const auto& method : methods) list.push_back(method.info);
  return list;
}

// Whether culling keeps a triangle whose area has this sign: 1 clockwise on the screen, the front.
constexpr bool keeps(Cull cull, int facing) {
  return cull == Cull::none || (cull == Cull::back && facing > 0) || (cull == Cull::front && facing < 0);
}

struct Size {
  int width, height;  // px
};

// An unsnapped triangle: pixels with y down, depth in [0, 1].
struct FloatTriangle {
  UnsnappedTriangle at;
  std::uint32_t payload;
};

// Rule of three: if n trials show no error, the rate is below 3 / n with 95 % confidence.
constexpr double rate_bound(std::uint64_t trials) {
  return trials == 0 ? std::numeric_limits<double>::infinity() : 3.0 / static_cast<double>(trials);
}

// The families of methods that the laboratory compares.
enum class Family { coverage, visibility, facing, clipping, projection };
inline constexpr std::array kFamilies{Family::coverage, Family::visibility, Family::facing, Family::clipping,
                                      Family::projection};

std::string_view name_of(Family family);
// Throws std::invalid_argument for an unknown name; the message suggests the nearest known one.
Family find_family(std::string_view name);
// In the order of the family's registry.
std::vector<MethodInfo> methods_of(Family family);

}  // namespace edgewise::lab
