#include "viewer/outlines.h"

#include <algorithm>
#include <vector>

namespace edgewise::viewer {

void add_outlines(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> visible,
                  Backend& wireframe, FrameView scratch, const Execution& execution, Image& image) {
  std::vector<std::uint32_t> pieces(1);  // by payload: number of triangles
  for (const ScreenTriangle& t : triangles) {
    pieces.resize(std::max<std::size_t>(pieces.size(), t.payload + std::size_t{1}));
    ++pieces[t.payload];
  }
  wireframe.draw(triangles, scratch, 0, execution);
  const auto visible_near = [&](std::uint32_t source, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u)
        if (visible[static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(u)] == source)
          return true;
    return false;
  };
  for (int y = 0; y < image.height; ++y) {
    const std::uint32_t* const lines = scratch.payload + std::ptrdiff_t{y} * scratch.stride;
    std::uint32_t* const row = image.pixels.data() + std::ptrdiff_t{y} * image.width;
    for (int x = 0; x < image.width; ++x)
      if (lines[x] != 0 && visible_near(lines[x] - 1, x, y))
        row[x] = pieces[lines[x]] > 1 ? kPiecesOutline : kOneOutline;
  }
}

}  // namespace edgewise::viewer
