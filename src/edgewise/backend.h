// The interface that all backends share, and their registry: screen triangles → depth and payload of every
// pixel. All backends draw the same bits (contract.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "edgewise/framebuffer.h"
#include "edgewise/limits.h"
#include "edgewise/screen_triangle.h"
#include "edgewise/simd_target.h"

namespace edgewise {

// How to draw. No choice here changes a bit of the picture.
struct Execution {
  int threads = 1;     // 1 … kMaxThreads
  int tile_size = 64;  // px; 16, 32 or 64; only the tiled backend looks at it
  SimdTarget target = SimdTarget::best;
};

// A backend keeps its scratch memory between frames, until it is destroyed: with triangles and frame less
// than 100 bytes a triangle and 16 a pixel where triangles are small, and up to 8 bytes more for each tile or
// band that a larger one touches. One object must not draw on two threads at once; two objects may.
class Backend {
 public:
  virtual ~Backend() = default;

  // Draws a whole frame: every pixel of `frame` is written, with `background` and contract::kDepthClear where
  // no triangle wins. Neither `triangles` nor `frame` is kept. `triangles` must keep to the ranges in
  // screen_triangle.h, which are not checked. Throws std::invalid_argument for an impossible frame or
  // execution, or more than kMaxTriangles (before anything is touched or allocated), std::bad_alloc for lack
  // of memory, std::length_error where large triangles fill more than 2^32 places in the lists of tiles;
  // after the last two the frame's content is undefined, and the backend may be used again. Thousands of
  // frames of a kind allocate only in the first.
  void draw(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
            const Execution& execution);
  // The same for what a front end made. Throws std::invalid_argument, too, if it was made for a frame of
  // another size.
  void draw(const ScreenTriangles& triangles, FrameView frame, std::uint32_t background,
            const Execution& execution);

 private:
  // `execution.target` is resolved, all arguments are checked.
  virtual void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame,
                            std::uint32_t background, const Execution& execution) = 0;
};

struct BackendInfo {
  std::string_view name;  // the key in command line, tests, results and charts
  std::string_view idea;  // one line
  std::unique_ptr<Backend> (*make)();
};

// All backends, the reference first. They draw the same picture, bit for bit. Valid until the program ends;
// any thread may call.
std::span<const BackendInfo> backends();

// Throws std::invalid_argument, with the nearest known name, for an unknown one.
const BackendInfo& find_backend(std::string_view name);

// Draws the edges of triangles only, one pixel wide, by an exact rule of its own (raster/wireframe.cpp). Its
// picture is not the contract's, so it is not in backends().
const BackendInfo& wireframe();

}  // namespace edgewise
