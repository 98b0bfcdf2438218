// What drawing in tiles can leave out or choose, for compositions, measurements and tests. No option changes
// a bit of the picture. Internal: not installed.
#pragma once

#include <compare>

namespace edgewise {

// How tiles are stored to the frame and cleared there. Streaming (non-temporal) stores save reading the
// frame's old content and leave the caches to the triangles.
enum class TileStore {
  cached,
  streaming,
  automatic  // raster/policy.h; `streaming` leaves no tile light
};

struct TileOptions {
  bool coverage_masks = true;      // binning resolves small triangles to masks
  bool hierarchical_depth = true;  // triangles behind all that a block or tile shows are rejected
  TileStore tile_store = TileStore::automatic;

  auto operator<=>(const TileOptions&) const = default;
};

}  // namespace edgewise
