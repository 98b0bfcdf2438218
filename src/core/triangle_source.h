// Screen triangles as binning reads them. They lie in memory, or are made when binning needs them. Made
// triangles are binned while they lie in the L2 cache, so those that become coverage masks need no room in
// memory. This lies in core/, because the front end makes the triangles and the backends bin them.
#pragma once

#include <cstddef>
#include <span>

#include "edgewise/screen_triangle.h"

namespace edgewise {

class TriangleSource {
 public:
  static constexpr std::size_t kInputsAtOnce = 2048;  // a backend asks make() for at most so many per call

  virtual ~TriangleSource() = default;

  // The number of inputs. An input becomes any number of screen triangles.
  virtual std::size_t size() const = 0;
  // Returns the screen triangles of inputs begin … end - 1, in order. They are valid until the next call with
  // the same `worker`. Calls with different workers may run at once. Does not throw.
  virtual std::span<const ScreenTriangle> make(int worker, std::size_t begin, std::size_t end) = 0;
  // Called when all inputs are made, before anything is drawn. Throws std::invalid_argument if one was
  // invalid.
  virtual void finish() {}
  // The screen triangles if they lie in memory, one per input. Null if they are made, or if there are none.
  virtual const ScreenTriangle* stored() const { return nullptr; }
};

class StoredTriangles final : public TriangleSource {
 public:
  explicit StoredTriangles(std::span<const ScreenTriangle> triangles) : triangles_(triangles) {}
  std::size_t size() const override { return triangles_.size(); }
  std::span<const ScreenTriangle> make(int, std::size_t begin, std::size_t end) override {
    return triangles_.subspan(begin, end - begin);
  }
  const ScreenTriangle* stored() const override { return triangles_.data(); }

 private:
  std::span<const ScreenTriangle> triangles_;
};

}  // namespace edgewise
