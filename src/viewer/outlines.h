// The outlines of what is drawn, so that the pieces show that clipping has cut a triangle into.
#pragma once

#include <cstdint>
#include <span>

#include "edgewise/backend.h"
#include "edgewise/image.h"
#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::viewer {

inline constexpr std::uint32_t kOneOutline = rgb(0, 0, 0), kPiecesOutline = rgb(255, 255, 255);

// Draws the edges of the triangles, whose payloads are the index of their source plus one, over a picture of
// them; `owners` says for each pixel which source shows there, and an edge shows on its own triangle only or
// on the pixels beside it.
void add_outlines(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> owners,
                  Backend& wireframe, FrameView scratch, const Execution& execution, Image& image);

}  // namespace edgewise::viewer
