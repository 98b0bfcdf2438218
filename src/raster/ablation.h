// Switches for the optimizations of the library's backends, to measure the gain of each and to test every
// path. No switch changes a bit of the picture. Internal: not installed.
#pragma once

#include <compare>
#include <memory>
#include <string>

#include "edgewise/backend.h"

namespace edgewise {

// How finished tiles are copied to the frame. Streaming (non-temporal) stores save reading the frame's old
// content and leave the caches to the triangles; a frame that stays in the last-level cache is written faster
// by cached stores.
enum class TileStore {
  cached,
  streaming,
  automatic  // tile_store_for() in raster/tiles.h
};

struct Ablation {
  bool vector_setup = true;        // tiled: boxes and triangles are set up in vectors
  bool prefetch = true;            // tiled: triangle records are prefetched; lists always are
  bool coverage_masks = true;      // tiled: binning resolves small triangles to masks; needs vector_setup
  bool hierarchical_depth = true;  // tiled: triangles behind all that a block or tile shows are rejected
  TileStore tile_store = TileStore::automatic;  // tiled
  // tiled: all empty tiles of a row are filled together. Else each is drawn like a tile with few
  // triangles: in a buffer, and with that tile's store.
  bool empty_rows = true;
  bool several_tiles_per_task = true;  // tiled: oneTBB gets up to four tiles at once
  bool vector_test = true;             // scanline: narrow triangles are tested by edge functions
  bool stepped = false;  // naive: edges and depth are stepped along rows, not evaluated at each pixel

  auto operator<=>(const Ablation&) const = default;
};

// The switches that differ from the default, as "no prefetch, …"; empty if none does.
std::string describe(const Ablation& ablation);

std::unique_ptr<Backend> make_tiled(const Ablation& ablation);
std::unique_ptr<Backend> make_scanline(const Ablation& ablation);
std::unique_ptr<Backend> make_naive(const Ablation& ablation);

// The backend with these switches, or as usual if it has none.
std::unique_ptr<Backend> make(const BackendInfo& info, const Ablation& ablation);

}  // namespace edgewise
