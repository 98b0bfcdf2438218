// The table of visibility methods: one entry each, and what they compute.
#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include "lab/visibility/depth_buffer.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

namespace {

// Ours: 31-bit integers on a plane whose base is recomputed every 64 pixels (rule 6).
class ContractPlane {
 public:
  ContractPlane(const VisibilityTriangle& t, const VisibilityScene&)
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

// Reversed Z (Lapidous and Jiao, "Optimal depth buffer for low-cost graphics hardware", 1999): 1 near and 0
// far, so that the small steps of floats near 0 coincide with the far distances, which perspective
// compresses.
// 1 - depth01, computed without the subtraction, which would cancel near the far plane.
template <typename Real>
Real reversed(Real view_z, const VisibilityScene& s) {
  const Real near_z = static_cast<Real>(s.near_z), far_z = static_cast<Real>(s.far_z);
  return near_z / (far_z - near_z) * ((far_z - view_z) / view_z);
}

// A float depth buffer. kDepth(view_z, scene) is the depth of a vertex.
template <auto kDepth, bool kGreaterIsNearer>
class FloatPlane {
 public:
  FloatPlane(const VisibilityTriangle& t, const VisibilityScene& s)
      : plane_(t.screen, vertex(t.view_z[0], s), vertex(t.view_z[1], s), vertex(t.view_z[2], s)) {}
  void row(int x, int y) { plane_.row(x, y); }
  float value(int x) const { return plane_.at(x); }
  static bool nearer(float a, float b) { return kGreaterIsNearer ? a > b : a < b; }

 private:
  static float vertex(double view_z, const VisibilityScene& s) {
    return kDepth(static_cast<float>(view_z), s);
  }
  GradientPlane<float> plane_;
};

using ReversedPlane = FloatPlane<reversed<float>, true>;
// 0 near and 1 far: most floats lie near 0, where perspective puts few depths.
using UsualPlane = FloatPlane<depth01<float>, false>;

// The painter's algorithm (Newell, Newell and Sancha, 1972, without their splitting): sort, then overwrite.
void paint(const VisibilityScene& scene, VisibilityFrame& frame, std::uint32_t id) {
  for_each_span(scene.triangles[id].screen, scene.width, scene.height, [&](int y, int begin, int end) {
    const auto row = frame.visible.begin() + std::ptrdiff_t{y} * scene.width;
    std::fill(row + begin, row + end, id);
  });
}

void clear_visible(const VisibilityScene& scene, VisibilityFrame& frame) {
  frame.visible.assign(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height),
                       kNoTriangle);
}

// Calls add(z) for the distance of each vertex of a face.
template <typename Add>
void for_each_distance(const VisibilityScene& scene, const VisibilityFace& face, Add&& add) {
  const VisibilityTriangle* const fan = scene.triangles.data() + face.first;
  add(fan[0].view_z[0]);
  add(fan[0].view_z[1]);
  for (std::uint32_t i = 0; i < face.count; ++i) add(fan[i].view_z[2]);
}

// The keys of the usual sorts.
double mean_distance(const VisibilityScene& scene, const VisibilityFace& face) {
  double sum = 0;
  for_each_distance(scene, face, [&](double z) { sum += z; });
  return sum / (face.count + 2);
}
double farthest_distance(const VisibilityScene& scene, const VisibilityFace& face) {
  double farthest = 0;
  for_each_distance(scene, face, [&](double z) { farthest = std::max(farthest, z); });
  return farthest;
}

// Sorts faces by descending key(scene, face), equal keys in submission order, into frame.order.
template <typename Key>
void sort_faces(const VisibilityScene& scene, VisibilityFrame& frame, Key&& key) {
  frame.key.resize(scene.faces.size());
  std::transform(scene.faces.begin(), scene.faces.end(), frame.key.begin(),
                 [&](const VisibilityFace& face) { return key(scene, face); });
  frame.order.resize(scene.faces.size());
  std::iota(frame.order.begin(), frame.order.end(), 0u);
  std::stable_sort(frame.order.begin(), frame.order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return frame.key[a] > frame.key[b]; });
}

// Calls draw(triangle) for all triangles of the sorted faces.
template <typename Draw>
void for_each_sorted(const VisibilityScene& scene, const VisibilityFrame& frame, Draw&& draw) {
  for (const std::uint32_t id : frame.order) {
    const VisibilityFace face = scene.faces[id];
    for (std::uint32_t i = 0; i < face.count; ++i) draw(face.first + i);
  }
}

template <typename Key>
void draw_painter(const VisibilityScene& scene, VisibilityFrame& frame, Key&& key) {
  clear_visible(scene, frame);
  sort_faces(scene, frame, key);
  for_each_sorted(scene, frame, [&](std::uint32_t id) { paint(scene, frame, id); });
}

std::pair<double, double> depth_range(const VisibilityScene& scene, std::uint32_t triangle) {
  const auto after =
      std::upper_bound(scene.faces.begin(), scene.faces.end(), triangle,
                       [](std::uint32_t id, const VisibilityFace& face) { return id < face.first; });
  std::pair range{scene.far_z, scene.near_z};
  for_each_distance(scene, *std::prev(after), [&](double z) {
    range = {std::min(range.first, z), std::max(range.second, z)};
  });
  return range;
}

// The painters' promise: of two faces with disjoint depth ranges, the nearer one is painted later.
bool ranges_overlap(const VisibilityScene& scene, std::uint32_t drawn, std::uint32_t truth) {
  const auto a = depth_range(scene, drawn), b = depth_range(scene, truth);
  return a.first <= b.second && b.first <= a.second;
}

// Depth buffers of 16 and 24 bits.
template <int kBits, typename Word, std::vector<Word> VisibilityFrame::*kDepth>
constexpr VisibilityMethod unorm(const MethodInfo& info) {
  using Plane = UnormPlane<kBits, Word>;
  return {info,
          [](const VisibilityScene& scene, VisibilityFrame& frame) {
            draw_depth_buffer<Plane, Word>(scene, frame, frame.*kDepth, Plane::kMax);
          },
          [](const VisibilityFrame& frame, std::size_t pixel) {
            return static_cast<double>((frame.*kDepth)[pixel]) / Plane::kMax;
          },
          Plane::bound01};
}

// A painter's method, by one of the sort keys above.
template <auto kKey>
constexpr VisibilityMethod painter(const MethodInfo& info) {
  return {info,
          [](const VisibilityScene& scene, VisibilityFrame& frame) { draw_painter(scene, frame, kKey); },
          nullptr, nullptr, ranges_overlap};
}

const std::array kMethods{
    VisibilityMethod{
        {"contract31", "ours: 31-bit integer plane, base recomputed every 64 px",
         "edgewise/contract.h, rule 6",
         "depth within 35 steps of 2^-31 of the plane through the vertices' depths, which follow from float "
         "distances, whatever the triangle's shape",
         false},
        [](const VisibilityScene& scene, VisibilityFrame& frame) {
          draw_depth_buffer<ContractPlane, std::uint32_t>(scene, frame, frame.depth32, contract::kDepthClear);
        },
        [](const VisibilityFrame& frame, std::size_t pixel) {
          return (static_cast<double>(frame.depth32[pixel]) - contract::kDepthHead) / contract::kDepthRange;
        },
        // The error of rule 6, and the largest error of a vertex's depth: inside the triangle the two planes
        // are no farther apart than at a vertex.
        [](const VisibilityTriangle& t, const VisibilityScene& s) {
          double worst = 0;
          for (int i = 0; i < 3; ++i) {
            const double given =
                static_cast<double>(t.screen.z[i] - contract::kDepthHead) / contract::kDepthRange;
            worst = std::max(worst, std::abs(given - depth01(t.view_z[i], s)));
          }
          return worst + (contract::kDepthError + 1.0) / contract::kDepthRange;
        }},
    VisibilityMethod{
        {"reversed_z", "float depth buffer, 0 is far, plane in float", "Lapidous and Jiao 1999",
         "depth within 16 float steps of the triangle's nearest vertex, times its length over width", false},
        [](const VisibilityScene& scene, VisibilityFrame& frame) {
          draw_depth_buffer<ReversedPlane, float>(scene, frame, frame.depth_float, -1.0f);
        },
        [](const VisibilityFrame& frame, std::size_t pixel) {
          return 1.0 - static_cast<double>(frame.depth_float[pixel]);
        },
        [](const VisibilityTriangle& t, const VisibilityScene& s) {
          const double nearest = std::min(std::min(t.view_z[0], t.view_z[1]), t.view_z[2]);
          // far - view_z is rounded before it is scaled, which near the far plane adds an error relative to
          // near / far.
          return 16 * 0x1p-24 * magnification(t.screen) * (reversed(nearest, s) + s.near_z / s.far_z);
        }},
    VisibilityMethod{{"float_z", "float depth buffer, 1 is far, plane in float", "most software renderers",
                      "depth within 16 steps of 2^-24, times length over width of the triangle", false},
                     [](const VisibilityScene& scene, VisibilityFrame& frame) {
                       draw_depth_buffer<UsualPlane, float>(scene, frame, frame.depth_float, 2.0f);
                     },
                     [](const VisibilityFrame& frame, std::size_t pixel) {
                       return static_cast<double>(frame.depth_float[pixel]);
                     },
                     [](const VisibilityTriangle& t, const VisibilityScene&) {
                       return 16 * 0x1p-24 * magnification(t.screen);
                     }},
    unorm<24, std::uint32_t, &VisibilityFrame::depth32>(
        {"unorm24", "depth buffer of 24 bits, 1 is far", "DXGI_FORMAT_D24_UNORM_S8_UINT of Direct3D",
         "depth within half a step of 2^-24; wrong triangles only between depths a step apart or less",
         false}),
    unorm<16, std::uint16_t, &VisibilityFrame::depth16>(
        {"unorm16", "depth buffer of 16 bits, 1 is far", "DXGI_FORMAT_D16_UNORM of Direct3D",
         "depth within half a step of 2^-16; wrong triangles only between depths a step apart or less",
         false}),
    painter<farthest_distance>(
        {"painter_farthest", "farthest vertex first, later ones overwrite",
         "Newell, Newell and Sancha 1972, their first sort only",
         "right where any two polygons that meet on the screen have depth ranges apart", false}),
    painter<mean_distance>(
        {"painter_mean", "farthest mean distance first, later ones overwrite", "p5.js engine",
         "right where any two polygons that meet on the screen have depth ranges apart", false}),
    // No visibility at all.
    VisibilityMethod{
        {"submission_order", "no sort and no depth: the last one submitted wins",
         "Pico-8 inside test with culling off", "right where triangles are submitted back to front", false},
        [](const VisibilityScene& scene, VisibilityFrame& frame) {
          clear_visible(scene, frame);
          for (std::uint32_t id = 0; id < scene.triangles.size(); ++id) paint(scene, frame, id);
        },
        nullptr,
        nullptr,
        [](const VisibilityScene&, std::uint32_t drawn, std::uint32_t truth) { return truth < drawn; }},
};

}  // namespace

std::span<const VisibilityMethod> visibility_methods() {
  return kMethods;
}

}  // namespace edgewise::lab
