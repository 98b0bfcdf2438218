// What a person needs to look into a difference: pictures, and a stream that shows it again.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "cli/verify/verify.h"

namespace edgewise::app {

struct FailureFrames {
  std::span<const ScreenTriangle> triangles;
  const Framebuffer& expected;
  const Framebuffer& found;
};

// Writes FOLDER/SCENE-CULL-BACKEND-vs-JUDGE: expected, found and difference (enlarged) as .png, and the
// triangles as .tri. Names them in the mismatch, or says there why they are not written; nothing happens for
// an empty folder name.
void write_failure(const std::filesystem::path& folder, const std::string& scene, Mismatch& mismatch,
                   const FailureFrames& frames);

}  // namespace edgewise::app
