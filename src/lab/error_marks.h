// Which pixels of a picture are wrong, and how.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lab/coverage/score.h"
#include "lab/facing/facing.h"

namespace edgewise::lab {

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

// The whole picture of a method, from which close-ups are cut.
struct MarkedPicture {
  Window window;
  std::vector<std::uint32_t> visible;
  std::vector<Mark> marks;
  std::vector<Line> lines;
};
MarkedPicture mark_coverage(const CoverageTruth& truth, std::vector<Run> runs,
                            std::span<const FloatTriangle> triangles, double reach_px);
MarkedPicture mark_visible_triangles(std::span<const std::uint32_t> truth,
                                     std::span<const std::uint32_t> drawn, Window window);
// Faces that look at the eye, over those that were kept or dropped by mistake.
MarkedPicture mark_faces(const FacingScene& scene, std::span<const FaceFacts> facts,
                         std::span<const std::uint8_t> kept);

}  // namespace edgewise::lab
