#include "lab/coverage/visible.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edgewise/contract.h"
#include "lab/coverage/cracks.h"

namespace edgewise::lab {

namespace {

constexpr std::uint32_t kBackground = 0;

// A triangle's index → its payload in the pictures here.
std::uint32_t shown(std::uint32_t visible_id) {
  return visible_id == kNoTriangle ? kBackground : visible_id + 1;
}

double float_ulp(double depth01) {
  constexpr double kLeast = 0x1p-8;
  const auto size = static_cast<float>(std::max(std::abs(depth01), kLeast));
  return std::ldexp(1.0, std::ilogb(size) - (std::numeric_limits<float>::digits - 1));
}

template <typename Visit>
void each_pixel(Size size, Visit&& visit) {
  std::size_t pixel = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) visit(x, y, pixel++);
}

// Returns their number. Calls on_wrong(drawn, expected) for each, with payloads.
template <typename OnWrong>
std::uint64_t wrong_pixels(const Canvas& canvas, const VisibleTriangles& truth, OnWrong&& on_wrong) {
  std::uint64_t wrong = 0;
  each_pixel({truth.window.width, truth.window.height}, [&](int x, int y, std::size_t pixel) {
    const std::uint32_t drawn = canvas.frame.payload_row(y)[x], expected = shown(truth.triangle[pixel]);
    if (drawn == expected) return;
    ++wrong;
    on_wrong(drawn, expected);
  });
  return wrong;
}

// error(x, y, exact) returns an error in ulps.
template <typename Error>
void add_depth_errors(VisibleTriangleScore& score, const Canvas& canvas, const VisibleTriangles& truth,
                      Error&& error) {
  double squares = 0.0;
  std::uint64_t count = 0;
  each_pixel({truth.window.width, truth.window.height}, [&](int x, int y, std::size_t pixel) {
    const std::uint32_t visible_id = truth.triangle[pixel];
    if (visible_id == kNoTriangle || canvas.frame.payload_row(y)[x] != shown(visible_id)) return;
    const double ulp = error(x, y, truth.depth[pixel]);
    score.max_ulp = std::max(score.max_ulp, ulp);
    squares += ulp * ulp;
    ++count;
  });
  if (count > 0) score.rms_ulp = std::sqrt(squares / static_cast<double>(count));
}

template <typename Triangle>
std::vector<Triangle> numbered(std::span<const Triangle> triangles) {
  std::vector<Triangle> list(triangles.begin(), triangles.end());
  std::uint32_t number = 0;
  for (Triangle& triangle : list) triangle.payload = ++number;
  return list;
}

}  // namespace

VisibleTriangleJudge::VisibleTriangleJudge(const CoverageInput& input, Size size, int threads)
    : size_(size),
      floats_(numbered(input.floats)),
      snapped_(numbered(input.snapped)),
      by_grid_(exact_visible_triangles(snapped_, {size.width, size.height}, threads)),
      by_floats_(exact_visible_triangles(floats_, {size.width, size.height}, threads)) {}

VisibleTriangleScore VisibleTriangleJudge::score(const CoverageMethod& method) const {
  Canvas canvas(size_.width, size_.height);
  method.draw({floats_, snapped_}, canvas, {});
  VisibleTriangleScore score{.wrong_snapped = wrong_pixels(canvas, by_grid_, [](auto, auto) {})};
  score.wrong_floats = wrong_pixels(canvas, by_floats_, [&](std::uint32_t drawn, std::uint32_t expected) {
    score.wrong_surface += drawn == kBackground || expected == kBackground ||
                           !touch(floats_[drawn - 1].at, floats_[expected - 1].at);
  });
  if (method.contract_depth) {
    add_depth_errors(score, canvas, by_grid_, [&](int x, int y, double exact) {
      return std::abs(static_cast<double>(canvas.frame.depth_row(y)[x]) - exact);
    });
    if (method.info.exact) score.unexplained = unexplained(canvas);
  } else {
    add_depth_errors(score, canvas, by_floats_, [&](int x, int y, double exact) {
      return std::abs(double{canvas.depth[static_cast<std::size_t>(y * canvas.frame.stride() + x)]} - exact) /
             float_ulp(exact);
    });
  }
  return score;
}

std::uint64_t VisibleTriangleJudge::unexplained(const Canvas& canvas) const {
  std::uint64_t count = 0;
  each_pixel(size_, [&](int x, int y, std::size_t pixel) {
    const std::uint32_t drawn = canvas.frame.payload_row(y)[x], visible_id = by_grid_.triangle[pixel];
    if (drawn == shown(visible_id)) return;
    const auto explains = [&] {
      if (drawn == kBackground || visible_id == kNoTriangle) return false;
      const SnappedTruth truth(snapped_[drawn - 1]);
      return truth.covers(x, y) &&
             truth.depth(x, y).get_d() - by_grid_.depth[pixel] <= 2.0 * contract::kDepthError;
    };
    count += !explains();
  });
  return count;
}

}  // namespace edgewise::lab
