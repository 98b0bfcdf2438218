// Files in memory, since WASI's C++ library has no others. PNG is missing: it needs libpng.
#pragma once

#include <string>

#include "edgewise/framebuffer.h"
#include "edgewise/scene.h"

namespace edgewise::hashes {

// The bytes of a file of a frame's stream or picture. Throw if the reader does not give back what was
// written.
using FileOf = std::string (*)(const Drawable&, const ConstFrameView&);
std::string tri_of(const Drawable& drawable, const ConstFrameView&);
std::string ppm_of(const Drawable&, const ConstFrameView& frame);
std::string pfm_of(const Drawable&, const ConstFrameView& frame);

}  // namespace edgewise::hashes
