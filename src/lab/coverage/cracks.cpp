#include "lab/coverage/cracks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace edgewise::lab {

namespace {

constexpr double kOnEdge_px = 0x1p-10, kSameDepth = 0x1p-20;  // described in cracks.h

struct Corner {
  float x, y, z;
  auto operator<=>(const Corner&) const = default;
};

Corner corner(const UnsnappedTriangle& t, int i) {
  return {t.x_px[i % 3], t.y_px[i % 3], t.z01[i % 3]};
}

// Whether two corners are copies of one vertex.
bool same(const glm::dvec3& a, const glm::dvec3& b) {
  return std::abs(a.x - b.x) <= kOnEdge_px && std::abs(a.y - b.y) <= kOnEdge_px &&
         std::abs(a.z - b.z) <= kSameDepth;
}
bool same(const Corner& a, const Corner& b) {
  return same(glm::dvec3(a.x, a.y, a.z), glm::dvec3(b.x, b.y, b.z));
}

// An edge of a triangle, in the direction that is clockwise on the screen.
struct Side {
  Corner from, to;
  std::uint32_t edge;  // 3 triangle + edge

  double dx() const { return double{to.x} - double{from.x}; }
  double dy() const { return double{to.y} - double{from.y}; }
  double length() const { return std::sqrt(dx() * dx() + dy() * dy()); }
  // How far along the edge and how far off its line a corner lies, in px.
  double along(const Corner& c) const {
    return ((double{c.x} - double{from.x}) * dx() + (double{c.y} - double{from.y}) * dy()) / length();
  }
  double off(const Corner& c) const {
    return std::abs((double{c.x} - double{from.x}) * dy() - (double{c.y} - double{from.y}) * dx()) / length();
  }
  double z_at(double along_px) const {
    return double{from.z} + (double{to.z} - double{from.z}) * along_px / length();
  }
};

std::vector<Side> sides_of(std::span<const FloatTriangle> triangles, std::span<const std::int8_t> facing) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (facing[i] == 0) continue;
    for (int k = 0; k < 3; ++k) {
      Side side{corner(triangles[i].at, k), corner(triangles[i].at, k + 1),
                3 * i + static_cast<std::uint32_t>(k)};
      if (facing[i] < 0) std::swap(side.from, side.to);
      sides.push_back(side);
    }
  }
  return sides;
}

bool opposite(const Side& one, const Side& other) {
  return one.dx() * other.dx() + one.dy() * other.dy() < 0;
}

// Whether `one` has an end strictly inside `other`, and both run along one another there.
bool runs_along(const Side& one, const Side& other) {
  if (!opposite(one, other)) return false;
  for (const bool first : {true, false}) {
    const Corner &end = first ? one.from : one.to, &rest = first ? one.to : one.from;
    const double at = other.along(end);
    if (at <= kOnEdge_px || at >= other.length() - kOnEdge_px || other.off(end) > kOnEdge_px ||
        std::abs(other.z_at(at) - double{end.z}) > kSameDepth)
      continue;
    // The sides overlap from that end to the nearer of two others.
    const double rest_at = other.along(rest);
    const bool inside = rest_at >= 0 && rest_at <= other.length();
    if (inside ? other.off(rest) <= kOnEdge_px : one.off(rest_at < 0 ? other.from : other.to) <= kOnEdge_px)
      return true;
  }
  return false;
}

// Where each triangle's runs begin in a sorted list.
class RunIndex {
 public:
  RunIndex(std::span<const Run> runs, std::size_t triangles) : runs_(runs), first_(triangles + 1, 0) {
    for (const Run& run : runs) ++first_[run.triangle + 1];
    for (std::size_t i = 0; i < triangles; ++i) first_[i + 1] += first_[i];
  }
  bool has(std::uint32_t triangle, int x, int y) const {
    const auto runs = runs_.subspan(first_[triangle], first_[triangle + 1] - first_[triangle]);
    const auto begin = runs.begin(), end = runs.end();
    const auto run =
        std::partition_point(begin, end, [&](const Run& r) { return r.y < y || (r.y == y && r.x1 <= x); });
    return run != end && run->y == y && run->x0 <= x;
  }

 private:
  std::span<const Run> runs_;
  std::vector<std::uint32_t> first_;
};

// A triangle's sample.
struct Pair {
  std::int32_t y, x;
  std::uint32_t triangle;
  auto operator<=>(const Pair&) const = default;
};

// Compares what is drawn with a truth, at the edges where triangles meet. across(triangle, edge, visit) calls
// visit(other) for each triangle on the other side of an edge until one returns true, and returns whether one
// did.
template <typename Across>
class Seams {
 public:
  Seams(const Surface& surface, std::span<const Run> truth, std::span<const Run> drawn, Across across)
      : surface_(surface),
        truth_(truth, surface.triangles().size()),
        drawn_(drawn, surface.triangles().size()),
        across_(across) {
    for_each_difference(truth, drawn, [&](const Run& run, bool missing) {
      for (int x = run.x0; x < run.x1; ++x) (missing ? lost_ : extra_).push_back({run.y, x, run.triangle});
    });
  }

  std::vector<Sample> gaps() const {
    const auto triangles = surface_.triangles();
    std::vector<Pair> open;
    for (const Pair& lost : lost_) {
      bool reached = false;  // by a triangle on the other side
      const bool drawn = across_(lost.triangle, surface_.nearest_edge(lost.triangle, lost.x, lost.y),
                                 [&](std::uint32_t other) {
                                   reached = true;
                                   return drawn_.has(other, lost.x, lost.y);
                                 });
      if (reached && !drawn) open.push_back(lost);
    }
    std::sort(open.begin(), open.end());
    std::vector<bool> closed(open.size(), false);
    for (const Pair& extra : extra_) {
      auto at = std::lower_bound(open.begin(), open.end(), Pair{extra.y, extra.x, 0});
      for (; at != open.end() && at->y == extra.y && at->x == extra.x; ++at)
        if (touch(triangles[at->triangle].at, triangles[extra.triangle].at))
          closed[static_cast<std::size_t>(at - open.begin())] = true;
    }
    std::vector<Sample> gaps;
    for (std::size_t i = 0; i < open.size(); ++i)
      if (!closed[i]) gaps.push_back({open[i].y, open[i].x});
    return gaps;
  }

  std::vector<Sample> double_hits() const {
    std::vector<Pair> twice;
    for (const Pair& extra : extra_)
      for (int edge = 0; edge < 3; ++edge)
        across_(extra.triangle, edge, [&](std::uint32_t other) {
          if (truth_.has(other, extra.x, extra.y) && drawn_.has(other, extra.x, extra.y))
            twice.push_back({extra.y, extra.x, other});
          return false;
        });
    std::sort(twice.begin(), twice.end());
    twice.erase(std::unique(twice.begin(), twice.end()), twice.end());
    std::vector<Sample> hits;
    for (const Pair& pair : twice) hits.push_back({pair.y, pair.x});
    return hits;
  }

 private:
  const Surface& surface_;
  RunIndex truth_, drawn_;
  Across across_;
  std::vector<Pair> lost_, extra_;
};

}  // namespace

std::vector<Sample> folds_of(const Surface& surface, std::span<const Run> before,
                             std::span<const Run> after) {
  std::vector<Pair> moved;
  for_each_difference(before, after, [&](const Run& run, bool missing) {
    for (int x = run.x0; x < run.x1 && !missing; ++x) moved.push_back({run.y, x, run.triangle});
  });
  std::sort(moved.begin(), moved.end());
  std::vector<Sample> folds;
  for (const Run& run : after)
    for (auto at = std::lower_bound(moved.begin(), moved.end(), Pair{run.y, run.x0, 0});
         at != moved.end() && at->y == run.y && at->x < run.x1; ++at)
      if (at->triangle != run.triangle && surface.side_by_side(at->triangle, run.triangle))
        folds.push_back({at->y, at->x});
  std::sort(folds.begin(), folds.end());
  folds.erase(std::unique(folds.begin(), folds.end()), folds.end());
  return folds;
}

double rounded_to(double px, int subpixel_bits) {
  return std::ldexp(std::nearbyint(std::ldexp(px, subpixel_bits)), -subpixel_bits);
}

std::vector<FloatTriangle> rounded_to(std::span<const FloatTriangle> triangles, int subpixel_bits) {
  std::vector<FloatTriangle> list(triangles.begin(), triangles.end());
  const auto round = [&](float& px) { px = static_cast<float>(rounded_to(double{px}, subpixel_bits)); };
  for (FloatTriangle& t : list)
    for (int i = 0; i < 3; ++i) round(t.at.x_px[i]), round(t.at.y_px[i]);
  return list;
}

bool touch(const UnsnappedTriangle& a, const UnsnappedTriangle& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (same(corner(a, i), corner(b, j))) return true;
  return false;
}

bool touch(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  return std::ranges::any_of(a, [&](const glm::dvec3& corner) {
    return std::ranges::any_of(b, [&](const glm::dvec3& other) { return same(corner, other); });
  });
}

Surface::Surface(std::span<const FloatTriangle> triangles) : triangles_(triangles) {
  do find_shared_edges();
  while (!find_t_junctions());
}

void Surface::find_shared_edges() {
  across_.assign(3 * triangles_.size(), kNoTriangle);
  facing_.clear();
  for (const FloatTriangle& t : triangles_)
    facing_.push_back(static_cast<std::int8_t>(FloatTruth(t.at).facing()));
  std::vector<Side> sides = sides_of(triangles_, facing_);
  const auto ends = [](const Side& s) { return std::minmax(s.from, s.to); };  // by reference to the side
  std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
    return std::tuple(ends(a), a.from < a.to, a.edge) < std::tuple(ends(b), b.from < b.to, b.edge);
  });
  for (auto side = sides.begin(); side != sides.end();) {
    const auto same = [&](const Side& s) { return ends(s) == ends(*side); };
    const auto next = std::find_if_not(side, sides.end(), same);
    auto other = std::find_if(side, next, [](const Side& s) { return s.from < s.to; });
    for (const auto middle = other; side != middle && other != next; ++side, ++other)
      across_[side->edge] = other->edge / 3, across_[other->edge] = side->edge / 3;
    side = next;
  }
}

// Looks up the ends of unshared edges in the rows and columns that each unshared edge crosses. Returns false,
// having moved the copies of vertices together, if two of these edges have the same ends.
bool Surface::find_t_junctions() {
  t_junctions_.clear();
  std::map<Corner, Corner> copies;  // the least copy of a vertex
  const auto add_copy = [&](const Corner& a, const Corner& b) {
    if (a == b) return;
    const auto& [least, copy] = std::minmax(a, b);
    Corner& known = copies.try_emplace(copy, least).first->second;
    known = std::min(known, least);
  };
  std::vector<Side> sides = sides_of(triangles_, facing_);
  std::erase_if(sides, [&](const Side& s) { return across_[s.edge] != kNoTriangle; });
  struct End {
    double row;
    float x;
    std::uint32_t side;
  };
  std::vector<End> ends;
  for (std::uint32_t i = 0; i < sides.size(); ++i)
    for (const Corner& c : {sides[i].from, sides[i].to}) ends.push_back({std::floor(double{c.y}), c.x, i});
  const auto place = [](const End& e) { return std::pair(e.row, double{e.x}); };
  std::sort(ends.begin(), ends.end(), [&](const End& a, const End& b) {
    return std::tuple(a.row, a.x, a.side) < std::tuple(b.row, b.x, b.side);
  });
  for (const Side& side : sides) {
    const auto [low, high] = std::minmax({double{side.from.y}, double{side.to.y}});
    for (double row = std::floor(low - kOnEdge_px); row <= high + kOnEdge_px; ++row) {
      const auto x_at = [&](double y) {
        const double t = high > low ? (std::clamp(y, low, high) - double{side.from.y}) / side.dy() : 0.0;
        return double{side.from.x} + t * side.dx();
      };
      double left = std::min(x_at(row - kOnEdge_px), x_at(row + 1 + kOnEdge_px)),
             right = std::max(x_at(row - kOnEdge_px), x_at(row + 1 + kOnEdge_px));
      if (high == low)
        left = std::min(double{side.from.x}, double{side.to.x}),
        right = std::max(double{side.from.x}, double{side.to.x});
      for (auto end = std::lower_bound(ends.begin(), ends.end(), std::pair(row, left - kOnEdge_px),
                                       [&](const End&e, const auto&at) { return place(e) < at; });
           end != ends.end() && place(*end) <= std::pair(row, right + kOnEdge_px); ++end) {
        const Side& other = sides[end->side];
        if (other.edge / 3 == side.edge / 3) continue;
        if (opposite(side, other) && same(side.from, other.to) && same(side.to, other.from))
          add_copy(side.from, other.to), add_copy(side.to, other.from);
        if (!runs_along(other, side)) continue;
        t_junctions_.emplace_back(side.edge, other.edge / 3);
        t_junctions_.emplace_back(other.edge, side.edge / 3);
      }
    }
  }
  if (!copies.empty()) {
    for (auto& [copy, least] : copies)  // from the least on, so that no chain is left
      if (const auto lesser = copies.find(least); lesser != copies.end()) least = lesser->second;
    if (moved_.empty()) moved_.assign(triangles_.begin(), triangles_.end());
    for (FloatTriangle& t : moved_)
      for (int i = 0; i < 3; ++i)
        if (const auto found = copies.find(corner(t.at, i)); found != copies.end())
          std::tie(t.at.x_px[i], t.at.y_px[i], t.at.z01[i]) =
              std::tie(found->second.x, found->second.y, found->second.z);
    triangles_ = moved_;
    return false;
  }
  std::sort(t_junctions_.begin(), t_junctions_.end());
  t_junctions_.erase(std::unique(t_junctions_.begin(), t_junctions_.end()), t_junctions_.end());
  return true;
}

std::span<const std::pair<std::uint32_t, std::uint32_t>> Surface::along(std::uint32_t triangle,
                                                                        int edge) const {
  const std::uint32_t key = 3 * triangle + static_cast<std::uint32_t>(edge);
  const auto first = std::lower_bound(t_junctions_.begin(), t_junctions_.end(), std::pair(key, 0u));
  return {first,
          std::find_if(first, t_junctions_.end(), [&](const auto& pair) { return pair.first != key; })};
}

int Surface::nearest_edge(std::uint32_t triangle, int px, int py) const {
  const UnsnappedTriangle& t = triangles_[triangle].at;
  int nearest = 0;
  double least = 0.0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double dx = double{t.x_px[j]} - double{t.x_px[i]}, dy = double{t.y_px[j]} - double{t.y_px[i]},
                 off = (px + 0.5 - double{t.x_px[i]}) * dy - (py + 0.5 - double{t.y_px[i]}) * dx,
                 squared = off * off / (dx * dx + dy * dy);
    if (i == 0 || squared < least || (squared == least && across(triangle, i) == kNoTriangle))
      nearest = i, least = squared;
  }
  return nearest;
}

bool Surface::side_by_side(std::uint32_t a, std::uint32_t b) const {
  struct Ray {
    double x, y;
    double cross(const Ray& other) const { return x * other.y - y * other.x; }
    bool along(const Ray& other) const { return cross(other) == 0 && x * other.x + y * other.y > 0; }
  };
  // From a vertex to the next one, clockwise, and to the one after it.
  const auto rays = [&](std::uint32_t triangle, int i) {
    const UnsnappedTriangle& t = triangles_[triangle].at;
    const auto to = [&](int j) {
      return Ray{double{t.x_px[j % 3]} - double{t.x_px[i]}, double{t.y_px[j % 3]} - double{t.y_px[i]}};
    };
    return facing_[triangle] > 0 ? std::pair(to(i + 1), to(i + 2)) : std::pair(to(i + 2), to(i + 1));
  };
  const auto within = [](const Ray& ray, const std::pair<Ray, Ray>& sector) {
    return sector.first.cross(ray) > 0 && ray.cross(sector.second) > 0;
  };
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (corner(triangles_[a].at, i) == corner(triangles_[b].at, j)) {
        const auto one = rays(a, i), other = rays(b, j);
        return !within(one.first, other) && !within(one.second, other) && !within(other.first, one) &&
               !within(other.second, one) && !one.first.along(other.first) && !one.second.along(other.second);
      }
  return false;
}

std::uint64_t Surface::crossings(Window window) const {
  double sum = 0.0;
  const auto end = [&](std::uint32_t triangle, int i) {
    const Corner c = corner(triangles_[triangle].at, i);
    return glm::dvec2(c.x, c.y);
  };
  for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    for (int edge = 0; edge < 3; ++edge)
      if (const std::uint32_t other = across(i, edge); other != kNoTriangle && i < other)
        sum += crossings_of(end(i, edge), end(i, edge + 1), window);
  return static_cast<std::uint64_t>(sum);
}

CrackJudge::CrackJudge(std::span<const FloatTriangle> triangles, const CoverageTruth& floats)
    : surface_(triangles), window_(floats.window), runs_(floats.runs) {
  if (!surface_.moved()) return;
  moved_runs_ = covered_runs(surface_.triangles(), window_, 1);
  runs_ = moved_runs_;
}

const CrackJudge::Rounded& CrackJudge::rounded(int bits) const {
  Rounded& found = rounded_[static_cast<std::size_t>(bits)];
  std::call_once(found.once, [&] {
    const std::vector<FloatTriangle> list = rounded_to(surface_.triangles(), bits);
    constexpr int kSnappedBits = 8;  // which the truth in integers holds
    found.runs =
        bits <= kSnappedBits ? covered_runs(snapped(list), window_, 1) : covered_runs(list, window_, 1);
    found.folds = folds_of(surface_, runs_, found.runs);
  });
  return found;
}

Cracks CrackJudge::find(const DrawnRuns& drawn, std::optional<int> snap_bits) const {
  Cracks cracks;
  std::span<const Run> own = runs_;
  if (snap_bits) {
    const Rounded& found = rounded(*snap_bits);
    own = found.runs;
    cracks.folds = found.folds;
  }
  const Seams shared(surface_, own, drawn.runs, [&](std::uint32_t triangle, int edge, auto&& visit) {
    const std::uint32_t other = surface_.across(triangle, edge);
    return other != kNoTriangle && visit(other);
  });
  cracks.gaps = shared.gaps(), cracks.double_hits = shared.double_hits();
  if (!surface_.has_t_junctions()) return cracks;
  const Seams junctions(surface_, runs_, drawn.runs, [&](std::uint32_t triangle, int edge, auto&& visit) {
    return std::ranges::any_of(surface_.along(triangle, edge),
                               [&](const auto& pair) { return visit(pair.second); });
  });
  cracks.t_gaps = junctions.gaps(), cracks.t_double_hits = junctions.double_hits();
  return cracks;
}

}  // namespace edgewise::lab
