#include "edgewise/visible.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/finite.h"
#include "core/float_state.h"
#include "edgewise/contract.h"
#include "edgewise/limits.h"
#include "frontend/fixed.h"
#include "frontend/triangle_ids.h"
#include "frontend/view.h"
#include "queries/checks.h"

namespace edgewise {

namespace {

// Calls visit(id, pixels) for consecutive pixels of a row that have the same id.
template <typename Visit>
void for_each_run(const ConstFrameView& ids, Visit&& visit) {
  check(ids, true);
  for (int y = 0; y < ids.height; ++y) {
    const std::uint32_t *depth = ids.depth + y * ids.stride, *id = ids.payload + y * ids.stride;
    for (int x = 0; x < ids.width;) {
      const int begin = x++;
      if (depth[begin] == contract::kDepthClear) continue;
      while (x < ids.width && depth[x] != contract::kDepthClear && id[x] == id[begin]) ++x;
      visit(id[begin], static_cast<std::uint32_t>(x - begin));
    }
  }
}

void throw_if_missing(std::uint32_t id, std::size_t triangles) {
  if (id >= triangles)
    throw std::invalid_argument("a pixel has id " + std::to_string(id) + " of " + std::to_string(triangles) +
                                " triangles");
}

// Calls visit(instance, pixels) as for_each_run() does.
template <typename Visit>
void for_each_run_of_instance(const ConstFrameView& ids, const Scene& scene, Visit&& visit) {
  const std::vector<std::size_t> first = first_ids(scene);
  for_each_run(ids, [&](std::uint32_t id, std::uint32_t pixels) {
    throw_if_missing(id, first.back());
    visit(instance_of(first, id), pixels);
  });
}

}  // namespace

std::vector<std::uint32_t> visible_triangles(const ConstFrameView& ids) {
  std::vector<std::uint64_t> seen;  // one bit per id
  for_each_run(ids, [&](std::uint32_t id, std::uint32_t) {
    throw_if_missing(id, kMaxTriangles);
    if (id / 64 >= seen.size()) seen.resize(id / 64 + 1);
    seen[id / 64] |= std::uint64_t{1} << id % 64;
  });
  std::vector<std::uint32_t> triangles;
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::uint64_t left = seen[i]; left != 0; left &= left - 1)
      triangles.push_back(static_cast<std::uint32_t>(64 * i) +
                          static_cast<std::uint32_t>(std::countr_zero(left)));
  return triangles;
}

std::vector<std::uint32_t> pixels_per_triangle(const ConstFrameView& ids, std::size_t triangles) {
  check(ids, true);
  std::vector<std::uint32_t> counts(triangles);
  for_each_run(ids, [&](std::uint32_t id, std::uint32_t pixels) {
    throw_if_missing(id, triangles);
    counts[id] += pixels;
  });
  return counts;
}

std::vector<std::size_t> first_ids(const Scene& scene) {
  std::vector<std::size_t> first;
  number_triangles(scene, first);
  return first;
}

std::map<std::string, std::vector<std::uint32_t>> objects(const Scene& scene) {
  const std::vector<std::size_t> first = first_ids(scene);
  (void)checked_count(first.back());
  std::size_t total = 0;  // of their parts
  for (const Instance& instance : scene.instances)
    for (const MeshPart& part : mesh_of(scene, instance).parts) total += part.count;
  if (total > kMaxTriangles)
    throw std::invalid_argument("parts of " + std::to_string(total) + " triangles together are more than " +
                                std::to_string(kMaxTriangles));
  std::map<std::string, std::vector<std::uint32_t>> objects;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = mesh_of(scene, scene.instances[i]);
    for (const MeshPart& part : mesh.parts) {
      check_part(mesh, part);
      auto& ids = objects[part.name];
      ids.resize(ids.size() + part.count);
      std::iota(ids.end() - static_cast<std::ptrdiff_t>(part.count), ids.end(),
                static_cast<std::uint32_t>(first[i] + part.first));
    }
  }
  for (auto& [name, ids] : objects) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }
  return objects;
}

std::vector<std::uint32_t> pixels_per_instance(const ConstFrameView& ids, const Scene& scene) {
  std::vector<std::uint32_t> counts(scene.instances.size());
  for_each_run_of_instance(ids, scene,
                           [&](std::size_t instance, std::uint32_t pixels) { counts[instance] += pixels; });
  return counts;
}

std::vector<std::uint32_t> pixels_per_mesh(const ConstFrameView& ids, const Scene& scene) {
  std::vector<std::uint32_t> counts(scene.meshes.size());
  for_each_run_of_instance(ids, scene, [&](std::size_t instance, std::uint32_t pixels) {
    counts[scene.instances[instance].mesh] += pixels;
  });
  return counts;
}

// The largest errors of rule 10 are convex functions of a point, or quotients of one by w. So in the box,
// they are largest at a corner, as are x, y, z / w and w.
bool visible(const Bounds& box, const Scene& scene, const ConstFrameView& depth) {
  const DefaultFloatState state;
  check(depth, false);
  const View view(scene, depth.width, depth.height);
  if (box.low.x > box.high.x || box.low.y > box.high.y || box.low.z > box.high.z) return false;
  if (!is_finite(box.low) || !is_finite(box.high)) return true;

  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kError = contract::kPositionError;
  const auto row_length = [&](int r) {
    return glm::length(glm::dvec3(view.pixels[0][r], view.pixels[1][r], view.pixels[2][r]));
  };
  const double w_length = row_length(2), z_length = view.has_z ? glm::length(glm::dvec3(view.z)) : w_length;
  double least_w = kInfinity, least01 = kInfinity;                  // least01: z / w, if z is not w
  double least_past_near = kInfinity, most_past_near = -kInfinity;  // z - near
  double most_before_far = -kInfinity;                              // far - z
  double most_off = 0.0;                                            // of all corners; see below
  glm::dvec2 low(kInfinity), high(-kInfinity);                      // px
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
                            (i & 4) != 0 ? box.high.z : box.low.z);
    const glm::dvec3 offset = corner - view.origin, v = view.pixels * offset + view.at_origin;
    // How far a vertex may be from where it is drawn. The point that is subtracted may lie anywhere on the
    // axis. The second term is that of positions in double, as in a box of bounds_of().
    const double off = kError * std::max(glm::length(offset), glm::length(offset - view.axis)) +
                       0x1p-50 * (glm::length(corner) + glm::length(view.origin));
    const double w = v.z, z = view.has_z ? glm::dot(view.z, glm::dvec4(offset, 1.0)) : w;
    const double w_error = w_length * off + kError * std::abs(view.at_origin.z),
                 z_error = z_length * off + kError * std::abs(view.z.w);
    const double past_near = z - view.volume.near_z,
                 before_far = view.volume.far_z + view.volume.far_w * w - z;
    least_w = std::min(least_w, w - w_error);
    least01 = std::min(least01, (z - (z_length + w_length) * off) / w);
    least_past_near = std::min(least_past_near, past_near - z_error);
    most_past_near = std::max(most_past_near, past_near + z_error);
    most_before_far = std::max(most_before_far, before_far + z_error + view.volume.far_w * w_error);
    most_off = std::max(most_off, off);
    low = glm::min(low, glm::dvec2(v) / w), high = glm::max(high, glm::dvec2(v) / w);
  }
  if (!std::isfinite(most_off)) return true;
  if (most_past_near < 0.0 || most_before_far < 0.0) return false;
  if (!(least_past_near >= 0.0 && least_w > 0.0)) return true;

  // No vertex is drawn farther away from its exact position than `margin`. Its last terms cover snapping to
  // the fewest subpixel bits, and new vertices.
  const double most_px =
      std::min(std::max({-low.x, -low.y, high.x, high.y, 0.0}), double{contract::kMaxImageSide});
  const double margin = (std::max(row_length(0), row_length(1)) + most_px * w_length) * most_off / least_w +
                        (view.has_z ? kError * std::max(depth.width, depth.height) : 0.0) + 0x1p-5 + 0x1p-6;
  // The pixels whose samples lie in low - margin … high + margin.
  const auto first = [&](double px, int side) {
    return static_cast<int>(std::ceil(std::clamp(px - margin - 0.5, 0.0, double(side))));
  };
  const auto end = [&](double px, int side) {
    return static_cast<int>(std::floor(std::clamp(px + margin + 0.5, 0.0, double(side))));
  };
  const int x0 = first(low.x, depth.width), x1 = end(high.x, depth.width);
  // No pixel is nearer: interpolation errs by less than kDepthError, and three roundings by less than two
  // units.
  const std::uint32_t nearest =
      view.has_z ? round_depth(least01 * contract::kDepthRange) : view.depth.units(least_w);
  const std::uint32_t least = nearest - contract::kDepthError - 2;
  for (int y = first(low.y, depth.height); y < end(high.y, depth.height); ++y) {
    const std::uint32_t* row = depth.depth + y * depth.stride;
    if (std::any_of(row + x0, row + std::max(x0, x1), [&](std::uint32_t z) { return z > least; }))
      return true;
  }
  return false;
}

}  // namespace edgewise
