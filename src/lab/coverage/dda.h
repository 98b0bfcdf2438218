// Scanline methods. They sort the vertices from top to bottom and walk along the edges. Neighbours walk a
// shared edge by the same steps, whether it is their long edge or a short one.
#pragma once

#include <cstdint>
#include <utility>

#include "lab/coverage/plot.h"

namespace edgewise::lab {

template <typename T>
struct DdaTriangle {
  struct Vertex {
    T x, y;
  };
  Vertex top, middle, bottom;

  DdaTriangle(Vertex a, Vertex b, Vertex c) : top(a), middle(b), bottom(c) {
    if (middle.y < top.y) std::swap(middle, top);
    if (bottom.y < middle.y) std::swap(bottom, middle);
    if (middle.y < top.y) std::swap(middle, top);
  }
};

// Fills rows [begin, end) between the long edge and a short one. Edge: pixel(window) is the first pixel at or
// after the edge in the current row; step() goes to the next row.
template <class Edge, class Plot>
void fill_rows(int begin, int end, Edge& long_edge, Edge& short_edge, bool middle_is_right, Window w,
               Plot& plot) {
  Edge &left = middle_is_right ? long_edge : short_edge, &right = middle_is_right ? short_edge : long_edge;
  for (int y = begin; y < end; ++y) {
    plot.span(y, left.pixel(w), right.pixel(w));
    left.step(), right.step();
  }
}

// Fills rows [begin, end) between the long edge and the two short ones, which meet at row `split`.
template <class Edge, class Triangle, class Plot>
void walk_dda(const Triangle& t, int begin, int split, int end, bool middle_is_right, Window w, Plot& plot) {
  Edge long_edge(t.top.x, t.top.y, t.bottom.x, t.bottom.y, begin);
  if (begin < split) {
    Edge short_edge(t.top.x, t.top.y, t.middle.x, t.middle.y, begin);
    fill_rows(begin, split, long_edge, short_edge, middle_is_right, w, plot);
  }
  if (split < end) {
    Edge short_edge(t.middle.x, t.middle.y, t.bottom.x, t.bottom.y, split);
    fill_rows(split, end, long_edge, short_edge, middle_is_right, w, plot);
  }
}

// A scanline rasterizer in floats, as in many engines: each edge's x grows by its slope from row to row, and
// rounding errors accumulate. Neighbours make the same errors at a shared edge, so there are no gaps, but
// edges are displaced.
struct DdaFloat {
  class Edge {
   public:
    Edge(float px, float py, float qx, float qy, int first_row) {
      slope_ = (qx - px) / (qy - py);
      x_ = px + slope_ * (static_cast<float>(first_row) + 0.5f - py) - 0.5f;
    }
    // Clamps before the conversion to int: x may be infinite or NaN if a slope is infinite.
    int pixel(Window w) const {
      const float low = static_cast<float>(w.x0), high = static_cast<float>(w.x1());
      return ceil_int(x_ > low ? (x_ < high ? x_ : high) : low);
    }
    void step() { x_ += slope_; }

   private:
    float slope_, x_;  // x_ is half a pixel less, so that samples lie at whole numbers
  };

  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window w, Plot& plot) {
    const DdaTriangle<float> sorted({t.x_px[0], t.y_px[0]}, {t.x_px[1], t.y_px[1]}, {t.x_px[2], t.y_px[2]});
    const auto& [top, middle, bottom] = sorted;
    const auto row_at = [&](float y) { return std::clamp(ceil_int(y - 0.5f), w.y0, w.y1()); };
    const int begin = row_at(top.y), split = row_at(middle.y), end = row_at(bottom.y);
    const float side = (middle.x - top.x) * (bottom.y - top.y) - (middle.y - top.y) * (bottom.x - top.x);
    if (begin >= end || side == 0.0f) return;
    plot.begin();
    walk_dda<Edge>(sorted, begin, split, end, side > 0.0f, w, plot);
  }
};

// The scanline rasterizer of the 1990s: 16.16 fixed point in 32 bits. Slopes are truncated to 1/65536, an
// error that grows with the number of rows. Coordinates beyond 32767 px wrap.
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

// A scanline rasterizer with vertices rounded to pixels, and with the "height + 1" that avoids a division by
// zero. The slopes of short edges are too small, rows and spans include both ends, and the middle row is
// drawn twice.
struct DdaRounded {
  // Fills the rows from one vertex down to another, both included. The long edge needs no + 1: its height is
  // not 0.
  template <class Plot>
  static void half(DdaTriangle<int>::Vertex top, float long_slope, DdaTriangle<int>::Vertex from,
                   DdaTriangle<int>::Vertex to, Window w, Plot& plot) {
    const int segment_height = to.y - from.y + 1;
    const float short_slope = static_cast<float>(to.x - from.x) / static_cast<float>(segment_height);
    for (int y = std::max(from.y, w.y0); y <= std::min(to.y, w.y1() - 1); ++y) {
      const int a = top.x + static_cast<int>(long_slope * static_cast<float>(y - top.y)),
                b = from.x + static_cast<int>(short_slope * static_cast<float>(y - from.y));
      plot.span(y, std::max(std::min(a, b), w.x0), std::min(std::max(a, b) + 1, w.x1()));
    }
  }

  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window w, Plot& plot) {
    const auto vertex = [&](int i) {
      return DdaTriangle<int>::Vertex{floor_int(t.x_px[i]), floor_int(t.y_px[i])};
    };
    const auto [top, middle, bottom] = DdaTriangle<int>(vertex(0), vertex(1), vertex(2));
    if (top.y == bottom.y) return;
    plot.begin();
    const float long_slope = static_cast<float>(bottom.x - top.x) / static_cast<float>(bottom.y - top.y);
    half(top, long_slope, top, middle, w, plot);
    half(top, long_slope, middle, bottom, w, plot);
  }
};

}  // namespace edgewise::lab
