// One picture of a soak: what it shows follows from the campaign's seed and the case's number alone, so that
// any machine can draw any part of the sequence.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "edgewise/frontend.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::soak {

// Raised whenever a case's content changes: results of different sequences must not be added up.
inline constexpr int kSequence = 2;

struct Case {
  std::uint64_t number = 0;
  std::string_view family;
  int width = 0, height = 0;  // px
  std::uint32_t background = 0;
  int threads = 2;  // the thread count that is tried beside 1

  std::vector<ScreenTriangle> triangles;  // of a triangle family; else
  std::optional<Drawable> drawable;       // of a scene family, with
  FrontendOptions frontend;               // its culling, payload and shading

  bool patient_oracle = false;   // the oracle may take long in this one
  std::uint64_t draws_seed = 0;  // for what may differ between machines: tile sizes, strides, ideas
};

Case make_case(std::uint64_t seed, std::uint64_t number);

}  // namespace edgewise::soak
