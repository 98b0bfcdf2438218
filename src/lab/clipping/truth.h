// The exact picture of a scene at any point of the screen, from its vertices, instances and camera: it shares
// no stage with the front end, and clips nothing.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lab/clipping/clipping.h"
#include "lab/truth/ball_arithmetic.h"

namespace edgewise::lab {

struct Box {
  double x0, y0, x1, y1;  // px
};

// A triangle's homogeneous edge functions in the arithmetic of T: Ball, whose sign 0 means "undecided", or
// rationals.
template <typename T>
class Homogeneous;

// Finds the visible triangle at a point of the screen, and its depth. All signs are exact: balls decide most
// of them, rationals the others. The constructor bins the triangles into tiles, by the same edge functions.
class ClippingOracle {
 public:
  // The scene must outlive the oracle. A triangle with a vertex that is not finite draws nothing. Triangles
  // are numbered in submission order. The camera's rotation and the instances' matrices are those that
  // doubles hold; from there on, all is exact.
  ClippingOracle(const Scene& scene, Size size, Cull cull);
  ~ClippingOracle();

  // The visible triangle or kNoTriangle. Points must lie in the image, less than half a pixel from a sample.
  std::uint32_t visible_at(double x_px, double y_px) const;
  // Whether `triangle` (or kNoTriangle) is visible at the point. `other` is a guess of the visible triangle,
  // which often answers without testing all triangles.
  bool shows(std::uint32_t triangle, std::uint32_t other, double x_px, double y_px) const;
  // Whether the triangle covers the point between near and far, occluded or not.
  bool covers(std::uint32_t triangle, double x_px, double y_px) const;
  double depth01(std::uint32_t triangle, double x_px, double y_px) const;

 private:
  bool nearer(std::uint32_t a, std::uint32_t b, double x_px, double y_px) const;
  void sort_into_tiles(int tile_x, int tile_y, int tiles, std::span<const std::uint32_t> candidates);

  Homogeneous<mpq_class> exact(std::uint32_t triangle) const;

  const Scene& scene_;
  Size size_;
  std::vector<std::pair<std::size_t, std::size_t>> sources_;  // by triangle: instance, triangle of its mesh
  std::vector<Homogeneous<Ball>> estimates_;
  std::vector<std::int8_t> facing_;  // exact; 1 front, -1 back, 0 edge-on or culled
  int tiles_x_;
  std::vector<std::vector<std::uint32_t>> in_tile_;
};

// Puts a picture right: replaces the triangles that the exact picture shows nowhere within kHairlinePx of the
// sample, ties within kDepthTie01 apart, by the exact ones. `picture` holds a triangle or kNoTriangle per
// pixel, row by row. Returns the number of replaced pixels.
std::uint64_t correct(std::span<std::uint32_t> picture, Size size, const ClippingOracle& oracle, int threads);

}  // namespace edgewise::lab
