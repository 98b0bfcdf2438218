// How many triangles each part has drawn, for tests. Only builds with EDGEWISE_COUNT_FILLS count.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace edgewise {

enum class Part { frame_boxes, frame_spans, frame_edges, tile_spans, tile_edges, masks, hiz };

#ifdef EDGEWISE_COUNT_FILLS
inline std::array<std::atomic<std::uint64_t>, 7> fill_counts;
inline void count(Part part, std::uint64_t triangles = 1) {
  fill_counts[static_cast<std::size_t>(part)] += triangles;
}
#else
inline void count(Part, std::uint64_t = 1) {}
#endif

}  // namespace edgewise
