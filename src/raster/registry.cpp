// The backends, each a name and its parts: a traversal, a fill and optimizations. Add a line below, or a
// source file that defines make_NAME() and summary_NAME, by CMake's EDGEWISE_BACKENDS.
#include <array>

#include "core/nearest_name.h"
#include "edgewise/backend.h"
#include "raster/traversals.h"

#ifndef EDGEWISE_MORE_BACKENDS
#define EDGEWISE_MORE_BACKENDS(X)
#endif

namespace edgewise {

namespace {

using MakeBackend = std::unique_ptr<Backend> (*)();

template <FrameKernel (*kFill)(SimdTarget)>
constexpr MakeBackend kBands = [] { return band_backend(kFill); };

template <TileKernel (*kFill)(SimdTarget), bool kHiZ, bool kMasks>
constexpr MakeBackend kTiles =
    [] { return tile_backend(kFill, {.coverage_masks = kMasks, .hierarchical_depth = kHiZ}); };

}  // namespace

std::unique_ptr<Backend> make_tiled(const TileOptions& options) {
  return tile_backend(tile_edges, options, frame_spans);
}

#define EDGEWISE_DECLARE(name)                  \
  extern const std::string_view summary_##name; \
  std::unique_ptr<Backend> make_##name();
EDGEWISE_MORE_BACKENDS(EDGEWISE_DECLARE)
EDGEWISE_DECLARE(wireframe)

std::span<const BackendInfo> backends() {
#define EDGEWISE_ENTRY(name) BackendInfo{#name, summary_##name, make_##name},
  static const auto list = std::to_array<BackendInfo>({
      {"scanline", "walks the edges row by row and fills the spans between them; the reference",
       kBands<frame_spans>},
      {"naive", "tests every pixel of the bounding box", kBands<frame_boxes>},
      {"tiled", "SIMD edge functions over tiles, tiles on threads, every pixel independent",
       [] { return make_tiled({}); }},
      EDGEWISE_MORE_BACKENDS(EDGEWISE_ENTRY)  //
  });
  return list;
}

std::span<const BackendInfo> compositions() {
  static constexpr auto kList = std::to_array<BackendInfo>({
      {"bands+spans", "bands of rows in the frame, filled by spans", kBands<frame_spans>},
      {"bands+edges", "bands of rows in the frame, filled by edge functions", kBands<frame_edges>},
      {"tiles+spans", "tiles in buffers, filled by spans", kTiles<tile_spans, false, false>},
      {"tiles+spans+hiz", "the same with HiZ", kTiles<tile_spans, true, false>},
      {"tiles+spans+masks", "with coverage masks of small triangles", kTiles<tile_spans, false, true>},
      {"tiles+spans+hiz+masks", "with both", kTiles<tile_spans, true, true>},
      {"tiles+edges", "tiles in buffers, filled by edge functions", kTiles<tile_edges, false, false>},
      {"tiles+edges+hiz", "the same with HiZ", kTiles<tile_edges, true, false>},
      {"tiles+edges+masks", "with coverage masks of small triangles", kTiles<tile_edges, false, true>},
      {"tiles+edges+hiz+masks", "with both", kTiles<tile_edges, true, true>},
  });
  return kList;
}

const BackendInfo& find_backend(std::string_view name) {
  return find_named("backend", name, name.find('+') != name.npos ? compositions() : backends(),
                    &BackendInfo::name);
}

const BackendInfo& wireframe() {
  static const BackendInfo info{"wireframe", summary_wireframe, make_wireframe};
  return info;
}

// Initialized when the library is loaded: a child forked during a later initialization would wait for its
// lock.
[[maybe_unused]] static const auto kMade = (wireframe(), backends());

}  // namespace edgewise
