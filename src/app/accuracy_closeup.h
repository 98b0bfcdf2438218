// What an error looks like: a part of the picture, enlarged, its wrong pixels in fixed colours.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "edgewise/image.h"
#include "lab/coverage_score.h"
#include "lab/facing.h"

namespace edgewise::app {

// A pixel's error; where several apply, the first. Colours that people tell apart whatever their colour
// vision (Okabe and Ito, "Color universal design", 2008).
enum class Mark : std::uint8_t {
  none,
  gap,      // vermilion: nothing is drawn between neighbours; of owners: where something must be
  twice,    // blue: drawn twice where once is right; of owners: the wrong one shows
  missing,  // yellow: a triangle lacks a pixel on the outline, or one that another covers; of depths: the
            // wrong one
  extra,    // purple: drawn where nothing must be, or beside the triangle
};

std::uint32_t colour_of(Mark mark);  // none: paper

struct Line {
  double x0, y0, x1, y1;  // px
  bool operator==(const Line&) const = default;
};

struct Closeup {
  std::string name;                  // FAMILY-SCENE-METHOD
  lab::Window part;                  // of the picture
  std::vector<std::uint32_t> owner;  // in truth; lab::kNobody shows as paper
  std::vector<Mark> marks;
  std::vector<Line> lines;  // the triangles' exact edges
};

// The whole picture of a method, from which close-ups are cut.
struct MarkedPicture {
  lab::Window window;
  std::vector<std::uint32_t> owner;
  std::vector<Mark> marks;
  std::vector<Line> lines;
};
MarkedPicture mark_coverage(const lab::CoverageTruth& truth, std::vector<lab::Run> runs,
                            std::span<const lab::FloatTriangle> triangles, double reach_px);
MarkedPicture mark_owners(std::span<const std::uint32_t> truth, std::span<const std::uint32_t> said,
                          lab::Window window);
// Faces that look at the eye, over those that were kept or dropped by mistake.
MarkedPicture mark_faces(const lab::FacingScene& scene, std::span<const lab::FaceFacts> facts,
                         std::span<const std::uint8_t> kept);

// The part where the most is wrong.
Closeup closeup(const std::string& name, const MarkedPicture& picture);

// Appends a close-up unless one from `first` on shows the same: methods that draw alike need one picture.
void add_unless_known(Closeup closeup, std::vector<Closeup>& closeups, std::size_t first);

Image draw(const Closeup& closeup);
// Throws std::runtime_error where no folder could be made or written to; makes none yet.
void check_closeup_folder(const std::filesystem::path& folder);
// FOLDER/NAME.png; makes the folder. Throws std::runtime_error where it cannot.
void write_closeups(const std::filesystem::path& folder, std::span<const Closeup> closeups);

}  // namespace edgewise::app
