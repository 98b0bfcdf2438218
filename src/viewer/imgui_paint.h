// Paints what Dear ImGui draws into a picture, with integers and by the fill rule of the contract, so that
// the same picture comes out on every machine.
#pragma once

#include "edgewise/image.h"

struct ImDrawData;

namespace edgewise::viewer {

// An ImTextureID points to an Image, whose pixels' alpha counts here.
void paint(const ImDrawData& drawn, Image& image);

}  // namespace edgewise::viewer
