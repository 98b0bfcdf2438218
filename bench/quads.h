// Squares on the pixel grid, as user interfaces, sprites and height maps seen from above have them: every
// edge horizontal, vertical or at 45 degrees, every corner on a pixel's. What a rasterizer does specially for
// flat edges, or forgets to, shows here and in no scene whose vertices are random.
#pragma once

#include "app/source.h"

namespace edgewise::bench {

inline constexpr const char* kQuadsName = "quads";

// Each pixel lies in a square of 16, one of 32 and one of 64 px, which lie at different depths; their
// triangles come in random order. A scale below 1 leaves triangles out.
app::Source quads(const SceneRequest& request);

}  // namespace edgewise::bench
