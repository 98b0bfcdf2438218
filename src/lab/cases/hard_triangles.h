// Families of random triangle lists that are hard for a rasterizer, for `edgewise verify --random`, tests and
// fuzzing.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "edgewise/screen_triangle.h"

namespace edgewise::lab {

std::span<const std::string_view> triangle_families();

// Returns a number in [0, end), from random numbers or from the bytes of a fuzzer.
using Numbers = std::function<std::uint64_t(std::uint64_t end)>;

// `count` triangles of a family over an image of this size in pixels, on the grid of 4 … 15 subpixel bits.
// All vertices lie in the guard band; payloads are indices. Equal numbers give equal lists on every machine.
// Throws std::invalid_argument for an unknown family.
std::vector<ScreenTriangle> adversarial(std::string_view family, int count, int width, int height,
                                        const Numbers& numbers, int subpixel_bits = 8);
std::vector<ScreenTriangle> adversarial(std::string_view family, int count, int width, int height,
                                        std::uint64_t seed, int subpixel_bits = 8);

}  // namespace edgewise::lab
