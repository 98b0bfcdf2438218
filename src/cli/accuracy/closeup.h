// What an error looks like: a part of the picture, enlarged, its wrong pixels in fixed colours.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "edgewise/image.h"
#include "lab/error_marks.h"

namespace edgewise::app {

struct Closeup {
  std::string name;                  // FAMILY-SCENE-METHOD
  lab::Window part;                  // of the picture
  std::vector<std::uint32_t> owner;  // in truth; lab::kNobody shows as paper
  std::vector<lab::Mark> marks;
  std::vector<lab::Line> lines;  // the triangles' exact edges
};

// The part where the most is wrong.
Closeup closeup(const std::string& name, const lab::MarkedPicture& picture);

// Appends a close-up unless one from `first` on shows the same: methods that draw alike need one picture.
void add_unless_known(Closeup closeup, std::vector<Closeup>& closeups, std::size_t first);

Image draw(const Closeup& closeup);
// Throws std::runtime_error where no folder could be made or written to; makes none yet.
void check_closeup_folder(const std::filesystem::path& folder);
// FOLDER/NAME.png; makes the folder. Throws std::runtime_error where it cannot.
void write_closeups(const std::filesystem::path& folder, std::span<const Closeup> closeups);

}  // namespace edgewise::app
