// Files in memory, since WASI's C++ library has no others. PNG is missing: it needs libpng.
#pragma once

#include <string>

#include "edgewise/framebuffer.h"
#include "edgewise/scene.h"

namespace edgewise::hashes {

// A format for a frame's stream, or for its picture.
struct FileFormat {
  std::string (*written)(const Drawable&, const ConstFrameView&);  // the file's bytes
  // Reads these bytes and returns what is written then. Throws std::runtime_error with `name` if they are
  // malformed.
  std::string (*reread)(const std::string& name, const std::string& bytes);
};
extern const FileFormat kTri, kPpm, kPfm;

}  // namespace edgewise::hashes
