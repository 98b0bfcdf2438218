// A piece of a small triangle, resolved to pixels: what binning leaves for a tile to draw.
#pragma once

#include <cstdint>

namespace edgewise {

inline constexpr int kMaskSide = 8;  // px

// 8 x 8 pixels of one tile and one depth cell, from a multiple of 4 px on.
struct alignas(16) CoverageMask {
  std::uint32_t rows[2];  // covered pixels: bit 8 y + x of the upper four rows, and of the lower ones
  std::uint32_t block;    // of its first pixel, in the tile: 16 y + x, in blocks of 4 x 4 px
  std::uint32_t payload;
  std::uint32_t z, zx, zy;  // depth (rule 6) at its first pixel, and steps a pixel
  // Its place among its cell's indices (bins.h): before the one in slot s if rank <= s + 1, else behind it.
  std::uint32_t rank;
};
static_assert(sizeof(CoverageMask) == 32);

}  // namespace edgewise
