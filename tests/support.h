// Shared by tests: executions, the front end's output, comparison of frames.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/grid.h"
#include "core/parallel.h"
#include "core/random.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "lab/cases/backend_comparison.h"
#include "lab/cases/hard_triangles.h"

namespace edgewise::testing {

inline constexpr std::uint32_t kBackground = 0xABCD1234;

// Tests draw on more threads than there are cores, all at the same time.
inline const bool kManyThreads = (allow_more_threads_than_cores(), true);

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

using lab::adversarial;
inline const auto kFamilies = lab::triangle_families();

// Every SIMD target with one thread, all tile sizes, and all options of tiles; several thread counts with
// the best target.
inline std::vector<lab::DrawOptions> executions() {
  std::vector<lab::DrawOptions> list;
  for (const int threads : {2, 3, 8}) list.push_back({{threads, 64, SimdTarget::best}});
  if (kRacesOnly) return list;
  for (const auto target : supported_targets()) list.push_back({{1, 64, target}});
  for (const auto target : supported_targets())
    for (const int tile : {16, 32}) list.push_back({{2, tile, target}});
  for (const auto target : supported_targets())
    for (const auto& tiles : lab::kTileOptions) list.push_back({{1, 64, target}, tiles});
  return list;
}

// Positions in sub-units of a grid.
template <class G>
ScreenTriangle on_grid(ScreenTriangle t) {
  for (int i = 0; i < 3; ++i) t.x_q15[i] *= 1 << G::kSpareBits, t.y_q15[i] *= 1 << G::kSpareBits;
  return t;
}
inline ScreenTriangle coarse(const ScreenTriangle& t) {
  return on_grid<Coarse>(t);
}
// Calls check(grid) for both grids.
template <typename Check>
void for_each_grid(Check&& check) {
  check(Coarse{});
  check(Fine{});
}

inline std::int32_t between(Random& random, std::int32_t low, std::int32_t high) {
  return low + static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(high - low + 1)));
}

inline float spread(Random& random, float reach) {
  return random.uniform(-reach, reach);
}

// A mesh where it was modelled.
inline Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.emplace_back();
  return scene;
}

// What a front end emits, copied.
struct Emitted {
  std::vector<ScreenTriangle> triangles;
  FrontendStats stats;
};
inline Emitted run(const Drawable& drawable, const FrontendOptions& options,
                   const Execution& execution = {}) {
  Frontend frontend;
  const auto span = frontend.run(drawable, options, execution);
  return {{span.begin(), span.end()}, frontend.stats()};
}

inline void expect_same_triangles(std::span<const ScreenTriangle> a, std::span<const ScreenTriangle> b,
                                  const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(std::memcmp(&a[i], &b[i], sizeof a[i]), 0) << what << ", triangle " << i;
}

inline std::string describe(const Execution& e) {
  return std::to_string(e.threads) + " threads, tile " + std::to_string(e.tile_size) + ", " +
         std::string(name_of(e.target));
}

inline std::string describe(const lab::DrawOptions& how) {
  const std::string tiles = lab::describe(how.tiles);
  return describe(how.execution) + (tiles.empty() ? "" : ", " + tiles);
}

inline void expect_same(const Framebuffer& expected, const Framebuffer& actual, const std::string& what) {
  const auto difference = lab::compare(expected, actual);
  if (difference.pixels == 0) return;
  const int x = difference.first_x, y = difference.first_y;
  ADD_FAILURE() << what << ": " << difference.pixels << " pixels differ, first (" << x << ", " << y
                << "): depth " << expected.depth_row(y)[x] << " and " << actual.depth_row(y)[x]
                << ", payload " << expected.payload_row(y)[x] << " and " << actual.payload_row(y)[x];
}

// The backends and wireframe().
inline std::vector<std::string_view> all_drawers() {
  std::vector<std::string_view> names = {wireframe().name};
  for (const BackendInfo& backend : backends()) names.push_back(backend.name);
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
