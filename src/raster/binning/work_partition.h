// Cuts the inputs of a triangle source into slices that take about the same time to make and bin, one per
// thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_source.h"
#include "raster/binning/cell_boxes.h"

namespace edgewise {

class WorkPartition {
 public:
  // Cuts `count` inputs into slices of equal length. Slice i is [bounds()[i], bounds()[i + 1]).
  void cut_equally(std::size_t count, std::size_t slices);
  // Cuts by the estimated work of making and binning the triangles of some probed inputs. Falls back to
  // equal lengths where these are balanced, or where there are too few inputs for probes to pay.
  // `masks`: small triangles become coverage masks.
  void cut_by_work(TriangleSource& source, const CellGrid& grid, bool masks, std::size_t slices);
  std::span<const std::size_t> bounds() const { return bounds_; }

 private:
  std::vector<std::size_t> bounds_;
  std::vector<std::uint32_t> work_;  // estimated work of the probed inputs
};

}  // namespace edgewise
