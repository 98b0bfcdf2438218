// The scanline rasterizer of the 1990s: 16.16 fixed point in 32 bits. Slopes are truncated to 1/65536, an
// error that grows with the number of rows. Coordinates beyond 32767 px wrap.
#pragma once

#include <cstdint>

#include "lab/coverage/methods/dda.h"

namespace edgewise::lab {

struct Dda1616 {
  static constexpr std::int64_t kOne = 65536, kHalf = kOne / 2;

  static std::int32_t wrapped(std::int64_t v) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(v));
  }

  // The first row or column whose sample is at or after a coordinate.
  static int first_at(std::int32_t v) { return static_cast<int>((v + kHalf - 1) >> 16); }

  class Edge {
   public:
    Edge(std::int64_t px, std::int64_t py, std::int64_t qx, std::int64_t qy, int first_row) {
      const std::int64_t slope = (qx - px) * kOne / (qy - py), down = first_row * kOne + kHalf - py;
      x_ = static_cast<std::uint32_t>(px + (slope * down >> 16));
      slope_ = static_cast<std::uint32_t>(slope);
    }
    int pixel(Window w) const { return std::clamp(first_at(static_cast<std::int32_t>(x_)), w.x0, w.x1()); }
    void step() { x_ += slope_; }

   private:
    std::uint32_t x_, slope_;  // two's complement
  };

  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window w, Plot& plot) {
    const auto fixed = [](float px) {
      return wrapped(static_cast<std::int64_t>(px * 65536.0f + (px < 0 ? -0.5f : 0.5f)));
    };
    const auto vertex = [&](int i) {
      return DdaTriangle<std::int32_t>::Vertex{fixed(t.x_px[i]), fixed(t.y_px[i])};
    };
    const DdaTriangle<std::int32_t> sorted(vertex(0), vertex(1), vertex(2));
    const auto& [top, middle, bottom] = sorted;
    const auto row_at = [&](std::int32_t y) { return std::clamp(first_at(y), w.y0, w.y1()); };
    const int begin = row_at(top.y), split = row_at(middle.y), end = row_at(bottom.y);
    const auto product = [](std::int64_t a, std::int64_t b) {
      return static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b);
    };
    const auto side =
        static_cast<std::int64_t>(product(std::int64_t{middle.x} - top.x, std::int64_t{bottom.y} - top.y) -
                                  product(std::int64_t{middle.y} - top.y, std::int64_t{bottom.x} - top.x));
    if (begin >= end || side == 0) return;
    plot.begin();
    walk_dda<Edge>(sorted, begin, split, end, side > 0, w, plot);
  }
};

}  // namespace edgewise::lab
