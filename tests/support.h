// Shared by tests: adversarial triangles, executions, comparison of frames.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "edgewise/contract.h"
#include "lab/measure.h"
#include "raster/ablation.h"

namespace edgewise::testing {

inline constexpr std::uint32_t kBackground = 0xABCD1234;

// Whether tests run at full size (scripts/test --full).
inline bool full_size() {
  return std::getenv("EDGEWISE_FULL") != nullptr;
}

// The thread sanitizer slows tests down tenfold, so it runs only executions that can race: several threads,
// with the best SIMD target.
#ifdef __SANITIZE_THREAD__
inline constexpr bool kRacesOnly = true;
#else
inline constexpr bool kRacesOnly = false;
#endif

// Families of triangles that are hard to rasterize.
inline constexpr std::string_view kFamilies[] = {"lattice",     "pixel-centres", "subpixel",   "slivers",
                                                 "huge",        "guardband",     "tiny",       "degenerate",
                                                 "equal-depth", "steep",         "few-pixels", "mixed-sizes"};

inline std::vector<ScreenTriangle> adversarial(std::string_view family, int count, int width, int height,
                                               std::uint64_t seed) {
  using namespace contract;
  Random random(seed);
  const auto between = [&](std::int64_t low, std::int64_t high) {
    return static_cast<std::int32_t>(
        low + static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(high - low + 1))));
  };
  const auto depth = [&] {
    return kDepthHead + static_cast<std::uint32_t>(random.below(kDepthRange + 1ull));
  };
  std::vector<ScreenTriangle> triangles(static_cast<std::size_t>(count));
  std::uint32_t id = 0;
  for (auto& t : triangles) {
    const std::int32_t cx = between(0, width * kSub), cy = between(0, height * kSub);
    for (int i = 0; i < 3; ++i) {
      std::int32_t x = between(-10 * kSub, (width + 10) * kSub),
                   y = between(-10 * kSub, (height + 10) * kSub);
      std::uint32_t z = depth();
      if (family == "lattice") x = x / kSub * kSub, y = y / kSub * kSub;
      if (family == "pixel-centres") x = sample_sub(x / kSub), y = sample_sub(y / kSub);
      if (family == "slivers" && i > 0) {
        x = i == 1 ? x : t.x_sub[1] + between(-3, 3);
        y = i == 1 ? y : t.y_sub[1] + between(-3, 3);
      }
      if (family == "huge") x = between(-kGuardSub, kGuardSub), y = between(-kGuardSub, kGuardSub);
      if (family == "guardband") x = between(0, 1) ? kGuardSub : -kGuardSub, y = between(0, 2) == 0 ? y : x;
      if (family == "tiny") x = cx + between(-300, 300), y = cy + between(-300, 300);
      if (family == "degenerate" && i == 2) {
        const int copy = between(0, 2);  // a point, a repeated vertex, or three collinear vertices
        x = copy == 2 ? 2 * t.x_sub[1] - t.x_sub[0] : t.x_sub[copy];
        y = copy == 2 ? 2 * t.y_sub[1] - t.y_sub[0] : t.y_sub[copy];
      }
      if (family == "equal-depth") z = kDepthHead + 1000;
      if (family == "few-pixels") x = cx + between(-1100, 1100), y = cy + between(-1100, 1100);
      if (family == "mixed-sizes") {  // equal depths, so that submission order decides
        const std::int32_t reach = id % 3 == 0 ? 40 * kSub : 4 * kSub;
        x = cx + between(-reach, reach), y = cy + between(-reach, reach), z = kDepthHead + 1000;
      }
      if (family == "steep") {
        x = cx + between(-400, 400), y = cy + between(-400, 400);
        z = between(0, 1) ? kDepthHead : kDepthHead + kDepthRange;
      }
      t.x_sub[i] = std::clamp(x, -kGuardSub, kGuardSub);
      t.y_sub[i] = std::clamp(y, -kGuardSub, kGuardSub);
      t.z[i] = z;
    }
    t.payload = id++;
  }
  return triangles;
}

// Every SIMD target with one thread, all tile sizes, and optimizations left out; several thread counts with
// the best target.
inline std::vector<AblatedExecution> executions() {
  std::vector<AblatedExecution> list;
  for (const int threads : {2, 3, 8}) list.push_back({{threads, 64, SimdTarget::best}});
  if (kRacesOnly) return list;
  for (const auto target : supported_targets()) list.push_back({{1, 64, target}});
  for (const auto target : supported_targets())
    for (const int tile : {16, 32}) list.push_back({{2, tile, target}});
  for (const auto target : supported_targets())
    for (const auto& ablation : kAblations) list.push_back({{1, 64, target}, ablation});
  return list;
}

inline std::string describe(const Execution& e) {
  return std::to_string(e.threads) + " threads, tile " + std::to_string(e.tile_size) + ", " +
         std::string(name_of(e.target));
}

inline std::string describe(const AblatedExecution& how) {
  const std::string left_out = edgewise::describe(how.ablation);
  return describe(how.execution) + (left_out.empty() ? "" : ", " + left_out);
}

// Empty if the frames are equal.
inline std::string difference_text(const Framebuffer& expected, const Framebuffer& actual) {
  const auto difference = lab::compare(expected, actual);
  if (difference.pixels == 0) return {};
  const int x = difference.first_x, y = difference.first_y;
  const auto both = [&](std::uint32_t a, std::uint32_t b) {
    return std::to_string(a) + " and " + std::to_string(b);
  };
  return std::to_string(difference.pixels) + " pixels differ, first (" + std::to_string(x) + ", " +
         std::to_string(y) + "): depth " + both(expected.depth_row(y)[x], actual.depth_row(y)[x]) +
         ", payload " + both(expected.payload_row(y)[x], actual.payload_row(y)[x]);
}

inline void expect_same(const Framebuffer& expected, const Framebuffer& actual, const std::string& what) {
  const std::string difference = difference_text(expected, actual);
  if (!difference.empty()) ADD_FAILURE() << what << ": " << difference;
}

inline std::vector<std::string_view> names_of(std::span<const BackendInfo> infos) {
  std::vector<std::string_view> names;
  for (const auto& b : infos) names.push_back(b.name);
  return names;
}

// The backends and wireframe().
inline std::vector<std::string_view> all_drawers() {
  std::vector<std::string_view> names = names_of(backends());
  names.push_back(wireframe().name);
  return names;
}
inline const BackendInfo& find_drawer(std::string_view name) {
  return name == wireframe().name ? wireframe() : find_backend(name);
}

// For parameterised tests: names may hold letters, digits and underscores only.
template <typename Info>
std::string test_name(const Info& info) {
  std::string name(info.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace edgewise::testing
