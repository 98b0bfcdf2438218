// Ours: 31-bit integers on a plane whose base is recomputed every 64 pixels (rule 6).
#include "lab/visibility/methods/depth_buffer.h"

namespace edgewise::lab {

namespace {

class Plane {
 public:
  Plane(const VisibilityTriangle& t, const VisibilityScene&)
      : depth_(contract::make_depth(contract::orient(t.screen))) {}
  void row(int x, int y) {
    y_ = y;
    z_ = depth_.at(x, y);
  }
  std::uint32_t value(int x) {
    if (x % contract::kDepthCell == 0) z_ = depth_.at(x, y_);
    const std::uint32_t z = z_;
    z_ += depth_.zx;
    return z;
  }
  static bool nearer(std::uint32_t a, std::uint32_t b) { return a < b; }

 private:
  contract::DepthPlane depth_;
  int y_ = 0;
  std::uint32_t z_ = 0;
};

}  // namespace

extern const VisibilityMethod visibility_contract31;
const VisibilityMethod visibility_contract31{
    {"contract31", "ours: 31-bit integer plane, base recomputed every 64 px", "edgewise/contract.h, rule 6",
     "depth within 35 steps of 2^-31 of the plane through the vertices' depths, which follow from float "
     "distances, whatever the triangle's shape",
     false},
    [](const VisibilityScene& scene, VisibilityFrame& frame) {
      draw_depth_buffer<Plane, std::uint32_t>(scene, frame, frame.depth32, contract::kDepthClear);
    },
    [](const VisibilityFrame& frame, std::size_t pixel) {
      return (static_cast<long double>(frame.depth32[pixel]) - contract::kDepthHead) / contract::kDepthRange;
    },
    [](long double) { return 1.0L / contract::kDepthRange; },
    // The error of rule 6, and the largest error of a vertex's depth: inside the triangle the two planes are
    // no farther apart than at a vertex.
    [](const VisibilityTriangle& t, const VisibilityScene& s) {
      double worst = 0;
      for (int i = 0; i < 3; ++i) {
        const double given =
            static_cast<double>(t.screen.z[i] - contract::kDepthHead) / contract::kDepthRange;
        worst = std::max(worst, std::abs(given - depth01(t.view_z[i], s)));
      }
      return worst + (contract::kDepthError + 1.0) / contract::kDepthRange;
    }};

}  // namespace edgewise::lab
