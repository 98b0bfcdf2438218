// A float depth buffer, 0 near and 1 far: most floats lie near 0, where perspective puts few depths.
#include "lab/visibility/methods/depth_buffer.h"

namespace edgewise::lab {

namespace {

class Plane {
 public:
  Plane(const VisibilityTriangle& t, const VisibilityScene& s)
      : plane_(t.screen, vertex(t.view_z[0], s), vertex(t.view_z[1], s), vertex(t.view_z[2], s)) {}
  void row(int x, int y) { plane_.row(x, y); }
  float value(int x) const { return plane_.at(x); }
  static bool nearer(float a, float b) { return a < b; }

 private:
  static float vertex(double view_z, const VisibilityScene& s) {
    return depth01(static_cast<float>(view_z), s);
  }
  GradientPlane<float> plane_;
};

}  // namespace

extern const VisibilityMethod visibility_float_z;
const VisibilityMethod visibility_float_z{
    {"float_z", "float depth buffer, 1 is far, plane in float", "most software renderers",
     "depth within 16 steps of 2^-24, times length over width of the triangle", false},
    [](const VisibilityScene& scene, VisibilityFrame& frame) {
      draw_depth_buffer<Plane, float>(scene, frame, frame.depth_float, 2.0f);
    },
    [](const VisibilityFrame& frame, std::size_t pixel) {
      return static_cast<long double>(frame.depth_float[pixel]);
    },
    float_ulp,
    [](const VisibilityTriangle& t, const VisibilityScene&) {
      return 16 * 0x1p-24 * magnification(t.screen);
    }};

}  // namespace edgewise::lab
