#include "bench/peers/judge.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bench/peers/scene.h"
#include "edgewise/contract.h"
#include "lab/portable/conformance.h"

namespace edgewise::bench {

namespace {

using namespace contract;

bool covers(const Oriented& t, int x, int y) {
  return t.area > 0 && make_edge(t, 0).at(x, y) >= 0 && make_edge(t, 1).at(x, y) >= 0 &&
         make_edge(t, 2).at(x, y) >= 0;
}

class Judge {
 public:
  Judge(const Framebuffer& ours, std::span<const ScreenTriangle> triangles)
      : ours_(ours), triangles_(triangles) {}

  bool is_depth_tie(std::uint32_t our_id, std::uint32_t their_id, int x, int y) const {
    const ScreenTriangle *mine = find(our_id, x, y), *other = find(their_id, x, y);
    if (mine == nullptr || other == nullptr) return false;
    const double gap = double{1} * make_depth(orient(*other)).at(x, y) - ours_.depth_row(y)[x];
    return gap <= 2.0 * kDepthError + float_plane_error(*mine, ours_.width(), ours_.height()) +
                      float_plane_error(*other, ours_.width(), ours_.height());
  }

 private:
  // The piece of triangle `id` that covers the pixel, or null.
  const ScreenTriangle* find(std::uint32_t id, int x, int y) const {
    const auto [begin, end] =
        std::equal_range(triangles_.begin(), triangles_.end(), ScreenTriangle{{}, {}, {}, id},
                         [](const auto& a, const auto& b) { return a.payload < b.payload; });
    const auto found = std::find_if(begin, end, [&](const auto& t) { return covers(orient(t), x, y); });
    return found == end ? nullptr : &*found;
  }

  const Framebuffer& ours_;
  std::span<const ScreenTriangle> triangles_;
};

}  // namespace

double float_plane_error(const ScreenTriangle& t, int width, int height) {
  const Oriented o = orient(t);
  const auto [low, high] = std::minmax({o.z[0], o.z[1], o.z[2]});
  const auto length_px = [](const std::int32_t(&v)[3]) {
    return static_cast<double>(std::abs(v[1] - v[0]) + std::abs(v[2] - v[0])) / kSub;
  };
  return lab::float_plane_error(static_cast<double>(high), static_cast<double>(high - low), length_px(o.x),
                                length_px(o.y), static_cast<double>(o.area) / (kSub * kSub), width, height);
}

PeerJudgement judge(const Framebuffer& ours, std::span<const std::uint32_t> theirs,
                    std::span<const ScreenTriangle> triangles) {
  const Judge judge(ours, triangles);
  PeerJudgement result;
  for (int y = 0; y < ours.height(); ++y) {
    const auto row = theirs.subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(ours.width()));
    for (int x = 0; x < ours.width(); ++x) {
      const std::uint32_t mine = ours.payload_row(y)[x], other = row[static_cast<std::size_t>(x)];
      result.drawn += mine != kNoTriangle || other != kNoTriangle;
      if (mine == other) continue;
      if (mine == kNoTriangle || other == kNoTriangle) {
        ++result.coverage;
      } else if (judge.is_depth_tie(mine, other, x, y)) {
        ++result.depth_ties;
        continue;
      } else {
        ++result.other_triangles;
      }
      if (result.first_x < 0) result.first_x = x, result.first_y = y;
    }
  }
  return result;
}

}  // namespace edgewise::bench
