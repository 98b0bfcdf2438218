#include "edgewise/backend.h"

#include <stdexcept>
#include <string>

#include "edgewise/contract.h"

namespace edgewise {

void Backend::draw(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                   const Execution& execution) {
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
  if (triangles.size() > kMaxTriangles)
    throw std::invalid_argument(std::to_string(triangles.size()) + " triangles are more than " +
                                std::to_string(kMaxTriangles));
  Execution checked = execution;
  checked.target = resolve(execution.target);
  draw_checked(triangles, frame, background, checked);
}

void Backend::draw(const ScreenTriangles& triangles, FrameView frame, std::uint32_t background,
                   const Execution& execution) {
  const auto size = [](int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height) + " px";
  };
  if (triangles.width() != frame.width || triangles.height() != frame.height)
    throw std::invalid_argument("triangles made for " + size(triangles.width(), triangles.height()) +
                                " cannot be drawn into a frame of " + size(frame.width, frame.height));
  draw(std::span(triangles), frame, background, execution);
}

}  // namespace edgewise
