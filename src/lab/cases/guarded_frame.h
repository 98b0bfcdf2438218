// A frame for tests of backends: any stride and alignment, with canaries around the rows that detect writes
// outside the image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "edgewise/framebuffer.h"

namespace edgewise::lab {

// A value that no backend draws: as a depth it lies beyond every depth of the contract.
inline constexpr std::uint32_t kCanary = 0xA5A5A5A5;

class GuardedFrame {
 public:
  struct Layout {
    int padding = 0;  // px between the end of a row and the start of the next
    int offset = 0;   // px from a 64-byte boundary to the first pixel, 0 … 15
  };
  static Layout aligned(int width);  // every row starts on a 64-byte boundary, as in a Framebuffer

  GuardedFrame(int width, int height, Layout layout);  // poisoned
  // A copy's planes would not keep the alignment.
  GuardedFrame(const GuardedFrame&) = delete;
  GuardedFrame& operator=(const GuardedFrame&) = delete;
  GuardedFrame(GuardedFrame&&) = default;

  FrameView view();
  int width() const { return width_; }
  int height() const { return height_; }
  const std::uint32_t* depth_row(int y) const { return row_of(depth_, y); }
  const std::uint32_t* payload_row(int y) const { return row_of(payload_, y); }

  void poison();  // fills all memory with canaries; call it before each draw but the first
  std::uint64_t written_outside() const;  // overwritten canaries before, between and after the rows
  Framebuffer copy() const;

 private:
  struct Plane {
    std::vector<std::uint32_t> words;
    std::size_t first = 0;  // index of pixel (0, 0)
  };
  Plane allocate() const;
  const std::uint32_t* row_of(const Plane& plane, int y) const {
    return plane.words.data() + plane.first + static_cast<std::size_t>(y) * stride_;
  }
  std::uint64_t written_outside(const Plane& plane) const;

  int width_, height_;
  Layout layout_;
  std::size_t stride_;
  Plane depth_, payload_;
};

}  // namespace edgewise::lab
