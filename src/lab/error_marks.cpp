#include "lab/error_marks.h"

#include "edgewise/screen_triangle.h"

namespace edgewise::lab {

namespace {

constexpr std::uint32_t kMarkColours[] = {rgb(255, 255, 255), rgb(213, 94, 0), rgb(0, 114, 178),
                                          rgb(240, 228, 66), rgb(204, 121, 167)};

std::size_t pixels_of(Window w) {
  return static_cast<std::size_t>(w.width) * static_cast<std::size_t>(w.height);
}

void add_edges(const SourceTruth& source, std::vector<Line>& lines) {
  for (std::uint32_t t = 0; t < source.size(); ++t) {
    const auto outline = source.outline(t);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec3 &from = outline[i], &to = outline[(i + 1) % outline.size()];
      lines.push_back({from.x, from.y, to.x, to.y});
    }
  }
}

}  // namespace

std::uint32_t colour_of(Mark mark) {
  return kMarkColours[static_cast<std::size_t>(mark)];
}

MarkedPicture mark_coverage(const CoverageTruth& truth, const DrawnRuns& drawn, const Cracks& cracks,
                            const SourceTruth& source) {
  const Window w = truth.window;
  MarkedPicture picture{w,
                        std::vector<std::uint32_t>(pixels_of(w), kNoTriangle),
                        std::vector<Mark>(pixels_of(w), Mark::none),
                        {}};
  const auto pixel_at = [&](int x, int y) {
    return static_cast<std::size_t>(y - w.y0) * static_cast<std::size_t>(w.width) +
           static_cast<std::size_t>(x - w.x0);
  };
  const auto each_pixel = [&](const Run& run, auto&& visit) {
    for (int x = run.x0; x < run.x1; ++x) visit(pixel_at(x, run.y));
  };
  for (const Run& run : truth.runs)
    each_pixel(run, [&](std::size_t pixel) { picture.visible[pixel] = run.triangle; });

  for_each_difference(truth.runs, drawn.runs, [&](const Run& run, bool missing) {
    each_pixel(run, [&](std::size_t pixel) {
      Mark& mark = picture.marks[pixel];
      if (missing || mark == Mark::none) mark = missing ? Mark::missing : Mark::extra;
    });
  });
  for (const auto& [samples, mark] : {std::pair(&cracks.folds, Mark::twice),
                                      {&cracks.double_hits, Mark::twice},
                                      {&cracks.t_double_hits, Mark::twice},
                                      {&cracks.gaps, Mark::gap},
                                      {&cracks.t_gaps, Mark::gap}})
    for (const Sample& sample : *samples) picture.marks[pixel_at(sample.x, sample.y)] = mark;
  add_edges(source, picture.lines);
  return picture;
}

MarkedPicture mark_visible_triangles(std::span<const std::uint32_t> truth,
                                     std::span<const std::uint32_t> drawn, Window window) {
  MarkedPicture picture{window, {truth.begin(), truth.end()}, {}, {}};
  for (std::size_t i = 0; i < truth.size(); ++i)
    picture.marks.push_back(drawn[i] == truth[i]      ? Mark::none
                            : drawn[i] == kNoTriangle ? Mark::gap
                            : truth[i] == kNoTriangle ? Mark::extra
                                                      : Mark::twice);
  return picture;
}

}  // namespace edgewise::lab
