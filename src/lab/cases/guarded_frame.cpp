#include "lab/cases/guarded_frame.h"

#include <algorithm>

namespace edgewise::lab {

namespace {

constexpr std::size_t kLine = 16;           // pixels of a 64-byte line
constexpr std::size_t kMargin = 4 * kLine;  // canaries before the first row and after the last

}  // namespace

GuardedFrame::Layout GuardedFrame::aligned(int width) {
  constexpr int kPixels = static_cast<int>(kLine);
  return {(width + kPixels - 1) / kPixels * kPixels - width, 0};
}

GuardedFrame::GuardedFrame(int width, int height, Layout layout)
    : width_(width),
      height_(height),
      layout_(layout),
      stride_(static_cast<std::size_t>(width + layout.padding)),
      depth_(allocate()),
      payload_(allocate()) {}

GuardedFrame::Plane GuardedFrame::allocate() const {
  Plane plane;
  plane.words.assign(stride_ * static_cast<std::size_t>(height_) + 2 * kMargin + 2 * kLine, kCanary);
  const auto address = reinterpret_cast<std::uintptr_t>(plane.words.data()) / sizeof(std::uint32_t);
  plane.first = kMargin + (kLine - address % kLine) % kLine + static_cast<std::size_t>(layout_.offset);
  return plane;
}

FrameView GuardedFrame::view() {
  return {depth_.words.data() + depth_.first, payload_.words.data() + payload_.first, width_, height_,
          static_cast<std::ptrdiff_t>(stride_)};
}

void GuardedFrame::poison() {
  for (Plane* plane : {&depth_, &payload_}) std::fill(plane->words.begin(), plane->words.end(), kCanary);
}

std::uint64_t GuardedFrame::written_outside(const Plane& plane) const {
  const auto overwritten = [](const std::uint32_t* begin, const std::uint32_t* end) {
    return static_cast<std::uint64_t>(end - begin - std::count(begin, end, kCanary));
  };
  const std::uint32_t* begin = plane.words.data();
  std::uint64_t count = 0;
  for (int y = 0; y < height_; ++y) {
    count += overwritten(begin, row_of(plane, y));
    begin = row_of(plane, y) + width_;
  }
  return count + overwritten(begin, plane.words.data() + plane.words.size());
}

std::uint64_t GuardedFrame::written_outside() const {
  return written_outside(depth_) + written_outside(payload_);
}

Framebuffer GuardedFrame::copy() const {
  Framebuffer frame(width_, height_);
  const FrameView view = frame.view();
  for (int y = 0; y < height_; ++y) {
    std::copy_n(depth_row(y), width_, view.depth + y * view.stride);
    std::copy_n(payload_row(y), width_, view.payload + y * view.stride);
  }
  return frame;
}

}  // namespace edgewise::lab
