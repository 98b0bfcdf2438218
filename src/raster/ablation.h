// Switches for the optimizations of the library's backends, to measure the gain of each and to test every
// path. No switch changes a bit of the picture. Internal: not installed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
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
  bool vector_setup = true;        // tiled, scanline: boxes and triangles are set up in vectors
  bool prefetch = true;            // tiled, scanline: triangle records are prefetched; lists always are
  bool coverage_masks = true;      // tiled: binning resolves small triangles to masks; needs vector_setup
  bool hierarchical_depth = true;  // tiled: triangles behind all that a block or tile shows are rejected
  TileStore tile_store = TileStore::automatic;  // tiled, scanline
  // tiled, scanline: all empty tiles of a row are filled together. Else each is drawn like a tile with few
  // triangles: in a buffer, and with that tile's store.
  bool empty_rows = true;
  bool several_tiles_per_task = true;  // tiled, scanline: oneTBB gets up to four tiles at once
  bool stepped = false;  // naive: edges and depth are stepped along rows, not evaluated at each pixel
};

// The switches that differ from the default, as "no prefetch, …"; empty if none does.
std::string describe(const Ablation& ablation);

// The variants that tests compare: each optimization left out, both tile stores, all left out, and the
// stepped naive backend.
constexpr std::array<Ablation, 10> kAblations{{{.vector_setup = false},
                                               {.prefetch = false},
                                               {.coverage_masks = false},
                                               {.hierarchical_depth = false},
                                               {.tile_store = TileStore::cached},
                                               {.tile_store = TileStore::streaming},
                                               {.empty_rows = false},
                                               {.several_tiles_per_task = false},
                                               {false, false, false, false, TileStore::cached, false, false},
                                               {.stepped = true}}};

// A backend that has such switches.
class AblatableBackend : public Backend {
 public:
  Ablation ablation;
};

struct AblatedExecution {
  Execution execution{};
  Ablation ablation{};
};

// Backend::draw() and draw(drawable, …) with optimizations switched off. A backend without switches draws as
// usual.
void draw(Backend& backend, std::span<const ScreenTriangle> triangles, FrameView frame,
          std::uint32_t background, const AblatedExecution& how);
void draw(const Drawable& drawable, Frontend& frontend, const FrontendOptions& options, Backend& backend,
          FrameView frame, std::uint32_t background, const AblatedExecution& how);

}  // namespace edgewise
