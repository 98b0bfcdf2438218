// Draws the edges of triangles only, one pixel wide, by an exact integer rule.
//
// The major axis u of an edge is the axis of its larger extent (x if both are equal); v is the other axis. In
// 2^-15 px (rules 1 and 2), with u0 <= u1 and du = u1 - u0, it draws
//   - in each pixel row or column whose sample s lies in [u0, u1) the pixel floor(v(s) / 2^15), where
//     v(s) = v0 + (v1 - v0) (s - u0) / du, at the depth floor(z0 + (z1 - z0) (s - u0) / du + 1/2);
//   - the pixels that contain its two ends, floor(u / 2^15) and floor(v / 2^15), at their depths.
// Depth test, ties and payload follow the contract (rules 7 and 8). A triangle without area draws nothing.
//
// The rule does not depend on which end comes first, so neighbours draw their shared edge in the same pixels
// at the same depths. Ranges are half-open, so if a vertex splits an edge, its parts share the samples, none
// twice and none lost. Outlines have no gaps: from one sample's pixel to the next, and from the outermost one
// to the end's pixel, it is one step along u and, since |dv| <= du, at most one along v. Between its ends an
// edge equals Bresenham's line ("Algorithm for computer control of a digital plotter", 1965) and that of
// D3D11.3 (functional specification 3.4, aliased lines). D3D draws a pixel if the line leaves the diamond |x|
// + |y| < 1/2 around its sample, so never the pixel that the line ends in. That suits line strips but depends
// on the direction, and triangles traverse a shared edge in opposite directions.
//
// Widths: v0 du and dv (s - u0) are at most 2^60 each, and twice z du is at most 2^62, so int64 suffices.
// Quotients are stepped exactly, with their remainders, so a drawing that starts inside the edge has the same
// pixels. Doubles find which pixels outside the frame or band to skip; half a pixel is left for rounding.
//
// On several threads, bands of the frame are drawn in parallel, and each band visits all triangles: comparing
// y is cheap beside drawing an edge. Bins are no help, since they drop triangles without a sample in their
// box, and an edge may draw pixels outside it.
#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "raster/clear.h"

namespace edgewise {

using namespace contract;

namespace {

constexpr std::int32_t pixel_of(std::int32_t q15) {
  return q15 >> kFineBits;
}
// The first pixel whose sample lies at or after a coordinate.
constexpr std::int32_t first_sample(std::int32_t q15) {
  return (q15 + kHalf_q15 - 1) >> kFineBits;
}

// floor(n / d), stepped as n grows by a constant. d > 0.
class Quotient {
 public:
  Quotient(std::int64_t n, std::int64_t d, std::int64_t step) : divisor_(d) {
    divide(n, value_, rest_);
    divide(step, step_, step_rest_);
  }

  std::int64_t value() const { return value_; }
  void advance() {
    value_ += step_, rest_ += step_rest_;
    if (rest_ >= divisor_) ++value_, rest_ -= divisor_;
  }

 private:
  void divide(std::int64_t n, std::int64_t& quotient, std::int64_t& rest) const {
    quotient = n / divisor_, rest = n % divisor_;
    if (rest < 0) --quotient, rest += divisor_;
  }

  std::int64_t divisor_, value_, rest_, step_, step_rest_;
};

class Edges {
 public:
  Edges(const FramePart& part, Interval rows)
      : frame_(part.frame), columns_{part.x0, part.frame.width}, rows_(rows) {}

  void draw(const ScreenTriangle& t) const {
    const auto [min_y, max_y] = std::minmax({t.y_q15[0], t.y_q15[1], t.y_q15[2]});
    if (pixel_of(max_y) < rows_.begin || pixel_of(min_y) >= rows_.end) return;
    const auto [min_x, max_x] = std::minmax({t.x_q15[0], t.x_q15[1], t.x_q15[2]});
    if (pixel_of(max_x) < columns_.begin || pixel_of(min_x) >= columns_.end || signed_area(t) == 0) return;
    for (int i = 0; i < 3; ++i) {
      test_and_write(pixel_of(t.x_q15[i]), pixel_of(t.y_q15[i]), t.z[i], t.payload);
      draw_between(t, i, i == 2 ? 0 : i + 1);
    }
  }

 private:
  void test_and_write(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t payload) const {
    if (x < columns_.begin || x >= columns_.end || y < rows_.begin || y >= rows_.end) return;
    const auto at = static_cast<std::ptrdiff_t>(y * frame_.stride + x);
    const auto depth = static_cast<std::uint32_t>(z);
    if (depth >= frame_.depth[at]) return;
    frame_.depth[at] = depth;
    frame_.payload[at] = payload;
  }

  void draw_between(const ScreenTriangle& t, int i, int j) const {
    const bool along_x = std::abs(t.x_q15[j] - t.x_q15[i]) >= std::abs(t.y_q15[j] - t.y_q15[i]);
    const std::int32_t *const us = along_x ? t.x_q15 : t.y_q15, *const vs = along_x ? t.y_q15 : t.x_q15;
    if (us[i] > us[j]) std::swap(i, j);
    const Interval along = along_x ? columns_ : rows_, across = along_x ? rows_ : columns_;
    int begin = std::max(first_sample(us[i]), along.begin), end = std::min(first_sample(us[j]), along.end);
    if (begin >= end) return;
    const std::int64_t du = us[j] - us[i], dv = vs[j] - vs[i], dz = std::int64_t{t.z[j]} - t.z[i];
    if (const auto [low, high] = std::minmax({vs[i], vs[j]});
        pixel_of(low) < across.begin || pixel_of(high) >= across.end) {
      if (dv == 0) return;
      const double step = static_cast<double>(du) / static_cast<double>(dv);
      const auto u_at = [&](int v) { return (us[i] + (v * kPixel_q15 - vs[i]) * step) / kPixel_q15; };
      const auto [first, last] = std::minmax({u_at(across.begin), u_at(across.end)});
      const int least = begin;
      begin = static_cast<int>(std::clamp<double>(first - 1, least, end));
      end = static_cast<int>(std::clamp<double>(last + 1, least, end));
    }
    const std::int64_t done = sample_q15(begin) - us[i];
    Quotient v(vs[i] * du + dv * done, du * kPixel_q15, dv * kPixel_q15);
    Quotient z(2 * (t.z[i] * du + dz * done) + du, 2 * du, 2 * dz * kPixel_q15);
    for (int u = begin; u < end; ++u, v.advance(), z.advance())
      test_and_write(along_x ? u : v.value(), along_x ? v.value() : u, z.value(), t.payload);
  }

  FrameView frame_;
  Interval columns_, rows_;
};

class Wireframe final : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) override {
    // Several per thread, because edges are not evenly distributed.
    constexpr int kBandsPerThread = 4;
    const int height = part.frame.height - part.y0;
    const int bands = execution.threads == 1 ? 1 : std::min(execution.threads * kBandsPerThread, height);
    const auto row = [&](int band) {
      return part.y0 + static_cast<int>(std::int64_t{band} * height / bands);
    };
    const ClearKernel clear = clear_kernel(execution.target);
    parallel_for(execution.threads, bands, [&](int band) {
      const Interval rows{row(band), row(band + 1)};
      const Interval columns{part.x0, part.frame.width};
      if (part.clear) clear({{&columns, 1}, rows.begin, rows.end, part});
      const Edges edges(part, rows);
      for (const ScreenTriangle& triangle : triangles) edges.draw(triangle);
    });
  }
};

}  // namespace

extern const std::string_view summary_wireframe;
const std::string_view summary_wireframe = "draws the edges only, by an exact line rule";
std::unique_ptr<Backend> make_wireframe() {
  return std::make_unique<Wireframe>();
}

}  // namespace edgewise
