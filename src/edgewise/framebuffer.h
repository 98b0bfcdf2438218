// Depth and payload of an image, in the library's memory or in the caller's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

namespace edgewise {

// Where a backend draws. Row y starts at depth + y * stride and payload + y * stride; stride is in pixels, at
// least width. The memory belongs to the caller and must outlive the draw; pixels beyond width are never
// written.
struct FrameView {
  std::uint32_t* depth;    // contract depth units (rule 6); kDepthClear where nothing was drawn
  std::uint32_t* payload;  // the winner's payload, or the background
  int width, height;       // 1 … contract::kMaxImageSide
  std::ptrdiff_t stride;
};

// Owns a frame. Rows start on 64-byte boundaries, so that a backend can stream whole cache lines, and never a
// multiple of 4 KB apart, so that a tile's rows don't all want the same few places in the caches.
class Framebuffer {
 public:
  // Throws std::invalid_argument for a side outside 1 … contract::kMaxImageSide, std::bad_alloc for lack of
  // memory.
  Framebuffer(int width, int height);

  FrameView view() { return {depth_.get(), payload_.get(), width_, height_, stride_}; }
  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }
  const std::uint32_t* depth_row(int y) const { return depth_.get() + y * stride_; }
  const std::uint32_t* payload_row(int y) const { return payload_.get() + y * stride_; }

 private:
  static constexpr std::size_t kAlignment = 64;
  struct Release {
    void operator()(std::uint32_t* p) const { ::operator delete[](p, std::align_val_t{kAlignment}); }
  };
  using Plane = std::unique_ptr<std::uint32_t[], Release>;
  Plane allocate() const;

  int width_, height_;
  std::ptrdiff_t stride_;
  Plane depth_, payload_;
};

}  // namespace edgewise
