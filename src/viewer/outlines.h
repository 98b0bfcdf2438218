// Outlines of drawn triangles. They show the pieces into which clipping cut a triangle.
#pragma once

#include <cstdint>
#include <span>

#include "edgewise/backend.h"
#include "edgewise/image.h"
#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::viewer {

inline constexpr std::uint32_t kOneOutline = rgb(0, 0, 0), kPiecesOutline = rgb(255, 255, 255);

// Draws the edges of triangles over a picture of them. A triangle's payload is the index of its source
// triangle plus one; `visible` holds the source visible at each pixel. An edge is drawn only where its source
// is visible at the pixel or next to it. kPiecesOutline marks sources of several pieces.
void add_outlines(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> visible,
                  Backend& wireframe, FrameView scratch, const Execution& execution, Image& image);

}  // namespace edgewise::viewer
