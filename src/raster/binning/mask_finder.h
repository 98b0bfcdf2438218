// Sorts triangles for the bins: small ones become patches, of the others it tells which cells their boxes
// touch. See mask_finder.cpp for how.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "raster/binning/cell_boxes.h"
#include "raster/binning/coverage_mask.h"

namespace edgewise {

// Up to kBoxesAtOnce triangles, sorted. Bit i of a set is triangle i's.
struct SortedTriangles {
  std::uint64_t boxed;   // lie in boxes
  std::uint64_t masked;  // small ones that cover a sample
  CellBoxes boxes;

  // The patches of the n-th patched triangle: of windows that lie at the box's upper left, upper right, lower
  // left and lower right, those whose bits are set.
  static constexpr int kQuadrants = 4, kRoom = kBoxesAtOnce;
  std::uint8_t windows[kRoom + 7];  // four bits; are read eight at a time
  // Halves of patches, but the last field is the cell.
  struct alignas(16) Half {
    std::uint32_t field[4];
  };
  Half first[kQuadrants][kRoom], second[kQuadrants][kRoom];

  // Bit 4 i + w: window w of the (n + i)-th patched triangle, of eight, but of none from the end-th on.
  std::uint32_t quadrants_of_eight(std::size_t n, std::size_t end) const {
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t bits;
    std::memcpy(&bits, windows + n, sizeof bits);
    if (end - n < 8) bits &= (std::uint64_t{1} << (end - n) * 8) - 1;
    bits = (bits | bits >> 4) & 0x00FF00FF00FF00FF;
    bits = (bits | bits >> 8) & 0x0000FFFF0000FFFF;
    return static_cast<std::uint32_t>(bits | bits >> 16);
  }
};

// `triangles`: kBoxesAtOnce records. `prefetch`: those that follow in memory are asked for.
using MaskFinder = void (*)(const ScreenTriangle* triangles, const CellGrid& grid, bool prefetch,
                            SortedTriangles& out);

// Null where the target has no vectors. `target` must be resolved.
MaskFinder mask_finder(SimdTarget target);

}  // namespace edgewise
