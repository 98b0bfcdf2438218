#include "cli/verify/pictures.h"

#include <fmt/format.h>

#include <exception>

#include "core/atomic_file.h"
#include "edgewise/tri_file.h"
#include "image/pictures.h"
#include "lab/to_stream.h"

namespace edgewise::tools {

namespace {

// About the width of a screen: enlarged pixels are visible and the picture fits.
int enlargement(int width, int height) {
  constexpr int kLargestSide_px = 2048, kLargestFactor = 8;
  return std::clamp(kLargestSide_px / std::max(width, height), 1, kLargestFactor);
}

}  // namespace

void write_failure(const std::filesystem::path& folder, const std::string& scene, Mismatch& mismatch,
                   const FailureFrames& frames) try {
  if (folder.empty()) return;
  std::filesystem::create_directories(folder);
  const auto path_for = [&](const char* suffix) {
    return folder / fmt::format("{}-{}-{}-vs-{}{}", scene, name_of(mismatch.cull), mismatch.backend,
                                mismatch.judge, suffix);
  };
  const auto write = [&](const char* suffix, const Image& image) {
    write_image(path_for(suffix), image);
    mismatch.files.push_back(path_for(suffix).string());
  };
  write("-expected.png", picture_of(frames.expected, mismatch.payload));
  write("-found.png", picture_of(frames.found, mismatch.payload));
  write("-difference.png", enlarge(picture_of_difference(frames.expected, frames.found, mismatch.payload),
                                   enlargement(mismatch.width, mismatch.height)));
  AtomicFile file(path_for(".tri"));
  write_tri(file.stream(), lab::to_stream(frames.triangles, mismatch.width, mismatch.height));
  file.commit();
  mismatch.files.push_back(path_for(".tri").string());
} catch (const std::exception& error) {
  // Report the mismatch even if its pictures cannot be written.
  mismatch.file_error = error.what();
}

}  // namespace edgewise::tools
