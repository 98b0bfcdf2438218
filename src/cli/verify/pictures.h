// Evidence of a difference: pictures, and a stream that reproduces it.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "cli/verify/verify.h"

namespace edgewise::tools {

struct FailureFrames {
  std::span<const ScreenTriangle> triangles;
  const Framebuffer& expected;
  const Framebuffer& found;
};

// Writes FOLDER/SCENE-CULL-BACKEND-vs-JUDGE: expected, found and difference (enlarged) as .png, and the
// triangles as .tri. Lists the files, or the reason why one was not written, in the mismatch. Does nothing if
// the folder name is empty.
void write_failure(const std::filesystem::path& folder, const std::string& scene, Mismatch& mismatch,
                   const FailureFrames& frames);

}  // namespace edgewise::tools
