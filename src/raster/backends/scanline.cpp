// The reference: walk the triangle's two boundaries row by row and fill the span between them.
//
// A boundary is walked by exact integers (a digital differential analyser with remainder: Bresenham,
// "Algorithm for computer control of a digital plotter", 1965), so a row costs an addition and a comparison,
// and no division. On the row whose sample lies at height s, the edge from p down to q is at x = p.x + (s -
// p.y) dx / dy; its span begins, or ends, at the first pixel whose sample is not left of that:
//   ceil((x - 128) / 256) = ceil(((p.x - 128) dy + (s - p.y) dx) / (256 dy)).
// Spans that are half open in x, over rows half open in y, are the top-left rule (4). Depth follows rule 6
// from cell to cell, vectorised along the row.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/backends/scanline.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster/bands.h"
#include "raster/kernel_table.h"

#ifndef EDGEWISE_SCANLINE_WALK
#define EDGEWISE_SCANLINE_WALK
namespace edgewise {
namespace {

using namespace contract;

constexpr std::int64_t floor_div(std::int64_t n, std::int64_t d) {
  const std::int64_t q = n / d;
  return q * d > n ? q - 1 : q;
}

// The first pixel not left of an edge, for one row after the other. Fits: dy < 2^23 and |dx| <= 2^23, so
// numerators stay below 2^47 and the denominator below 2^32.
class EdgeWalk {
 public:
  EdgeWalk() = default;
  EdgeWalk(std::int32_t px, std::int32_t py, std::int32_t qx, std::int32_t qy, int first_row) {
    const std::int64_t dx = qx - px, dy = qy - py;
    denominator_ = dy * kSub;
    const std::int64_t numerator = (px - kHalf) * dy + (sample_sub(first_row) - py) * dx + denominator_ - 1;
    pixel_ = floor_div(numerator, denominator_);
    rest_ = numerator - pixel_ * denominator_;
    pixel_step_ = floor_div(dx, dy);
    rest_step_ = (dx - pixel_step_ * dy) * kSub;
  }
  std::int64_t pixel() const { return pixel_; }
  void next_row() {
    pixel_ += pixel_step_;
    rest_ += rest_step_;
    if (rest_ >= denominator_) {
      rest_ -= denominator_;
      ++pixel_;
    }
  }

 private:
  std::int64_t pixel_ = 0, rest_ = 0, denominator_ = 1, pixel_step_ = 0, rest_step_ = 0;
};

// First row whose sample is at or below y.
constexpr int first_row_at(std::int32_t y_sub) {
  return (y_sub + kHalf - 1) >> kSubBits;
}

}  // namespace
}  // namespace edgewise
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<std::int32_t>;

// Tests and writes a vector of pixels; z is the depth of the first lane onwards.
template <class V>
HWY_INLINE void fill_vector(V z, V payload, std::int32_t* depth_at, std::int32_t* payload_at) {
  const Lanes d;
  const auto old_z = hn::LoadU(d, depth_at);
  const auto nearer = hn::Lt(z, old_z);
  if constexpr (hn::MaxLanes(d) == 16) {
    hn::BlendedStore(z, nearer, d, depth_at);
    hn::BlendedStore(payload, nearer, d, payload_at);
  } else {  // masked stores are slow here, or emulated lane by lane
    hn::StoreU(hn::IfThenElse(nearer, z, old_z), d, depth_at);
    hn::StoreU(hn::IfThenElse(nearer, payload, hn::LoadU(d, payload_at)), d, payload_at);
  }
}

// The same for the `count` pixels left at a span's end, fewer than a vector: what lies behind is not touched.
template <class V>
HWY_INLINE void fill_rest(V z, V payload, std::int32_t* depth_at, std::int32_t* payload_at,
                          std::size_t count) {
  const Lanes d;
  if constexpr (hn::MaxLanes(d) >= 8) {
    const auto in_span = hn::FirstN(d, count);
    const auto nearer = hn::And(in_span, hn::Lt(z, hn::MaskedLoad(in_span, d, depth_at)));
    hn::BlendedStore(z, nearer, d, depth_at);
    hn::BlendedStore(payload, nearer, d, payload_at);
  } else {  // without masked loads in the hardware, Highway 1.0.3 reads the whole vector, and aligned
    alignas(16) std::int32_t lanes[hn::MaxLanes(d)];
    hn::Store(z, d, lanes);
    for (std::size_t i = 0; i < count; ++i) {
      if (lanes[i] >= depth_at[i]) continue;
      depth_at[i] = lanes[i];
      payload_at[i] = hn::GetLane(payload);
    }
  }
}

// Fills pixels [begin, end) of a row.
HWY_INLINE void fill_span(FrameView frame, const DepthPlane& plane, std::uint32_t payload, int y, int begin,
                          int end) {
  const Lanes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  auto* depth = reinterpret_cast<std::int32_t*>(frame.depth + y * frame.stride);
  auto* payloads = reinterpret_cast<std::int32_t*>(frame.payload + y * frame.stride);
  const auto colour = hn::Set(d, static_cast<std::int32_t>(payload));
  const auto zx = hn::Set(d, static_cast<std::int32_t>(plane.zx));
  const auto lane_z = hn::Mul(hn::Iota(d, 0), zx);
  const auto step = hn::Set(d, static_cast<std::int32_t>(plane.zx * static_cast<std::uint32_t>(lanes)));

  for (int x = begin; x < end;) {
    const int cell_end = std::min(end, (x / kDepthCell + 1) * kDepthCell);
    auto z = hn::Add(hn::Set(d, static_cast<std::int32_t>(plane.at(x, y))), lane_z);
    for (; x + lanes <= cell_end; x += lanes) {
      fill_vector(z, colour, depth + x, payloads + x);
      z = hn::Add(z, step);
    }
    if (x < cell_end) fill_rest(z, colour, depth + x, payloads + x, static_cast<std::size_t>(cell_end - x));
    x = cell_end;
  }
}

void draw_triangle(const ScreenTriangle& triangle, RowRange rows, FrameView frame) {
  const PixelBox box = pixel_box(triangle, frame.width, frame.height);
  if (box.empty() || box.y0 >= rows.end || box.y1 <= rows.begin) return;
  const Oriented t = orient(triangle);
  if (t.area == 0) return;
  const DepthPlane plane = make_depth(t);

  int top = 0;  // then `next` and `last` follow clockwise: one long edge, and two short ones through the
                // middle vertex
  for (int i = 1; i < 3; ++i)
    if (t.y[i] < t.y[top]) top = i;
  const int next = (top + 1) % 3, last = (top + 2) % 3;
  const bool middle_is_next = t.y[next] < t.y[last];
  const int middle = middle_is_next ? next : last, bottom = middle_is_next ? last : next;

  const auto walk = [&](int from, int to, int row) {
    return EdgeWalk(t.x[from], t.y[from], t.x[to], t.y[to], row);
  };
  const auto fill_rows = [&](int begin, int end, EdgeWalk& long_edge, int from, int to) {
    if (begin >= end) return;
    EdgeWalk short_edge = walk(from, to, begin);
    for (int y = begin; y < end; ++y) {
      // Clockwise on a y-down screen: the vertex after the topmost one lies on the right side.
      const std::int64_t left = middle_is_next ? long_edge.pixel() : short_edge.pixel();
      const std::int64_t right = middle_is_next ? short_edge.pixel() : long_edge.pixel();
      fill_span(frame, plane, triangle.payload, y, static_cast<int>(std::max<std::int64_t>(left, 0)),
                static_cast<int>(std::min<std::int64_t>(right, frame.width)));
      long_edge.next_row();
      short_edge.next_row();
    }
  };
  const int begin = std::max(box.y0, rows.begin), end = std::min(box.y1, rows.end);
  EdgeWalk long_edge = walk(top, bottom, begin);
  const int split = std::clamp(first_row_at(t.y[middle]), begin, end);
  fill_rows(begin, split, long_edge, top, middle);
  fill_rows(split, end, long_edge, middle, bottom);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {
namespace {

class Scanline final : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    const auto draw_triangle = EDGEWISE_KERNEL(draw_triangle, execution.target);
    draw_in_bands(triangles, frame, background, execution, bins_,
                  [&](const ScreenTriangle& t, RowRange rows) { draw_triangle(t, rows, frame); });
  }
  Bins bins_;
};

}  // namespace

extern const std::string_view idea_scanline;
const std::string_view idea_scanline =
    "walks the edges row by row and fills the spans between them; the reference";
std::unique_ptr<Backend> make_scanline() {
  return std::make_unique<Scanline>();
}

}  // namespace edgewise
#endif
