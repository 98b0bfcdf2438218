// Cuts triangles into as many parts as there are threads to bin them, so that none waits long for another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/screen_triangle.h"
#include "raster/cell_boxes.h"

namespace edgewise {

class Shares {
 public:
  // Part i is triangles [bounds()[i], bounds()[i + 1]). Parts are equally long, unless there are so many
  // triangles that looking at some of them pays, and these tell that one part takes much longer than others.
  void cut(std::span<const ScreenTriangle> triangles, const CellGrid& grid, std::size_t parts);
  std::span<const std::size_t> bounds() const { return bounds_; }

 private:
  std::vector<std::size_t> bounds_;
  std::vector<std::uint32_t> weights_;  // of the triangles that were looked at
};

}  // namespace edgewise
