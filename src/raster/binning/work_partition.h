// Cuts triangles into parts of about equal binning time, one per thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/screen_triangle.h"

namespace edgewise {

class WorkPartition {
 public:
  // Cuts `count` triangles into parts of equal length. Part i is [bounds()[i], bounds()[i + 1]).
  void cut_equally(std::size_t count, std::size_t parts);
  // Cuts by the estimated work of binning with coverage masks, from a sample of the triangles. Falls back to
  // equal lengths where these are balanced, or where there are too few triangles for sampling to pay.
  // `width`, `height`: of the image, px.
  void cut_by_work(std::span<const ScreenTriangle> triangles, int width, int height, std::size_t parts);
  std::span<const std::size_t> bounds() const { return bounds_; }

 private:
  std::vector<std::size_t> bounds_;
  std::vector<std::uint32_t> work_;  // estimated work of the sampled triangles
};

}  // namespace edgewise
