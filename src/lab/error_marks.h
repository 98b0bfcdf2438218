// Marks the wrong pixels of a picture by the kind of error.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lab/coverage/cracks.h"

namespace edgewise::lab {

// A pixel's error; if several apply, the first one listed. The colours are distinguishable with any colour
// vision (Okabe and Ito, "Color universal design", 2008).
enum class Mark : std::uint8_t {
  none,
  gap,      // vermilion: coverage: a crack where triangles meet; visibility: nothing, not a triangle
  twice,    // blue: coverage: drawn twice where triangles meet; visibility: the wrong triangle is visible
  missing,  // yellow: a triangle lacks a pixel, on the outline or where another triangle is drawn; or a wrong
            // depth
  extra,    // purple: drawn outside the triangle, or where nothing must be drawn
};

std::uint32_t colour_of(Mark mark);  // none: paper

struct Line {
  double x0, y0, x1, y1;  // px
  bool operator==(const Line&) const = default;
};

// The whole picture of a method, from which close-ups are cut. Planes are row by row.
struct MarkedPicture {
  Window window;
  std::vector<std::uint32_t> visible;
  std::vector<Mark> marks;
  std::vector<Line> lines;
};
// `source` is that of the truth and of the drawn triangles.
MarkedPicture mark_coverage(const CoverageTruth& truth, const DrawnRuns& drawn, const Cracks& cracks,
                            const SourceTruth& source);
MarkedPicture mark_visible_triangles(std::span<const std::uint32_t> truth,
                                     std::span<const std::uint32_t> drawn, Window window);

}  // namespace edgewise::lab
