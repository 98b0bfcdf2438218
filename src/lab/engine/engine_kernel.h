// The tile kernel of the backend `tiled`, with other numbers in its edge functions or depths.
#pragma once

#include <cstdint>
#include <span>

#include "lab/method.h"
#include "raster/tile_task.h"

namespace edgewise::lab {

enum class EngineNumbers {
  exact,
  float_lt,
  float_le,
  float_top_left,
  float_rebased,
  float_snapped,
  fixed_4_int32,
  fixed_8_int32,
  fixed_8_int64,
  double_top_left,
  // Exact coverage, other depths.
  depth_float,
  depth_24,
  depth_16,
  kCount
};

// `triangles` and `floats` are the same triangles, snapped and not.
struct EngineTask : TileTask {
  const FloatTriangle* floats;
  int origin_x, origin_y;  // px, the frame's first pixel in the coordinates of `floats`
  bool reads_floats;

  [[gnu::always_inline]] void prefetch(std::span<const std::uint32_t> indices) const {
    TileTask::prefetch(indices);
    if (reads_floats) prefetch_records(floats, indices);
  }
};

struct EngineKernel {
  void (*draw_tile)(const EngineTask&) = nullptr;
  std::int32_t margin = 0;  // CellGrid::margin
  bool reads_floats = false;
};

// `target` must be resolved. The kernels are compiled in two files, since each takes long. Without
// draw_tile: the numbers are in the other file.
EngineKernel fixed_engine_kernel(EngineNumbers numbers, SimdTarget target);
EngineKernel real_engine_kernel(EngineNumbers numbers, SimdTarget target);

}  // namespace edgewise::lab
