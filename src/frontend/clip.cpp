#include "frontend/clip.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edgewise/contract.h"

namespace edgewise {

namespace {

constexpr double kGuardPx = contract::kMaxImageSide;

// Distance to a plane times a positive factor; >= 0 is inside.
double distance(const ClipVertex& v, std::uint16_t plane, const ViewVolume& view) {
  const double guard = kGuardPx * v.w;
  switch (plane) {
    case kNear:
      return v.z - view.near_z;
    case kFar:
      return view.far_z + view.far_w * v.w - v.z;
    case kGuardLeft:
      return v.x + guard;
    case kGuardRight:
      return guard - v.x;
    case kGuardTop:
      return v.y + guard;
    default:
      return guard - v.y;
  }
}

// The point where an edge crosses a plane.
ClipVertex cut(const ClipVertex& inside, const ClipVertex& outside, double t) {
  const auto between = [&](double from, double to) { return from + t * (to - from); };
  return {between(inside.x, outside.x), between(inside.y, outside.y), between(inside.z, outside.z),
          between(inside.w, outside.w)};
}

}  // namespace

std::uint16_t outside_of(const ClipVertex& v, const ViewVolume& view) {
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z) || !std::isfinite(v.w))
    return kNotFinite;
  unsigned sides = 0;
  for (const auto plane : {kNear, kFar, kGuardLeft, kGuardRight, kGuardTop, kGuardBottom})
    if (distance(v, plane, view) < 0.0) sides |= plane;
  if (v.x < 0.0) sides |= kLeft;
  if (v.x > view.width_px * v.w) sides |= kRight;
  if (v.y < 0.0) sides |= kTop;
  if (v.y > view.height_px * v.w) sides |= kBottom;
  return static_cast<std::uint16_t>(sides);
}

std::span<const ClipVertex> Clipper::clip(const ClipVertex (&triangle)[3], std::uint16_t planes,
                                          const ViewVolume& view) {
  std::size_t count = 3, cuts = 0;
  for (std::size_t i = 0; i < 3; ++i) from_[i] = triangle[i], from_[i].id = static_cast<int>(i);
  for (const auto plane : {kNear, kFar, kGuardLeft, kGuardRight, kGuardTop, kGuardBottom}) {
    if ((planes & plane) == 0) continue;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const ClipVertex &a = from_[i], &b = from_[i + 1 == count ? 0 : i + 1];
      const auto from_plane = [&](const ClipVertex& v) {
        const double d = distance(v, plane, view);
        return v.corner >= 0 ? std::max(d, 0.0) : d;
      };
      const double da = from_plane(a), db = from_plane(b);
      const bool a_inside = da >= 0.0, b_inside = db >= 0.0;
      if (a_inside) to_[kept++] = a;
      if (a_inside == b_inside) continue;
      const double t = a_inside ? da / (da - db) : db / (db - da);
      ClipVertex& added = to_[kept++] = a_inside ? cut(a, b, t) : cut(b, a, t);
      added.id = static_cast<int>(3 + cuts);
      cuts_[cuts++] = a_inside ? Cut{a.id, b.id, t} : Cut{b.id, a.id, t};
    }
    std::swap(from_, to_);
    count = kept;
    if (count == 0) break;
  }
  return {from_.data(), count};
}

std::array<double, 3> Clipper::weights(int id) const {
  if (id < 3) return weights_of_corner(id);
  const Cut& c = cuts_[static_cast<std::size_t>(id - 3)];
  std::array<double, 3> sum = weights(c.inside);
  const std::array<double, 3> outside = weights(c.outside);
  for (std::size_t k = 0; k < 3; ++k) sum[k] = (1.0 - c.t) * sum[k] + c.t * outside[k];
  return sum;
}

namespace {

// The split uses only signed areas, which are exact. However a polygon is split, the signed coverages of the
// triangles add up to its winding number at every sample. So if no triangle is negative and the polygon winds
// once, each of its samples lies in exactly one triangle.
class Splitter {
 public:
  explicit Splitter(std::span<const Vertex> polygon) : polygon_(polygon) {}

  // Splits the polygon into a fan about its first vertex. False if the fan has triangles of both windings.
  bool fan() {
    for (std::size_t i = 2; i < polygon_.size(); ++i) add(0, i - 1, i);
    return one_winding();
  }

  // Splits the polygon into triangles of one winding. False if there is no such split. A dynamic program over
  // sub-polygons: the vertices from `first` to `last`, closed by the edge between these two. A triangle on
  // this edge leaves two smaller sub-polygons (Klincsek, "Minimal triangulations of polygonal domains",
  // 1980).
  bool split(bool positive) {
    pieces_.count = 0;
    const std::size_t last = polygon_.size() - 1;
    for (std::size_t width = 2; width <= last; ++width)
      for (std::size_t first = 0; first + width <= last; ++first)
        apex_[first][first + width] = find_apex(first, first + width, positive);
    if (apex_[0][last] == 0) return false;
    collect(0, last);
    return true;
  }

  Pieces take() const { return pieces_; }

  // Twice the signed area of a triangle; without arguments, that of the polygon.
  std::int64_t area(std::size_t a, std::size_t b, std::size_t c) const {
    const auto x = [&](std::size_t i) { return std::int64_t{polygon_[i].x_q15}; };
    const auto y = [&](std::size_t i) { return std::int64_t{polygon_[i].y_q15}; };
    return (x(b) - x(a)) * (y(c) - y(a)) - (y(b) - y(a)) * (x(c) - x(a));
  }
  std::int64_t area() const {
    std::int64_t sum = 0;
    for (std::size_t i = 2; i < polygon_.size(); ++i) sum += area(0, i - 1, i);
    return sum;
  }

 private:
  // The third vertex of a triangle on the edge from `first` to `last` that has the right winding and leaves
  // sub-polygons that can be split; 0 if there is none.
  std::uint8_t find_apex(std::size_t first, std::size_t last, bool positive) const {
    const auto possible = [&](std::size_t from, std::size_t to) {
      return to - from == 1 || apex_[from][to] != 0;
    };
    for (std::size_t apex = first + 1; apex < last; ++apex) {
      const std::int64_t a = area(first, apex, last);
      if ((positive ? a >= 0 : a <= 0) && possible(first, apex) && possible(apex, last))
        return static_cast<std::uint8_t>(apex);
    }
    return 0;
  }

  void collect(std::size_t first, std::size_t last) {
    if (last - first == 1) return;
    const std::size_t apex = apex_[first][last];
    add(first, apex, last);
    collect(first, apex);
    collect(apex, last);
  }

  void add(std::size_t a, std::size_t b, std::size_t c) {
    pieces_.corners[pieces_.count++] = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b),
                                        static_cast<std::uint8_t>(c)};
  }

  bool one_winding() const {
    bool positive = false, negative = false;
    for (std::size_t i = 0; i < pieces_.count; ++i) {
      const auto& c = pieces_.corners[i];
      const std::int64_t a = area(c[0], c[1], c[2]);
      positive |= a > 0;
      negative |= a < 0;
    }
    return !(positive && negative);
  }

  std::span<const Vertex> polygon_;
  Pieces pieces_;
  std::uint8_t apex_[Clipper::kMaxVertices][Clipper::kMaxVertices] = {};
};

}  // namespace

Pieces split(std::span<const Vertex> polygon) {
  Splitter splitter(polygon);
  if (splitter.fan()) return splitter.take();
  const Pieces fan = splitter.take();
  return splitter.split(splitter.area() > 0) ? splitter.take() : fan;
}

}  // namespace edgewise
