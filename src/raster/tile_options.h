// What drawing in tiles can leave out or choose, for compositions, measurements and tests. No option changes
// a bit of the picture. Internal: not installed.
#pragma once

#include <compare>
namespace edgewise {

// How finished tiles are copied to the frame. Streaming (non-temporal) stores save reading the frame's old
// content and leave the caches to the triangles; a frame that stays in the last-level cache is written faster
// by cached stores.
enum class TileStore {
  cached,
  streaming,
  automatic  // tile_store_for() in raster/policy.h
};

struct TileOptions {
  bool coverage_masks = true;      // binning resolves small triangles to masks
  bool hierarchical_depth = true;  // triangles behind all that a block or tile shows are rejected
  bool light_tiles = true;         // tiles with few triangles are drawn in the frame, not in a buffer
  TileStore tile_store = TileStore::automatic;

  auto operator<=>(const TileOptions&) const = default;
};

}  // namespace edgewise
