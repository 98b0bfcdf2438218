// One picture of a soak test. It depends on the seed and the case's number alone, so any machine can draw any
// part of the sequence.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "edgewise/frontend.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::soak {

// Increment it whenever the content of a case changes: results of different sequences must not be merged.
inline constexpr int kSequence = 3;

struct Case {
  std::uint64_t number = 0;
  std::string_view family;
  int width = 0, height = 0;  // px
  std::uint32_t background = 0;
  int threads = 2;  // the thread count of the multi-threaded draws

  std::vector<ScreenTriangle> triangles;  // of a triangle family; else
  std::optional<Drawable> drawable;       // of a scene family, with
  FrontendOptions frontend;               // its culling, payload and shading

  bool large_oracle_budget = false;  // the oracle may take longer in this case
  std::uint64_t draws_seed = 0;      // for choices that depend on the machine's SIMD targets: tile sizes,
                                     // strides, ablations
};

Case make_case(std::uint64_t seed, std::uint64_t number);

}  // namespace edgewise::soak
