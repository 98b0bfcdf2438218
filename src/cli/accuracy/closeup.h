// Close-ups of errors: an enlarged part of the picture with its wrong pixels in fixed colours.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "edgewise/image.h"
#include "lab/error_marks.h"

namespace edgewise::tools {

struct Closeup {
  std::string name;                    // FAMILY-SCENE-METHOD
  lab::Window part;                    // of the picture
  std::vector<std::uint32_t> visible;  // the exact visible triangles; lab::kNoTriangle: background
  std::vector<lab::Mark> marks;
  std::vector<lab::Line> lines;  // the triangles' exact edges
};

// Cuts out the part with the most wrong pixels.
Closeup closeup(const std::string& name, const lab::MarkedPicture& picture);

// Appends a close-up unless one from index `first` on is identical: methods with the same errors need one
// picture.
void add_unless_known(Closeup closeup, std::vector<Closeup>& closeups, std::size_t first);

Image draw(const Closeup& closeup);
// Throws std::runtime_error if the folder cannot be created or written to; creates nothing.
void check_closeup_folder(const std::filesystem::path& folder);
// Writes FOLDER/NAME.png for each, and creates the folder. Throws std::runtime_error if that fails.
void write_closeups(const std::filesystem::path& folder, std::span<const Closeup> closeups);

}  // namespace edgewise::tools
