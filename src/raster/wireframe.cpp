// Draws the edges of triangles only, one pixel wide, by an exact integer rule.
//
// The major axis u of an edge is the axis of its larger extent (x if both are equal); v is the other axis. In
// sub-units (rules 1 and 2), with u0 <= u1 and du = u1 - u0, it draws
//   - in each pixel row or column whose sample s lies in [u0, u1) the pixel floor(v(s) / 256), where
//     v(s) = v0 + (v1 - v0) (s - u0) / du, at the depth floor(z0 + (z1 - z0) (s - u0) / du + 1/2);
//   - the pixels that contain its two ends, floor(u / 256) and floor(v / 256), at their depths.
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
// Widths: v0 du, dv (s - u0) and a frame's rows times 256 du are at most 2^46 each, wherever in the band s
// lies, and twice z du is at most 2^55, so int64 suffices. Quotients are stepped exactly, with their
// remainders, so the start of the drawing changes nothing: division skips the parts outside frame or band.
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

struct Point {
  std::int32_t u, v;
  std::int64_t z;
};

constexpr std::int32_t pixel_of(std::int32_t sub) {
  return sub >> kSubBits;
}
// The first pixel whose sample lies at or after a coordinate.
constexpr std::int32_t first_sample(std::int32_t sub) {
  return (sub + kHalf - 1) >> kSubBits;
}

constexpr std::int64_t floor_divide(std::int64_t n, std::int64_t d) {  // d > 0
  const std::int64_t q = n / d;
  return q - (q * d > n);
}
constexpr std::int64_t ceil_divide(std::int64_t n, std::int64_t d) {
  return -floor_divide(-n, d);
}

// floor(n / d), stepped as n grows by a constant.
class Quotient {
 public:
  constexpr Quotient(std::int64_t n, std::int64_t d, std::int64_t step)
      : value_(floor_divide(n, d)),
        rest_(n - value_ * d),
        divisor_(d),
        step_(floor_divide(step, d)),
        step_rest_(step - step_ * d) {}

  constexpr std::int64_t value() const { return value_; }
  constexpr void advance() {
    value_ += step_, rest_ += step_rest_;
    if (rest_ >= divisor_) ++value_, rest_ -= divisor_;
  }

 private:
  std::int64_t value_, rest_, divisor_, step_, step_rest_;
};

struct PixelRange {
  std::int64_t begin, end;
};

// The part of a range of u where floor((n0 + 256 dv u) / (256 du)) lies in `rows`.
PixelRange clip_to(PixelRange u, Interval rows, std::int64_t n0, std::int64_t dv, std::int64_t du) {
  const std::int64_t low = rows.begin * du * kSub - n0, high = rows.end * du * kSub - n0, step = dv * kSub;
  if (dv > 0) return {std::max(u.begin, ceil_divide(low, step)), std::min(u.end, ceil_divide(high, step))};
  if (dv < 0)
    return {std::max(u.begin, floor_divide(-high, -step) + 1),
            std::min(u.end, floor_divide(-low, -step) + 1)};
  return low <= 0 && 0 < high ? u : PixelRange{0, 0};
}

class Edges {
 public:
  Edges(const FramePart& part, Interval rows)
      : frame_(part.frame), columns_{part.x0, part.frame.width}, rows_(rows) {}

  void draw(const ScreenTriangle& t) const {
    const auto [min_y, max_y] = std::minmax({t.y_sub[0], t.y_sub[1], t.y_sub[2]});
    if (pixel_of(max_y) < rows_.begin || pixel_of(min_y) >= rows_.end) return;
    const auto [min_x, max_x] = std::minmax({t.x_sub[0], t.x_sub[1], t.x_sub[2]});
    if (pixel_of(max_x) < columns_.begin || pixel_of(min_x) >= columns_.end || signed_area(t) == 0) return;
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      draw_end(t, i);
      if (std::abs(t.x_sub[j] - t.x_sub[i]) >= std::abs(t.y_sub[j] - t.y_sub[i]))
        draw_between<true>({t.x_sub[i], t.y_sub[i], t.z[i]}, {t.x_sub[j], t.y_sub[j], t.z[j]}, t.payload);
      else
        draw_between<false>({t.y_sub[i], t.x_sub[i], t.z[i]}, {t.y_sub[j], t.x_sub[j], t.z[j]}, t.payload);
    }
  }

 private:
  void test_and_write(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t payload) const {
    const auto at = static_cast<std::ptrdiff_t>(y * frame_.stride + x);
    const auto depth = static_cast<std::uint32_t>(z);
    if (depth >= frame_.depth[at]) return;
    frame_.depth[at] = depth;
    frame_.payload[at] = payload;
  }

  void draw_end(const ScreenTriangle& t, int i) const {
    const std::int32_t x = pixel_of(t.x_sub[i]), y = pixel_of(t.y_sub[i]);
    if (x >= columns_.begin && x < columns_.end && y >= rows_.begin && y < rows_.end)
      test_and_write(x, y, t.z[i], t.payload);
  }

  template <bool kAlongX>
  void draw_between(Point a, Point b, std::uint32_t payload) const {
    if (a.u > b.u) std::swap(a, b);
    const Interval along = kAlongX ? columns_ : rows_, across = kAlongX ? rows_ : columns_;
    PixelRange range{std::max(first_sample(a.u), along.begin), std::min(first_sample(b.u), along.end)};
    if (range.begin >= range.end) return;
    const std::int64_t du = b.u - a.u, dv = b.v - a.v, dz = b.z - a.z;
    const std::int64_t n0 = a.v * du + dv * (kHalf - a.u);
    const auto [low, high] = std::minmax({pixel_of(a.v), pixel_of(b.v)});
    if (low < across.begin || high >= across.end) range = clip_to(range, across, n0, dv, du);
    if (range.begin >= range.end) return;

    const std::int64_t done = range.begin * kSub + kHalf - a.u;
    Quotient v(n0 + dv * kSub * range.begin, du * kSub, dv * kSub);
    Quotient z(2 * (a.z * du + dz * done) + du, 2 * du, 2 * dz * kSub);
    for (std::int64_t u = range.begin; u < range.end; ++u, v.advance(), z.advance())
      test_and_write(kAlongX ? u : v.value(), kAlongX ? v.value() : u, z.value(), payload);
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
