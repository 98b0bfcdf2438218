// Checks of a draw's arguments.
#pragma once

#include "edgewise/backend.h"

namespace edgewise {

// Throws std::invalid_argument for a frame that cannot be drawn into.
void check(const FrameView& frame);

// The part of a valid frame that a draw writes; it may be empty. Throws std::invalid_argument.
FramePart checked(const FrameView& frame, const RenderPass& pass);
inline bool is_empty(const FramePart& part) {
  return part.x0 >= part.frame.width || part.y0 >= part.frame.height;
}

// Throws std::invalid_argument if `what`, made for a frame of width x height px, is to be drawn into another.
void throw_if_of_another_size(const char* what, int width, int height, const FrameView& frame);

}  // namespace edgewise
