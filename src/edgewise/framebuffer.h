// Depth and payload of an image, in the library's memory or in the caller's.
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

namespace edgewise {

// A frame to be read, wherever it lies.
struct ConstFrameView {
  const std::uint32_t* depth;    // units of rule 6; contract::depth01 makes 0 … 1 of them
  const std::uint32_t* payload;  // a colour 0xAABBGGRR, or an id: as the front end was told
  int width, height;             // px
  std::ptrdiff_t stride;         // px
};

// Where a backend draws: any memory of the caller's. Row y starts at depth + y * stride and
// payload + y * stride, the top row first. The memory must outlive the draw; pixels beyond width are never
// written, and what the frame held before does not matter. Rows that start on 64-byte boundaries are written
// fastest. One frame must not be drawn into by two threads at once.
struct FrameView {
  std::uint32_t* depth;  // units of rule 6, smaller is nearer; contract::kDepthClear where nothing was drawn
  std::uint32_t* payload;  // of the nearest triangle, or the background
  int width, height;       // px, 1 … contract::kMaxImageSide
  std::ptrdiff_t stride;   // px, at least width

  operator ConstFrameView() const { return {depth, payload, width, height, stride}; }
};

// Owns a frame, whose content is undefined until something is drawn. Rows start on 64-byte boundaries, so
// that a backend can stream whole cache lines, and never a multiple of 4 KB apart, so that a tile's rows
// don't all want the same few places in the caches. Moving it leaves its views valid.
class Framebuffer {
 public:
  // In px. Throws std::invalid_argument for a side outside 1 … contract::kMaxImageSide, std::bad_alloc for
  // lack of memory.
  Framebuffer(int width, int height);

  // Valid for as long as the frame.
  FrameView view() { return {depth_.get(), payload_.get(), width_, height_, stride_}; }
  ConstFrameView view() const { return {depth_.get(), payload_.get(), width_, height_, stride_}; }
  operator ConstFrameView() const { return view(); }
  int width() const { return width_; }               // px
  int height() const { return height_; }             // px
  std::ptrdiff_t stride() const { return stride_; }  // px from row to row
  // `y` is not checked: 0 … height() - 1.
  const std::uint32_t* depth_row(int y) const { return depth_.get() + y * stride_; }
  const std::uint32_t* payload_row(int y) const { return payload_.get() + y * stride_; }

 private:
  struct Release {
    std::align_val_t alignment{};  // large frames begin at a huge page
    void operator()(std::uint32_t* p) const { ::operator delete(p, alignment); }
  };
  using Plane = std::unique_ptr<std::uint32_t[], Release>;
  Plane allocate() const;

  int width_, height_;
  std::ptrdiff_t stride_;
  Plane depth_, payload_;
};

}  // namespace edgewise
