// Clears parts of a frame.
#pragma once

#include <span>

#include "edgewise/backend.h"
#include "edgewise/simd_target.h"

namespace edgewise {

struct Interval {
  int begin, end;  // px; half open
};

// Pixel row by pixel row: long consecutive stores use the memory's bandwidth better than the short rows of
// one tile after the other.
struct ClearTask {
  std::span<const Interval> columns;  // those that lie in the part are cleared
  int y0, y1;                         // px, the rows y0 … y1 - 1
  FramePart part;
  bool streaming = false;  // if the planes are aligned for it
};
using ClearKernel = void (*)(const ClearTask&);

// `target` must be resolved.
ClearKernel clear_kernel(SimdTarget target);

}  // namespace edgewise
