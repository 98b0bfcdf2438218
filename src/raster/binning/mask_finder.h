// Sorts triangles for binning: small ones become coverage masks, the others get cell boxes (mask_finder.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/little_endian.h"
#include "raster/binning/cell_boxes.h"
#include "raster/binning/mask_lists.h"

namespace edgewise {

// A packet of up to kPacket triangles, sorted. Bit i of `boxed` and `masked` belongs to triangle i.
struct SortedTriangles {
  std::uint64_t boxed;   // triangles with a cell box
  std::uint64_t masked;  // small triangles that cover a sample
  CellBoxes boxes;

  // Bits of quadrants[n]: the masks of the n-th masked triangle, at the upper left, upper right, lower left
  // and lower right of its box.
  static constexpr int kQuadrants = 4, kCapacity = kPacket;
  std::uint8_t quadrants[kCapacity + 7];  // 4 bits each; read eight at a time
  // Halves of a CoverageMask. The last field of the second half is the cell instead of the rank.
  struct alignas(16) Half {
    std::uint32_t field[4];
  };
  Half first[kQuadrants][kCapacity], second[kQuadrants][kCapacity];

  // The quadrants of masked triangles n … n + 7, none from `end` on. Bit 4 i + q is quadrant q of triangle
  // n + i.
  std::uint32_t quadrants_of_eight(std::size_t n, std::size_t end) const {
    std::uint64_t bits;
    std::memcpy(&bits, quadrants + n, sizeof bits);
    bits = little_endian(bits);
    if (end - n < 8) bits &= (std::uint64_t{1} << (end - n) * 8) - 1;
    bits = (bits | bits >> 4) & 0x00FF00FF00FF00FF;
    bits = (bits | bits >> 8) & 0x0000FFFF0000FFFF;
    return static_cast<std::uint32_t>(bits | bits >> 16);
  }
};

// `triangles`: kPacket of them. `prefetch`: prefetch the triangles that follow in memory.
using MaskFinder = void (*)(const ScreenTriangle* triangles, const CellGrid& grid, bool prefetch,
                            SortedTriangles& out);

// Null for the scalar target. `target` must be resolved.
MaskFinder mask_finder(SimdTarget target);

}  // namespace edgewise
