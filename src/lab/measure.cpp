#include "lab/measure.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "raster/contract.h"

namespace edgewise::lab {

using namespace contract;

void poison(Framebuffer& frame) {
  const FrameView view = frame.view();
  const auto bytes =
      static_cast<std::size_t>(view.stride) * static_cast<std::size_t>(view.height) * sizeof(*view.depth);
  std::memset(view.depth, 0xA5, bytes);
  std::memset(view.payload, 0xA5, bytes);
}

FrameDifference compare(const Framebuffer& a, const Framebuffer& b) {
  if (a.width() != b.width() || a.height() != b.height())
    throw std::invalid_argument("frames of different sizes cannot be compared");
  FrameDifference result;
  const std::size_t row_bytes = static_cast<std::size_t>(a.width()) * sizeof(std::uint32_t);
  for (int y = 0; y < a.height(); ++y) {
    const std::uint32_t *da = a.depth_row(y), *db = b.depth_row(y), *pa = a.payload_row(y),
                        *pb = b.payload_row(y);
    if (std::memcmp(da, db, row_bytes) == 0 && std::memcmp(pa, pb, row_bytes) == 0) continue;
    for (int x = 0; x < a.width(); ++x) {
      if (da[x] == db[x] && pa[x] == pb[x]) continue;
      if (result.pixels++ == 0) result.first_x = x, result.first_y = y;
    }
  }
  return result;
}

std::vector<std::vector<std::uint32_t>> disjoint_groups(std::span<const ScreenTriangle> triangles, int width,
                                                        int height) {
  // Each triangle goes to the first group in which its box is still free: one past the latest group used
  // there.
  std::vector<std::uint32_t> next_group(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                        0);
  std::vector<std::vector<std::uint32_t>> groups;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const PixelBox box = pixel_box(triangles[i], width, height);
    if (box.empty()) continue;
    std::uint32_t group = 0;
    const auto row_at = [&](int y) { return next_group.begin() + std::ptrdiff_t{y} * width; };
    for (int y = box.y0; y < box.y1; ++y)
      group = std::max(group, *std::max_element(row_at(y) + box.x0, row_at(y) + box.x1));
    for (int y = box.y0; y < box.y1; ++y) std::fill(row_at(y) + box.x0, row_at(y) + box.x1, group + 1);
    if (groups.size() <= group) groups.resize(group + 1);
    groups[group].push_back(static_cast<std::uint32_t>(i));
  }
  return groups;
}

std::vector<std::uint32_t> count_hits(Backend& backend, std::span<const ScreenTriangle> triangles, int width,
                                      int height, const Execution& execution,
                                      const std::function<void(double)>& on_progress) {
  std::vector<std::uint32_t> hits(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  Framebuffer frame(width, height);
  std::vector<ScreenTriangle> members;
  const auto groups = disjoint_groups(triangles, width, height);
  std::size_t done = 0;
  for (const auto& group : groups) {
    if (on_progress) on_progress(static_cast<double>(done++) / static_cast<double>(groups.size()));
    members.clear();
    for (const std::uint32_t i : group) members.push_back(triangles[i]);
    backend.draw(members, frame.view(), 0, execution);
    for (int y = 0; y < height; ++y) {
      const std::uint32_t* depth = frame.depth_row(y);
      std::uint32_t* row = &hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
      for (int x = 0; x < width; ++x) row[x] += depth[x] != kDepthClear;
    }
  }
  return hits;
}

RowSpan covered_in_row(const Edge (&edges)[3], const PixelBox& box, int y) {
  const auto floor_div = [](std::int64_t n, std::int64_t d) { return n / d - (n % d < 0); };
  // E grows by 256 a from pixel to pixel, so each edge bounds the pixels of a row on one side.
  std::int64_t first = box.x0, end = box.x1;
  for (const Edge& edge : edges) {
    const std::int64_t at_zero = edge.at(0, y), step = std::int64_t{edge.a} * kSub;
    if (step > 0)
      first = std::max(first, -floor_div(at_zero, step));
    else if (step < 0)
      end = std::min(end, floor_div(at_zero, -step) + 1);
    else if (at_zero < 0)
      end = first;
  }
  if (end <= first) return {box.x0, box.x0};
  return {static_cast<int>(first), static_cast<int>(end)};
}

std::uint64_t covered_pixels(std::span<const ScreenTriangle> triangles, int width, int height) {
  std::uint64_t covered = 0;
  for (const auto& triangle : triangles) {
    const PixelBox box = pixel_box(triangle, width, height);
    const Oriented oriented = orient(triangle);
    if (box.empty() || oriented.area == 0) continue;
    const Edge edges[3] = {make_edge(oriented, 0), make_edge(oriented, 1), make_edge(oriented, 2)};
    for (int y = box.y0; y < box.y1; ++y) {
      const RowSpan span = covered_in_row(edges, box, y);
      covered += static_cast<std::uint64_t>(span.end - span.first);
    }
  }
  return covered;
}

}  // namespace edgewise::lab
