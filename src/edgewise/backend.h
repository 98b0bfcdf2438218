// The interface that all backends share, and their registry: screen triangles → depth and payload of every
// pixel. All backends draw the same bits (contract.h), in whatever floating-point state the caller is:
// functions that compute with floats do so in C's default state, on each thread that they use, and put back
// what they found, with the exceptions that had been raised.
//
// The rest of the process stays as it was, too, but for idle threads of oneTBB. A child that was forked after
// a draw on several threads draws on its caller's thread, whatever `threads` says. It must not use an object
// that another thread of its parent used at the fork.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "edgewise/contract.h"
#include "edgewise/execution.h"
#include "edgewise/framebuffer.h"
#include "edgewise/screen_triangle.h"

namespace edgewise {
class TriangleSource;  // internal
}

#pragma GCC visibility push(default)
namespace edgewise {

// Columns x … x + width - 1 and rows y … y + height - 1. It may lie partly or wholly outside of a frame. The
// default covers any frame.
struct PixelRect {
  int x = 0, y = 0;                                                       // px
  int width = contract::kMaxImageSide, height = contract::kMaxImageSide;  // px, at least 0
};

// What a draw does to a frame, except for its triangles. By default it clears the whole frame.
struct RenderPass {
  std::uint32_t background = 0;  // the payload of cleared pixels
  // Whether the draw first clears the frame, to contract::kDepthClear and `background`. Otherwise it draws
  // over what the frame holds (it loads the frame), in which no depth may exceed contract::kDepthClear. Draws
  // add up in order of submission: where depths are equal, the frame keeps what it holds (rule 7). So two
  // draws equal one draw of both lists of triangles, bit for bit.
  bool clear = true;
  // Only the pixels inside are cleared and drawn, as in a draw of the whole frame. The others keep their
  // depth and payload.
  PixelRect scissor{};
};

// The intersection of frame and scissor. Backends draw none that is empty.
struct FramePart {
  FrameView frame;     // ends at the scissor's right and lower sides
  int x0 = 0, y0 = 0;  // px, the first column and row
  std::uint32_t background = 0;
  bool clear = true;
};

// A backend keeps its scratch memory between frames, until it is destroyed. Triangles, frame and scratch
// memory together take about 100 bytes per triangle and 16 per pixel if triangles are small, and up to 8
// bytes more per tile or band that a larger triangle overlaps. A backend object is not thread-safe; different
// objects may draw on different threads.
class Backend {
 public:
  virtual ~Backend() = default;

  // Draws into a frame as `pass` states. If the frame has no payload plane, only depth is drawn. Keeps no
  // reference to its arguments. Requires the ranges of screen_triangle.h, which are not checked. Frames of
  // similar size and content allocate memory only in the first; on several threads, which share work as they
  // become idle, rarely in a later one.
  // Throws, before it writes or allocates anything, std::invalid_argument for an invalid frame or execution,
  // for planes that overlap, for a scissor of negative size, or for more than kMaxTriangles triangles. Throws
  // std::bad_alloc if memory runs out, and std::length_error if the tiles' triangle lists exceed 2^32
  // entries; then the content of the frame is undefined, and the backend remains usable.
  void draw(std::span<const ScreenTriangle> triangles, FrameView frame, const RenderPass& pass = {},
            const Execution& execution = {});
  // The same for a front end's output. Also throws std::invalid_argument if that was made for a frame of
  // another size.
  void draw(const ScreenTriangles& triangles, FrameView frame, const RenderPass& pass = {},
            const Execution& execution = {});

 private:
  friend struct DrawAccess;  // internal
  // Whether frames may lack a payload plane. Otherwise the backend gets a scratch plane.
  virtual bool draws_depth_only() const { return false; }
  // Draws the triangles of a source. Returns false if it cannot, before it writes to the frame; then
  // the triangles are made again, and draw_checked() is called. Arguments are as there.
  virtual bool draw_source(TriangleSource&, const FramePart&, const Execution&) { return false; }
  // Called with checked arguments and a resolved `execution.target`.
  virtual void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                            const Execution& execution) = 0;
  FramePart with_payload(FramePart part);

  std::vector<std::uint32_t> unread_payload_;
};

struct BackendInfo {
  std::string_view name;     // the key in command line, tests, results and charts
  std::string_view summary;  // one line
  std::unique_ptr<Backend> (*make)();
};

// All backends, the reference first. They draw the same picture, bit for bit. Valid until the program ends;
// any thread may call.
std::span<const BackendInfo> backends();

// Compositions of the parts that the backends are made of, for experiments. They draw the same picture.
// Their names are TRAVERSAL+FILL[+hiz][+masks]; src/raster/README.md explains the parts.
std::span<const BackendInfo> compositions();

// A backend or composition. Throws std::invalid_argument, with the nearest known name, for an unknown name.
const BackendInfo& find_backend(std::string_view name);

// Draws the edges of triangles only, one pixel wide, by an exact rule of its own (raster/wireframe.cpp). Its
// picture is not the contract's, so it is not in backends().
const BackendInfo& wireframe();

}  // namespace edgewise
#pragma GCC visibility pop
