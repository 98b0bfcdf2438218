// A scene in the camera's frame: what the laboratory's facing and clipping methods take.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/clipping.h"
#include "lab/facing.h"

namespace edgewise::viewer {

// One mesh seen from the origin along -z. Each triangle has its own three vertices; triangles keep their
// order of submission.
lab::ClippingScene in_view_space(const Scene& scene, lab::Size size);

// Whether each triangle faces the eye, as the method says. `seen` is a scene in view space.
std::vector<std::uint8_t> fronts_of(const lab::FacingMethod& method, const lab::ClippingScene& seen);

}  // namespace edgewise::viewer
