// A depth buffer of 16 bits.
#include "lab/visibility/methods/depth_buffer.h"

namespace edgewise::lab {

namespace {
using Plane = UnormPlane<16, std::uint16_t>;
}

extern const VisibilityMethod visibility_unorm16;
const VisibilityMethod visibility_unorm16{
    {"unorm16", "depth buffer of 16 bits, 1 is far", "DXGI_FORMAT_D16_UNORM of Direct3D",
     "depth within half a step of 2^-16; wrong triangles only between depths a step apart or less", false},
    [](const VisibilityScene& scene, VisibilityFrame& frame) {
      draw_depth_buffer<Plane, std::uint16_t>(scene, frame, frame.depth16, Plane::kMax);
    },
    [](const VisibilityFrame& frame, std::size_t pixel) {
      return static_cast<long double>(frame.depth16[pixel]) / Plane::kMax;
    },
    Plane::ulp01,
    Plane::bound01};

}  // namespace edgewise::lab
