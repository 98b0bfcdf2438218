// Paints Dear ImGui's draw lists into a picture. Coverage follows the contract's fill rule, so that every
// machine paints the same.
#pragma once

#include "edgewise/image.h"

struct ImDrawData;

namespace edgewise::viewer {

// An ImTextureID points to an Image, whose pixels' alpha counts here.
void paint(const ImDrawData& drawn, Image& image);

}  // namespace edgewise::viewer
