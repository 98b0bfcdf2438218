// A depth buffer of 24 bits.
#include "lab/visibility/methods/depth_buffer.h"

namespace edgewise::lab {

namespace {
using Plane = UnormPlane<24, std::uint32_t>;
}

extern const VisibilityMethod visibility_unorm24;
const VisibilityMethod visibility_unorm24{
    {"unorm24", "depth buffer of 24 bits, 1 is far", "DXGI_FORMAT_D24_UNORM_S8_UINT of Direct3D",
     "depth within half a step of 2^-24; wrong triangles only between depths a step apart or less", false},
    [](const VisibilityScene& scene, VisibilityFrame& frame) {
      draw_depth_buffer<Plane, std::uint32_t>(scene, frame, frame.depth32, Plane::kMax);
    },
    [](const VisibilityFrame& frame, std::size_t pixel) {
      return static_cast<long double>(frame.depth32[pixel]) / Plane::kMax;
    },
    Plane::ulp01,
    Plane::bound01};

}  // namespace edgewise::lab
