#include "edgewise/backend.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/execution.h"
#include "core/float_state.h"
#include "core/overlap.h"
#include "edgewise/contract.h"
#include "raster/checks.h"

namespace edgewise {

void check(const FrameView& frame) {
  const auto in_range = [](int side) { return side >= 1 && side <= contract::kMaxImageSide; };
  if (!in_range(frame.width) || !in_range(frame.height) || frame.stride < frame.width || !frame.depth)
    throw std::invalid_argument("frame of " + std::to_string(frame.width) + " x " +
                                std::to_string(frame.height) + " px, stride " + std::to_string(frame.stride) +
                                ", cannot be drawn into");
  if (overlap(rows_of(frame, frame.depth), rows_of(frame, frame.payload)))
    throw std::invalid_argument("the frame's depth and payload overlap in memory");
}

FramePart checked(const FrameView& frame, const RenderPass& pass) {
  const PixelRect& scissor = pass.scissor;
  if (scissor.width < 0 || scissor.height < 0)
    throw std::invalid_argument("scissor of " + std::to_string(scissor.width) + " x " +
                                std::to_string(scissor.height) + " px has a negative side");
  const auto end = [](int begin, int size, int limit) {
    return static_cast<int>(std::clamp<std::int64_t>(std::int64_t{begin} + size, 0, limit));
  };
  FramePart part{frame, std::max(scissor.x, 0), std::max(scissor.y, 0), pass.background, pass.clear};
  part.frame.width = end(scissor.x, scissor.width, frame.width);
  part.frame.height = end(scissor.y, scissor.height, frame.height);
  return part;
}

void throw_if_of_another_size(const char* what, int width, int height, const FrameView& frame) {
  const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h) + " px"; };
  if (width != frame.width || height != frame.height)
    throw std::invalid_argument(what + (" for " + size(width, height)) + " cannot be drawn into a frame of " +
                                size(frame.width, frame.height));
}

FramePart Backend::with_payload(FramePart part) {
  FrameView& frame = part.frame;
  if (frame.payload == nullptr && !draws_depth_only()) {
    const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height - 1) +
                        static_cast<std::size_t>(frame.width);
    if (unread_payload_.size() < pixels) unread_payload_.resize(pixels);
    frame.payload = unread_payload_.data();
  }
  return part;
}

void Backend::draw(std::span<const ScreenTriangle> triangles, FrameView frame, const RenderPass& pass,
                   const Execution& execution) {
  const DefaultFloatState state;
  check(frame);
  const Execution resolved = checked(execution);
  const FramePart part = checked(frame, pass);
  if (triangles.size() > kMaxTriangles)
    throw std::invalid_argument(std::to_string(triangles.size()) + " triangles are more than " +
                                std::to_string(kMaxTriangles));
  if (!is_empty(part)) draw_checked(triangles, with_payload(part), resolved);
}

void Backend::draw(const ScreenTriangles& triangles, FrameView frame, const RenderPass& pass,
                   const Execution& execution) {
  throw_if_of_another_size("triangles made", triangles.width(), triangles.height(), frame);
  draw(std::span(triangles), frame, pass, execution);
}

}  // namespace edgewise
