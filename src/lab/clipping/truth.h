// The exact picture of a scene at any point of the screen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lab/clipping/clipping.h"
#include "lab/projection/truth.h"

namespace edgewise::lab {

// Finds the visible triangle at a point of the screen, and its depth. The constructor bins the triangles into
// tiles.
class ClippingOracle {
 public:
  ClippingOracle(const Scene& scene, Size size, Cull cull);

  // The visible triangle or kNoTriangle. Points must lie in the image, less than half a pixel from a sample.
  std::uint32_t visible_at(double x_px, double y_px) const;
  // Whether `triangle` (or kNoTriangle) is visible at the point. `other` is a guess of the visible triangle,
  // which often answers without testing all triangles.
  bool shows(std::uint32_t triangle, std::uint32_t other, double x_px, double y_px) const;
  // Whether the triangle covers the point between near and far, occluded or not.
  bool covers(std::uint32_t triangle, double x_px, double y_px) const {
    return truth_.covers(triangle, x_px, y_px);
  }
  double depth01(std::uint32_t triangle, double x_px, double y_px) const {
    return truth_.depth01(triangle, x_px, y_px);
  }

 private:
  void sort_into_tiles(int tile_x, int tile_y, int tiles, std::span<const std::uint32_t> candidates);

  SceneTruth truth_;
  int tiles_x_;
  std::vector<std::vector<std::uint32_t>> in_tile_;
};

// Puts a picture right: replaces the triangles that the exact picture shows nowhere within kHairlinePx of the
// sample, ties within kDepthTie01 apart, by the exact ones. `picture` holds a triangle or kNoTriangle per
// pixel, row by row. Returns the number of replaced pixels.
std::uint64_t correct(std::span<std::uint32_t> picture, Size size, const ClippingOracle& oracle, int threads);

}  // namespace edgewise::lab
