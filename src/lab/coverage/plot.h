// The two outputs of a coverage method: draw the pixels, or record them. A method is one template,
//   struct SomeMethod {
//     template <class Plot> static void cover(const UnsnappedTriangle&, Window, Plot&);
//   };
// It calls plot.begin() once if the triangle may have pixels, then plot.pixel(x, y) or plot.span(y, x0, x1)
// for pixels inside the window.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "lab/coverage/coverage.h"

namespace edgewise::lab {

class RunRecorder {
 public:
  RunRecorder(std::uint32_t triangle, std::vector<Run>& runs)
      : triangle_(triangle), runs_(runs), first_(runs.size()) {}
  void begin() {}
  void pixel(int x, int y) { span(y, x, x + 1); }
  void span(int y, int x0, int x1) {
    if (x0 >= x1) return;
    if (runs_.size() > first_ && runs_.back().y == y && runs_.back().x1 == x0)
      runs_.back().x1 = x1;
    else
      runs_.push_back({triangle_, y, x0, x1});
  }

 private:
  std::uint32_t triangle_;
  std::vector<Run>& runs_;
  std::size_t first_;
};

// A depth test with a float depth plane and "less", the same for all methods of the family.
class DepthPlot {
 public:
  DepthPlot(const FloatTriangle& triangle, Canvas& canvas)
      : triangle_(triangle),
        depth_(canvas.depth.data()),
        payload_(canvas.frame.view().payload),
        stride_(canvas.frame.stride()) {}

  void begin() {
    const UnsnappedTriangle& t = triangle_.at;
    const float x1 = t.x_px[1] - t.x_px[0], y1 = t.y_px[1] - t.y_px[0], z1 = t.z01[1] - t.z01[0];
    const float x2 = t.x_px[2] - t.x_px[0], y2 = t.y_px[2] - t.y_px[0], z2 = t.z01[2] - t.z01[0];
    const float scale = 1.0f / (x1 * y2 - y1 * x2);
    zx_ = (z1 * y2 - z2 * y1) * scale;
    zy_ = (z2 * x1 - z1 * x2) * scale;
    z_ = t.z01[0] - zx_ * (t.x_px[0] - 0.5f) - zy_ * (t.y_px[0] - 0.5f);
  }

  void pixel(int x, int y) const {
    const float z = z_ + zy_ * static_cast<float>(y) + zx_ * static_cast<float>(x);
    const std::ptrdiff_t at = y * stride_ + x;
    if (!(z < depth_[at])) return;
    depth_[at] = z;
    payload_[at] = triangle_.payload;
  }

  // Selects instead of branches let the compiler vectorize the loop, for the baseline instructions.
  void span(int y, int x0, int x1) const {
    const float row_z = z_ + zy_ * static_cast<float>(y), step = zx_;
    float* __restrict depth = depth_ + y * stride_;
    std::uint32_t* __restrict payload = payload_ + y * stride_;
    const std::uint32_t colour = triangle_.payload;
    for (int x = x0; x < x1; ++x) {
      const float z = row_z + step * static_cast<float>(x), old_z = depth[x];
      const std::uint32_t old_colour = payload[x];
      const bool nearer = z < old_z;
      depth[x] = nearer ? z : old_z;
      payload[x] = nearer ? colour : old_colour;
    }
  }

 protected:
  FloatTriangle triangle_;
  float* depth_;
  std::uint32_t* payload_;
  std::ptrdiff_t stride_;
  float zx_ = 0, zy_ = 0, z_ = 0;
};

template <class Method, class Plot>
void draw_with(const CoverageInput& input, Canvas& canvas) {
  const Window window = canvas.window();
  std::fill(canvas.depth.begin(), canvas.depth.end(), std::numeric_limits<float>::infinity());
  for (int y = 0; y < window.height; ++y) {
    std::uint32_t* row = canvas.frame.view().payload + y * canvas.frame.stride();
    std::fill(row, row + window.width, 0u);
  }
  for (const auto& triangle : input.floats) {
    Plot plot(triangle, canvas);
    Method::cover(triangle.at, window, plot);
  }
}

// The form of a method's draw() for a target. A method without SIMD form has one for all targets.
using DrawForm = void (*)(const CoverageInput&, Canvas&);
using DrawForms = DrawForm (*)(SimdTarget);

// `forms` is null for a method without SIMD form.
template <class Method>
CoverageMethod make_coverage_method(const MethodInfo& info, const CoveragePromise& promise,
                                    DrawForms forms = nullptr) {
  return {.info = info,
          .promise = promise,
          .draw =
              [forms](const CoverageInput& input, Canvas& canvas, const Execution& execution) {
                const SimdTarget target = resolve(execution.target);
                (forms == nullptr ? draw_with<Method, DepthPlot> : forms(target))(input, canvas);
              },
          .runs =
              [](const CoverageInput& input, Window window, std::vector<Run>& runs) {
                for (std::size_t i = 0; i < input.floats.size(); ++i) {
                  RunRecorder plot(static_cast<std::uint32_t>(i), runs);
                  Method::cover(input.floats[i].at, window, plot);
                }
              },
          .simd = forms != nullptr};
}

// Fills each row between the left and the right edges of a triangle. This is correct if each edge accepts
// exactly the samples on one side of a crossing. A crossing moves little from row to row, so the search
// starts at the previous row's: the number of tests is proportional to the box's rows plus columns, not to
// its pixels. The tests are the method's own, so the pixels do not change.
//
// Edge: faces_right() is true if the triangle lies to its right; row(y).accepts(x) tests a sample. Along a
// row accepts(x) must change at most once, from false to true for edges that face right, else from true to
// false.
template <class Edge, class Plot>
void fill_between(const Edge (&edges)[3], const PixelBounds& box, Plot& plot) {
  // A triangle with area has at least one edge that faces right and one that faces left.
  const Edge *left[3], *right[3];
  int lefts = 0, rights = 0;
  for (const Edge& edge : edges)
    if (edge.faces_right())
      left[lefts++] = &edge;
    else
      right[rights++] = &edge;
  const Edge l0 = *left[0], l1 = *left[lefts - 1], r0 = *right[0], r1 = *right[rights - 1];
  int begin = box.x0, end = box.x1;
  for (int y = box.y0; y < box.y1; ++y) {
    const auto from0 = l0.row(y), from1 = l1.row(y), to0 = r0.row(y), to1 = r1.row(y);
    const auto after = [&](int x) { return from0.accepts(x) & from1.accepts(x); };
    const auto before = [&](int x) { return to0.accepts(x) & to1.accepts(x); };
    while (begin > box.x0 && after(begin - 1)) --begin;
    while (begin < box.x1 && !after(begin)) ++begin;
    while (end < box.x1 && before(end)) ++end;
    while (end > box.x0 && !before(end - 1)) --end;
    if (begin < end) plot.span(y, begin, end);
  }
}

// Rounds half to even, for |v| < 2^51: the sum with 1.5 * 2^52 has no fraction bits.
inline std::int64_t round_half_even(double v) {
  constexpr double kMagic = 6755399441055744.0;
  return std::bit_cast<std::int64_t>(v + kMagic) - std::bit_cast<std::int64_t>(kMagic);
}

// Without SSE 4.1, std::floor is a function call.
inline int floor_int(float v) {
  const int whole = static_cast<int>(v);
  return whole - (static_cast<float>(whole) > v);
}
inline int ceil_int(float v) {
  const int whole = static_cast<int>(v);
  return whole + (static_cast<float>(whole) < v);
}

}  // namespace edgewise::lab
