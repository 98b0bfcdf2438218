#include "lab/error_marks.h"

#include <algorithm>
#include <cmath>

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

using Polygon = std::vector<glm::dvec2>;  // px

Polygon projected(const FacingScene& scene, const Face& face) {
  const FacingView& v = scene.view;
  Polygon polygon;
  for (std::uint32_t i = face.first; i < face.first + face.count; ++i) {
    const glm::dvec3 ray = glm::dvec3(scene.positions[i]) - glm::dvec3(v.eye);
    const double w = v.perspective ? glm::dot(ray, glm::dvec3(v.forward)) : 1.0;
    polygon.emplace_back(v.size.width / 2.0 + double{v.focal_px} * glm::dot(ray, glm::dvec3(v.right)) / w,
                         v.size.height / 2.0 + double{v.focal_px} * glm::dot(ray, glm::dvec3(v.down)) / w);
  }
  return polygon;
}

// Even-odd rule.
bool contains(const Polygon& polygon, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y <= y) != (b.y <= y) && x < a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y)) inside = !inside;
  }
  return inside;
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

MarkedPicture mark_faces(const FacingScene& scene, std::span<const FaceFacts> facts,
                         std::span<const std::uint8_t> kept) {
  const Window window{scene.view.size.width, scene.view.size.height};
  MarkedPicture picture{window,
                        std::vector<std::uint32_t>(pixels_of(window), kNoTriangle),
                        std::vector<Mark>(pixels_of(window), Mark::none),
                        {}};
  for (std::uint32_t i = 0; i < scene.faces.size(); ++i) {
    const Polygon polygon = projected(scene, scene.faces[i]);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const glm::dvec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
      picture.lines.push_back({a.x, a.y, b.x, b.y});
    }
    const bool keep = kept[i] != 0, front = facts[i].source.front;
    if (!facts[i].source.covers_sample || (!front && !keep)) continue;
    for (int y = 0; y < window.height; ++y)
      for (int x = 0; x < window.width; ++x) {
        if (!contains(polygon, x + 0.5, y + 0.5)) continue;
        const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width) +
                                  static_cast<std::size_t>(x);
        if (front) picture.visible[pixel] = i;
        if (front != keep) picture.marks[pixel] = keep ? Mark::extra : Mark::gap;
      }
  }
  return picture;
}

}  // namespace edgewise::lab
