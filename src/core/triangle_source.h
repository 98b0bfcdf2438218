// Makes screen triangles where binning needs them. A run of them is binned while it lies in the L2 cache, so
// small triangles never go through memory.
#pragma once

#include <cstddef>
#include <span>

#include "edgewise/screen_triangle.h"

namespace edgewise {

class TriangleSource {
 public:
  static constexpr std::size_t kRun = 2048;  // inputs, the most of one call of make()

  virtual ~TriangleSource() = default;

  // The number of inputs. An input becomes any number of screen triangles.
  virtual std::size_t size() const = 0;
  // Returns the screen triangles of inputs begin … end - 1, in order. They are valid until the next call with
  // the same `worker`. Calls with different workers may run at once. Does not throw.
  virtual std::span<const ScreenTriangle> make(int worker, std::size_t begin, std::size_t end) = 0;
};

}  // namespace edgewise
