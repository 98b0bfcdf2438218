// Frames as pictures for people.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/framebuffer.h"
#include "edgewise/frontend.h"
#include "edgewise/image.h"

namespace edgewise::app {

// What is drawn behind the triangles: black, and an id that no triangle has.
constexpr std::uint32_t background_of(Payload payload) {
  return payload == Payload::colour ? rgb(0, 0, 0) : 0xFFFFFFFFu;
}

// Colours as they are; ids as colours that differ for neighbouring ids and tell the id exactly below 2^24
// - 1.
Image picture_of(const Framebuffer& frame, Payload payload);

// 0 black, 1 grey, 2 yellow, 3 and more red.
Image picture_of_hits(std::span<const std::uint32_t> hits, int width, int height);

// Red where the payloads differ, blue where only the depths do, and grey where all is equal.
Image picture_of_difference(const Framebuffer& a, const Framebuffer& b, Payload payload);

}  // namespace edgewise::app
