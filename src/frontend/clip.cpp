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
      return view.far_z - v.z;
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
ClipVertex cut(const ClipVertex& inside, const ClipVertex& outside, double inside_distance,
               double outside_distance) {
  const double t = inside_distance / (inside_distance - outside_distance);
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
  std::size_t count = 3;
  for (std::size_t i = 0; i < 3; ++i) from_[i] = triangle[i];
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
      if (a_inside != b_inside) to_[kept++] = a_inside ? cut(a, b, da, db) : cut(b, a, db, da);
    }
    std::swap(from_, to_);
    count = kept;
    if (count == 0) break;
  }
  return {from_.data(), count};
}

}  // namespace edgewise
