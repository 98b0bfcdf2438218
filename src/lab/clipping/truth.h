// The truth of clipping scenes, place by place: no plane is cut by anything.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lab/ball.h"
#include "lab/clipping/clipping.h"

namespace edgewise::lab {

struct Box {
  double x0, y0, x1, y1;  // px
};

// A triangle's homogeneous edge functions in whatever arithmetic T is: Ball, whose sign 0 means "cannot
// tell", or rationals.
template <typename T>
class Homogeneous;

// Which triangle shows at a place, and how far away it is. All signs are exact: balls decide most, rationals
// the others. Triangles are sorted into tiles beforehand, by the same functions.
class ClippingOracle {
 public:
  explicit ClippingOracle(const ClippingScene& scene);
  ~ClippingOracle();

  // Places must lie in the image, less than half a pixel from a sample.
  std::uint32_t visible_at(double x_px, double y_px) const;
  // Whether `visible_id` shows there; needs not look at others where one look rules it out. `other` is a good
  // guess of what shows instead.
  bool shows(std::uint32_t triangle, std::uint32_t other, double x_px, double y_px) const;
  // Between near and far, whatever else lies before it.
  bool covers(std::uint32_t triangle, double x_px, double y_px) const;
  double depth01(std::uint32_t triangle, double x_px, double y_px) const;

 private:
  bool nearer(std::uint32_t a, std::uint32_t b, double x_px, double y_px) const;
  void sort_into_tiles(int tile_x, int tile_y, int tiles, std::span<const std::uint32_t> candidates);

  const ClippingScene& scene_;
  std::vector<Homogeneous<Ball>> estimates_;
  std::vector<std::int8_t> facing_;  // exact; 1 front, -1 back, 0 edge-on
  int tiles_x_;
  std::vector<std::vector<std::uint32_t>> in_tile_;
};

}  // namespace edgewise::lab
