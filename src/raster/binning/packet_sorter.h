// Sorts triangles for binning: small ones become coverage masks, the others get cell boxes.
#pragma once

#include <cstdint>

#include "edgewise/screen_triangle.h"
#include "edgewise/simd_target.h"
#include "raster/binning/cell_boxes.h"

namespace edgewise {

inline constexpr int kPacket = 64;

// A packet of kPacket triangles, sorted. Bit i of `boxed` and `masked` belongs to triangle i.
struct SortedPacket {
  // Whether this packet, or one before it, has a position that is not on the coarse grid (core/grid.h).
  bool fine = false;
  std::uint64_t boxed;   // triangles with a cell box: its drawn part holds a sample
  std::uint64_t masked;  // small triangles that cover a sample
  CellBox box[kPacket];  // unspecified for other triangles

  // Bits of quadrants[n]: the masks of the n-th masked triangle, at the upper left, upper right, lower left
  // and lower right of its box.
  static constexpr int kQuadrants = 4;
  std::uint8_t quadrants[kPacket];
  // Halves of a CoverageMask. The last field of the second half is the cell instead of the rank.
  struct alignas(16) Half {
    std::uint32_t field[4];
  };
  Half first[kQuadrants][kPacket], second[kQuadrants][kPacket];
};

// `triangles`: kPacket of them. The scalar target makes no masks, others only if `with_masks`.
using PacketSorter = void (*)(const ScreenTriangle* triangles, const CellGrid& grid, bool with_masks,
                              SortedPacket& out);

// `target` must be resolved.
PacketSorter packet_sorter(SimdTarget target);

}  // namespace edgewise
