// A coverage mask: the covered pixels of a small triangle in 8 x 8 px of a tile, found during binning.
#pragma once

#include <cstdint>

namespace edgewise {

inline constexpr int kMaskSide = 8;  // px

// 8 x 8 pixels of one tile and one depth cell, aligned to 4 px.
struct alignas(16) CoverageMask {
  std::uint32_t rows[2];  // covered pixels: bit 8 y + x, for the upper and the lower four rows
  std::uint32_t block;    // position of the first pixel in the tile: 16 y + x, in blocks of 4 x 4 px
  std::uint32_t payload;
  std::uint32_t z, zx, zy;  // depth (rule 6) at the first pixel, and steps per pixel
  // Order among its cell's indices (bins.h): drawn before the index in slot s if rank <= s + 1, else after.
  std::uint32_t rank;
};
static_assert(sizeof(CoverageMask) == 32);

}  // namespace edgewise
