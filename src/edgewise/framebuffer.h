// Frames: a depth and a payload per pixel, in the library's memory or the caller's.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

#pragma GCC visibility push(default)
namespace edgewise {

// A read-only view of a frame. Row y starts at depth + y * stride and payload + y * stride; row 0 is the top.
// `payload` is null if only depth was drawn.
struct ConstFrameView {
  const std::uint32_t* depth;    // contract units (rule 6); contract::depth01 converts them to 0 … 1
  const std::uint32_t* payload;  // a colour 0xAABBGGRR or an id, as FrontendOptions::payload chose
  int width, height;             // px
  std::ptrdiff_t stride;         // px from row to row
};

// A frame for a backend to draw into, in any memory. Row y starts at depth + y * stride and
// payload + y * stride; row 0 is the top; no two pixels may share memory. The memory must outlive the draw.
// The frame needs no clear: by default a draw writes all its pixels (RenderPass in backend.h), and never one
// beyond `width`. Rows that start on 64-byte boundaries are written fastest. Two threads must not draw into
// one frame at once, not even into different parts of it.
struct FrameView {
  std::uint32_t* depth;    // contract units (rule 6), smaller is nearer; contract::kDepthClear: background
  std::uint32_t* payload;  // the nearest triangle's payload, or the background; null: only depth is drawn
  int width, height;       // px, 1 … contract::kMaxImageSide
  std::ptrdiff_t stride;   // px from row to row, at least width

  operator ConstFrameView() const { return {depth, payload, width, height, stride}; }
};

// A frame that owns its memory. Its content is undefined until the first draw. Rows start on 64-byte
// boundaries, so a backend can write whole cache lines with streaming stores. Rows are never a multiple of
// 4 KB apart, so the rows of a tile do not compete for the same cache sets. Moving a Framebuffer keeps its
// views valid.
class Framebuffer {
 public:
  // Sides in px. Throws std::invalid_argument for a side outside 1 … contract::kMaxImageSide, and
  // std::bad_alloc if memory runs out.
  Framebuffer(int width, int height);

  // A view is valid as long as the frame's memory.
  FrameView view() { return {depth_.get(), payload_.get(), width_, height_, stride_}; }
  ConstFrameView view() const { return {depth_.get(), payload_.get(), width_, height_, stride_}; }
  operator ConstFrameView() const { return view(); }
  int width() const { return width_; }               // px
  int height() const { return height_; }             // px
  std::ptrdiff_t stride() const { return stride_; }  // px from row to row
  // `y` must be in 0 … height() - 1, which is not checked.
  const std::uint32_t* depth_row(int y) const { return depth_.get() + y * stride_; }
  const std::uint32_t* payload_row(int y) const { return payload_.get() + y * stride_; }

 private:
  struct Release {
    std::align_val_t alignment{};  // that of a huge page for large frames
    void operator()(std::uint32_t* p) const { ::operator delete(p, alignment); }
  };
  using Plane = std::unique_ptr<std::uint32_t[], Release>;
  Plane allocate() const;

  int width_, height_;
  std::ptrdiff_t stride_;
  Plane depth_, payload_;
};

}  // namespace edgewise
#pragma GCC visibility pop
