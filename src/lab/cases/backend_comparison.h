// Comparing backends: how to draw, differences of frames, hits, covered pixels.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "lab/cases/guarded_frame.h"
#include "raster/traversals.h"

namespace edgewise::lab {

struct DrawOptions {
  Execution execution{};
  TileOptions tiles{};  // for `tiled`
};

// The options that are compared: each optimization left out, and both tile stores.
constexpr std::array<TileOptions, 4> kTileOptions{{{.coverage_masks = false},
                                                   {.hierarchical_depth = false},
                                                   {.tile_store = TileStore::cached},
                                                   {.tile_store = TileStore::streaming}}};

// The options that differ from the default, as "no coverage masks, …"; empty if none does.
std::string describe(const TileOptions& options);

// The backend with these options, or as usual if it has none.
std::unique_ptr<Backend> make(const BackendInfo& info, const TileOptions& options);

// Backend objects by name and options. Each is made when it is first used, and keeps its memory.
class BackendCache {
 public:
  Backend& get(const BackendInfo& info, const TileOptions& options) {
    auto& backend = made_[{info.name, options}];
    if (!backend) backend = make(info, options);
    return *backend;
  }

 private:
  std::map<std::pair<std::string_view, TileOptions>, std::unique_ptr<Backend>> made_;
};

// Fills both planes with values that no backend draws. Call it before a draw that is checked: pixels that the
// backend does not write then differ from every correct picture.
void poison(Framebuffer& frame);

struct FrameDifference {
  std::uint64_t pixels = 0;  // pixels whose depth or payload differ
  int first_x = -1, first_y = -1;
  std::uint64_t outside = 0;  // words written outside the image; 0 if the frame is not a GuardedFrame

  bool any() const { return pixels != 0 || outside != 0; }
};
// Throw std::invalid_argument for frames of different sizes.
FrameDifference compare(const Framebuffer& a, const Framebuffer& b);
FrameDifference compare(const Framebuffer& expected, const GuardedFrame& found);

// Partitions triangles into sets whose bounding boxes are disjoint, so that no triangle of a set occludes
// another one. Returns indices; triangles whose box holds no pixel are left out. Meshes need few sets, scenes
// of deep overlap many.
std::vector<std::vector<std::uint32_t>> disjoint_sets(std::span<const ScreenTriangle> triangles, int width,
                                                      int height);

// How many triangles a backend draws at each pixel, row by row. Draws a whole frame per disjoint set, so
// deep overlap is slow; `on_progress` receives the fraction done.
std::vector<std::uint32_t> count_hits(Backend& backend, std::span<const ScreenTriangle> triangles, int width,
                                      int height, const Execution& execution,
                                      const std::function<void(double)>& on_progress = {});

// The payloads of a frame, row by row.
std::vector<std::uint32_t> payloads_of(const Framebuffer& frame);

// The number of (triangle, covered pixel) pairs: the sum of the hit counts. Uses one exact division per row
// and edge. Divided by the image's pixels this is the overdraw.
std::uint64_t covered_pixels(std::span<const ScreenTriangle> triangles, int width, int height);

}  // namespace edgewise::lab
