// Reversed Z (Lapidous and Jiao, "Optimal depth buffer for low-cost graphics hardware", 1999): 1 near and 0
// far, so that the small steps of floats near 0 coincide with the far distances, which perspective
// compresses.
#include "lab/visibility/methods/depth_buffer.h"

namespace edgewise::lab {

namespace {

// 1 - depth01, computed without the subtraction, which would cancel near the far plane.
template <typename Real>
Real reversed(Real view_z, const VisibilityScene& s) {
  const Real near_z = static_cast<Real>(s.near_z), far_z = static_cast<Real>(s.far_z);
  return near_z / (far_z - near_z) * ((far_z - view_z) / view_z);
}

class Plane {
 public:
  Plane(const VisibilityTriangle& t, const VisibilityScene& s)
      : plane_(t.screen, vertex(t.view_z[0], s), vertex(t.view_z[1], s), vertex(t.view_z[2], s)) {}
  void row(int x, int y) { plane_.row(x, y); }
  float value(int x) const { return plane_.at(x); }
  static bool nearer(float a, float b) { return a > b; }

 private:
  static float vertex(double view_z, const VisibilityScene& s) {
    return reversed(static_cast<float>(view_z), s);
  }
  GradientPlane<float> plane_;
};

}  // namespace

extern const VisibilityMethod visibility_reversed_z;
const VisibilityMethod visibility_reversed_z{
    {"reversed_z", "float depth buffer, 0 is far, plane in float", "Lapidous and Jiao 1999",
     "depth within 16 float steps of the triangle's nearest vertex, times its length over width", false},
    [](const VisibilityScene& scene, VisibilityFrame& frame) {
      draw_depth_buffer<Plane, float>(scene, frame, frame.depth_float, -1.0f);
    },
    [](const VisibilityFrame& frame, std::size_t pixel) {
      return 1.0L - static_cast<long double>(frame.depth_float[pixel]);
    },
    [](long double depth01) { return float_ulp(1.0L - depth01); },
    [](const VisibilityTriangle& t, const VisibilityScene& s) {
      const double nearest = std::min(std::min(t.view_z[0], t.view_z[1]), t.view_z[2]);
      // far - view_z is rounded before it is scaled, which near the far plane adds an error relative to near
      // / far.
      return 16 * 0x1p-24 * magnification(t.screen) * (reversed(nearest, s) + s.near_z / s.far_z);
    }};

}  // namespace edgewise::lab
