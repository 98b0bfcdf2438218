// Pictures of frames.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/framebuffer.h"
#include "edgewise/frontend.h"
#include "edgewise/image.h"

namespace edgewise::tools {

// The background's payload: black, or an id that no triangle has.
constexpr std::uint32_t background_of(Payload payload) {
  return payload == Payload::colour ? rgb(0, 0, 0) : 0xFFFFFFFFu;
}

// Colours are kept. An id becomes a colour that differs from its neighbours' and is unique below 2^24 - 1.
Image picture_of(const Framebuffer& frame, Payload payload);

// A picture of how many triangles hit each pixel: 0 is black, 1 grey, 2 yellow, 3 or more red. `hits` has
// width x height entries, row by row, top first.
Image picture_of_hits(std::span<const std::uint32_t> hits, int width, int height);

// Red where the payloads differ, blue where only the depths differ, grey where both are equal. The frames
// must have the same size.
Image picture_of_difference(const Framebuffer& a, const Framebuffer& b, Payload payload);

}  // namespace edgewise::tools
