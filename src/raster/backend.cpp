#include "edgewise/backend.h"

#include <stdexcept>
#include <string>

#include "edgewise/contract.h"
#include "raster/checks.h"

namespace edgewise {

Execution checked(const FrameView& frame, const Execution& execution) {
  const auto in_range = [](int side) { return side >= 1 && side <= contract::kMaxImageSide; };
  if (!in_range(frame.width) || !in_range(frame.height) || frame.stride < frame.width || !frame.depth ||
      !frame.payload)
    throw std::invalid_argument("frame of " + std::to_string(frame.width) + " x " +
                                std::to_string(frame.height) + " px, stride " + std::to_string(frame.stride) +
                                ", cannot be drawn into");
  if (execution.threads < 1 || execution.threads > kMaxThreads)
    throw std::invalid_argument(std::to_string(execution.threads) + " threads are outside 1 to " +
                                std::to_string(kMaxThreads));
  if (execution.tile_size != 16 && execution.tile_size != 32 && execution.tile_size != 64)
    throw std::invalid_argument("tile size " + std::to_string(execution.tile_size) + " is not 16, 32 or 64");
  Execution resolved = execution;
  resolved.target = resolve(execution.target);
  return resolved;
}

void throw_if_of_another_size(const char* what, int width, int height, const FrameView& frame) {
  const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h) + " px"; };
  if (width != frame.width || height != frame.height)
    throw std::invalid_argument(what + (" for " + size(width, height)) + " cannot be drawn into a frame of " +
                                size(frame.width, frame.height));
}

void Backend::draw(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                   const Execution& execution) {
  const Execution resolved = checked(frame, execution);
  if (triangles.size() > kMaxTriangles)
    throw std::invalid_argument(std::to_string(triangles.size()) + " triangles are more than " +
                                std::to_string(kMaxTriangles));
  draw_checked(triangles, frame, background, resolved);
}

void Backend::draw(const ScreenTriangles& triangles, FrameView frame, std::uint32_t background,
                   const Execution& execution) {
  throw_if_of_another_size("triangles made", triangles.width(), triangles.height(), frame);
  draw(std::span(triangles), frame, background, execution);
}

}  // namespace edgewise
