// A scene of over a million triangles with everything that real ones have: instances, depth complexity, back
// faces, indices. 36 torus knots of 49,152 triangles each.
#pragma once

#include "app/source.h"

namespace edgewise::bench {

inline constexpr const char* kCrowdName = "knots";

// A scale below 1 leaves knots out.
app::Source crowd(const SceneRequest& request);

}  // namespace edgewise::bench
