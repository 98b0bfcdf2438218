#include "lab/coverage/visible.h"

#include <algorithm>
#include <utility>

#include "edgewise/contract.h"
#include "lab/projection/truth.h"

namespace edgewise::lab {

namespace {

template <typename Visit>
void each_pixel(Size size, Visit&& visit) {
  std::size_t pixel = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) visit(x, y, pixel++);
}

// Returns their number. Calls on_wrong(drawn, expected) for each. number(payload) is the triangle's number in
// the truth.
template <typename Number, typename OnWrong>
std::uint64_t wrong_pixels(const Canvas& canvas, const VisibleTriangles& truth, Number&& number,
                           OnWrong&& on_wrong) {
  std::uint64_t wrong = 0;
  each_pixel({truth.window.width, truth.window.height}, [&](int x, int y, std::size_t pixel) {
    const std::uint32_t drawn = number(canvas.frame.payload_row(y)[x]), expected = truth.triangle[pixel];
    if (drawn == expected) return;
    ++wrong;
    on_wrong(drawn, expected);
  });
  return wrong;
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
      by_source_(scene_.truth ? scene_.truth->visible_triangles(scene_.window(), threads)
                              : exact_visible_triangles(std::span(scene_.floats), scene_.window(), threads)) {
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
  const FloatSource floats(scene_.floats);
  const SourceTruth& sources = scene_.truth ? static_cast<const SourceTruth&>(*scene_.truth) : floats;
  const auto in_scene = [](std::uint32_t payload) { return payload - 1; };  // kNoTriangle for the background
  const auto in_source = [&](std::uint32_t payload) {
    return payload == 0 ? kNoTriangle : source(payload - 1);
  };
  Canvas canvas(scene_.size.width, scene_.size.height);
  method.draw(scene_.input(), canvas, {});
  VisibleTriangleScore score{.wrong_snapped = wrong_pixels(canvas, by_grid_, in_scene, [](auto, auto) {})};
  score.wrong_source =
      wrong_pixels(canvas, by_source_, in_source, [&](std::uint32_t drawn, std::uint32_t expected) {
        score.wrong_surface += drawn == kNoTriangle || expected == kNoTriangle ||
                               !touch(sources.outline(drawn), sources.outline(expected));
      });
  std::vector<Shown> picture;
  each_pixel(scene_.size, [&](int x, int y, std::size_t) {
    const std::uint32_t payload = canvas.frame.payload_row(y)[x];
    picture.push_back(payload == 0                ? Shown::background
                      : shares_edge_[payload - 1] ? Shown::mesh
                                                  : Shown::single);
  });
  score.slits = slits_of(picture, scene_.size);
  if (method.contract_depth && method.info.exact) score.unexplained = unexplained(canvas);
  return score;
}

std::uint64_t VisibleTriangleJudge::unexplained(const Canvas& canvas) const {
  std::uint64_t count = 0;
  each_pixel(scene_.size, [&](int x, int y, std::size_t pixel) {
    const std::uint32_t drawn = canvas.frame.payload_row(y)[x] - 1, visible_id = by_grid_.triangle[pixel];
    if (drawn == visible_id) return;
    const auto explains = [&] {
      if (drawn == kNoTriangle || visible_id == kNoTriangle) return false;
      const SnappedTruth truth(scene_.snapped[drawn]);
      return truth.covers(x, y) &&
             truth.depth(x, y).get_d() - by_grid_.depth[pixel] <= 2.0 * contract::kDepthError;
    };
    count += !explains();
  });
  return count;
}

}  // namespace edgewise::lab
