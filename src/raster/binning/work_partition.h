// Cuts triangles into parts for the threads that bin them, so that none waits long for another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/screen_triangle.h"

namespace edgewise {

class WorkPartition {
 public:
  // Part i is triangles [bounds()[i], bounds()[i + 1]) of `count`, all parts of the same length.
  void cut_equally(std::size_t count, std::size_t parts);
  // Parts that take about as long where small triangles become patches, if equal ones would not, and there
  // are so many triangles that looking at some of them pays. `width`, `height`: of the image, px.
  void cut_by_work(std::span<const ScreenTriangle> triangles, int width, int height, std::size_t parts);
  std::span<const std::size_t> bounds() const { return bounds_; }

 private:
  std::vector<std::size_t> bounds_;
  std::vector<std::uint32_t> work_;  // of the triangles that were looked at
};

}  // namespace edgewise
