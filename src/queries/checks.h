// Checks of frames that are read.
#pragma once

#include <stdexcept>
#include <string>

#include "edgewise/contract.h"
#include "edgewise/framebuffer.h"

namespace edgewise {

// Throws std::invalid_argument if the frame cannot be read.
inline void check(const ConstFrameView& frame, bool with_payload) {
  const auto in_range = [](int side) { return side >= 1 && side <= contract::kMaxImageSide; };
  if (with_payload && !frame.payload) throw std::invalid_argument("the frame has no payload");
  if (!in_range(frame.width) || !in_range(frame.height) || frame.stride < frame.width || !frame.depth)
    throw std::invalid_argument("frame of " + std::to_string(frame.width) + " x " +
                                std::to_string(frame.height) + " px, stride " + std::to_string(frame.stride) +
                                ", cannot be read");
}

}  // namespace edgewise
