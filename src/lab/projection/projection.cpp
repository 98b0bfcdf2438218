#include "lab/projection/projection.h"

#include <utility>

#include "lab/truth/scan.h"

namespace edgewise::lab {

namespace {

std::uint64_t differing(std::span<const Run> a, std::span<const Run> b) {
  std::uint64_t count = 0;
  for_each_difference(a, b,
                      [&](const Run& run, bool) { count += static_cast<std::uint64_t>(run.x1 - run.x0); });
  return count;
}

}  // namespace

ProjectionScore& ProjectionScore::operator+=(const ProjectionScore& other) {
  wrong += other.wrong, folds += other.folds;
  by_rounding += other.by_rounding, by_projection += other.by_projection;
  return *this;
}

ProjectionJudge::ProjectionJudge(Scene scene, Size size, int threads)
    : truth_(std::move(scene), size, Cull::none),
      exact_(coverage_of(truth_, {size.width, size.height}, threads)),
      crossings_(edge_crossings(truth_, exact_.window)) {}

std::uint64_t ProjectionJudge::triangles() const {
  std::uint64_t count = 0;
  for (std::uint32_t i = 0; i < truth_.size(); ++i) count += truth_.facing(i) != 0;
  return count;
}

std::vector<Run> ProjectionJudge::runs_of(std::span<const ProjectedTriangle> triangles) const {
  std::vector<std::uint32_t> sources;
  for (const ProjectedTriangle& t : triangles) sources.push_back(t.source);
  auto runs = all_runs(
      triangles.size(), [&](std::size_t i) { return FloatTruth(triangles[i].x_px, triangles[i].y_px); },
      exact_.window, 1);
  return DrawnRuns(std::move(runs), exact_.window).of_sources(sources).runs;
}

const Surface& ProjectionJudge::surface() const {
  std::call_once(surface_once_, [&] {
    for (std::uint32_t i = 0; i < truth_.size(); ++i) {
      // Without three corners: a point that no other triangle has.
      const auto apart = -1.0f - static_cast<float>(i);
      FloatTriangle& t = outlines_.emplace_back(
          FloatTriangle{{{apart, apart, apart}, {apart, apart, apart}, {apart, apart, apart}}, i});
      const auto corners = truth_.outline(i);
      for (std::size_t k = 0; k < 3 && corners.size() == 3; ++k) {
        t.at.x_px[k] = static_cast<float>(corners[k].x), t.at.y_px[k] = static_cast<float>(corners[k].y);
        t.at.z01[k] = static_cast<float>(corners[k].z);
      }
    }
    surface_.emplace(outlines_);
  });
  return *surface_;
}

const ProjectionJudge::Rounded& ProjectionJudge::rounded(int bits) const {
  Rounded& found = rounded_[static_cast<std::size_t>(bits)];
  std::call_once(found.once, [&] {
    found.runs = runs_of(exactly_projected(truth_, bits));
    found.wrong = differing(exact_.runs, found.runs);
  });
  return found;
}

ProjectionScore ProjectionJudge::score(const ProjectionMethod& method) const {
  const std::vector<Run> drawn = runs_of(method.project(truth_, method.snap_bits));
  ProjectionScore score{.wrong = differing(exact_.runs, drawn)};
  score.by_projection = score.wrong;
  score.folds = folds_of(surface(), exact_.runs, drawn).size();
  if (!method.snap_bits) return score;
  const Rounded& exact = rounded(*method.snap_bits);
  score.by_rounding = exact.wrong;
  score.by_projection = differing(exact.runs, drawn);
  return score;
}

}  // namespace edgewise::lab
