// The cases of `edgewise verify --random`. Each depends on the seed and its number alone, so any machine
// can draw any part of the sequence.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "edgewise/frontend.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::randomized {

struct Case {
  std::uint64_t number = 0;
  std::string family;
  int width = 0, height = 0;  // px
  std::uint32_t background = 0;
  int threads = 2;  // the thread count of the multi-threaded draws

  std::vector<ScreenTriangle> triangles;  // of a family in lab/cases/hard_triangles.h; else
  std::optional<Drawable> drawable;       // of a scene family, with
  FrontendOptions frontend;               // its culling, payload and shading; subpixel bits, of lists too

  bool large_oracle_budget = false;  // the oracle may take longer in this case
  std::uint64_t draws_seed = 0;      // for choices that depend on the machine's SIMD targets: tile sizes,
                                     // strides, tile options
};

Case make_case(std::uint64_t seed, std::uint64_t number, int subpixel_bits = 8);
// Of half of the cases 8, of the others any.
int random_subpixel_bits(std::uint64_t seed, std::uint64_t number);

// Matrices that show about what a camera does: of the kinds that camera.h has helpers for, and general ones.
// Empty if the front end refuses the camera or the matrices.
std::optional<CameraMatrices> random_matrices(Random& random, const Camera& camera, int width, int height);
// The case with matrices in place of its camera. Half of the scenes get some; empty for the others, and for
// lists of triangles. make_case() makes none, so that its cases stay those whose hashes are stored.
std::optional<Case> with_matrices(const Case& c);

// Families of scenes that go through the front end.
struct SceneFamily {
  std::string_view name;
  Drawable (*make)(Random& random, int width, int height);  // for an image of that size in pixels
};
std::span<const SceneFamily> scene_families();

}  // namespace edgewise::randomized
