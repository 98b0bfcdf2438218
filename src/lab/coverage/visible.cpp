#include "lab/coverage/visible.h"

#include <utility>

#include "edgewise/contract.h"

namespace edgewise::lab {

namespace {

template <typename Visit>
void each_pixel(Size size, Visit&& visit) {
  std::size_t pixel = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) visit(x, y, pixel++);
}

enum class Shown : std::uint8_t { background, single, mesh };

std::uint64_t slits_of(const std::vector<Shown>& picture, Size size) {
  std::uint64_t count = 0;
  each_pixel(size, [&](int x, int y, std::size_t pixel) {
    const auto between = [&](int at, int end, std::size_t step) {
      return at > 0 && at + 1 < end && picture[pixel - step] == Shown::mesh &&
             picture[pixel + step] == Shown::mesh;
    };
    count += picture[pixel] == Shown::background &&
             (between(x, size.width, 1) || between(y, size.height, static_cast<std::size_t>(size.width)));
  });
  return count;
}

CoverageScene numbered(CoverageScene scene) {
  for (std::uint32_t i = 0; i < scene.floats.size(); ++i)
    scene.floats[i].payload = scene.snapped[i].payload = i + 1;
  return scene;
}

}  // namespace

VisibleTriangleJudge::VisibleTriangleJudge(CoverageScene scene, const Surface& surface, int threads)
    : scene_(numbered(std::move(scene))),
      by_grid_(exact_visible_triangles(std::span(scene_.snapped), scene_.window(), threads)),
      floats_(scene_.floats),
      source_(source_of(scene_, floats_)),
      by_source_(source_.visible_triangles(scene_.window(), threads)) {
  for (std::uint32_t i = 0; i < scene_.floats.size(); ++i)
    shares_edge_.push_back(surface.across(i, 0) != kNoTriangle || surface.across(i, 1) != kNoTriangle ||
                           surface.across(i, 2) != kNoTriangle);
}

std::uint64_t VisibleTriangleJudge::slits() const {
  std::vector<bool> shares;  // by triangle of the source
  for (std::uint32_t i = 0; i < shares_edge_.size(); ++i) {
    if (source(i) >= shares.size()) shares.resize(source(i) + 1, false);
    shares[source(i)] = shares[source(i)] || shares_edge_[i];
  }
  std::vector<Shown> picture;
  for (const std::uint32_t id : by_source_.triangle)
    picture.push_back(id == kNoTriangle                  ? Shown::background
                      : id < shares.size() && shares[id] ? Shown::mesh
                                                         : Shown::single);
  return slits_of(picture, scene_.size);
}

VisibleTriangleScore VisibleTriangleJudge::score(const CoverageMethod& method) const {
  Canvas canvas(scene_.size.width, scene_.size.height);
  method.draw(scene_.input(), canvas, {});
  VisibleTriangleScore score;
  std::vector<Shown> picture;
  each_pixel(scene_.size, [&](int x, int y, std::size_t pixel) {
    const std::uint32_t drawn = canvas.frame.payload_row(y)[x] - 1;  // kNoTriangle for the background
    picture.push_back(drawn == kNoTriangle  ? Shown::background
                      : shares_edge_[drawn] ? Shown::mesh
                                            : Shown::single);
    if (drawn != by_grid_.triangle[pixel]) {
      ++score.wrong_snapped;
      score.unexplained += method.contract_depth && method.info.exact && !explains(drawn, x, y);
    }
    const std::uint32_t shown = drawn == kNoTriangle ? drawn : source(drawn),
                        expected = by_source_.triangle[pixel];
    if (shown == expected) return;
    ++score.wrong_source;
    score.wrong_surface += shown == kNoTriangle || expected == kNoTriangle ||
                           !touch(source_.outline(shown), source_.outline(expected));
  });
  score.slits = slits_of(picture, scene_.size);
  return score;
}

bool VisibleTriangleJudge::explains(std::uint32_t drawn, int x, int y) const {
  if (drawn == kNoTriangle || by_grid_.triangle_at(x, y) == kNoTriangle) return false;
  const SnappedTruth truth(scene_.snapped[drawn]);
  const auto pixel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(scene_.size.width) + static_cast<std::size_t>(x);
  return truth.covers(x, y) &&
         truth.depth(x, y).get_d() - by_grid_.depth[pixel] <= 2.0 * contract::kDepthError;
}

}  // namespace edgewise::lab
