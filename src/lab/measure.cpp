#include "lab/measure.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "edgewise/contract.h"
#include "lab/exact_spans.h"

namespace edgewise::lab {

using namespace contract;

namespace {

template <typename Frame>
FrameDifference difference_of(const Framebuffer& a, const Frame& b) {
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

}  // namespace

void poison(Framebuffer& frame) {
  const FrameView view = frame.view();
  const auto words = static_cast<std::size_t>(view.stride) * static_cast<std::size_t>(view.height);
  std::fill_n(view.depth, words, kCanary);
  std::fill_n(view.payload, words, kCanary);
}

FrameDifference compare(const Framebuffer& a, const Framebuffer& b) {
  return difference_of(a, b);
}

FrameDifference compare(const Framebuffer& expected, const GuardedFrame& found) {
  FrameDifference result = difference_of(expected, found);
  result.outside = found.written_outside();
  return result;
}

std::vector<std::vector<std::uint32_t>> disjoint_groups(std::span<const ScreenTriangle> triangles, int width,
                                                        int height) {
  // Each triangle goes to the lowest group above all groups already used inside its box.
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

std::uint64_t covered_pixels(std::span<const ScreenTriangle> triangles, int width, int height) {
  std::uint64_t covered = 0;
  for (const auto& triangle : triangles)
    for_each_span(triangle, width, height,
                  [&](int, int begin, int end) { covered += static_cast<std::uint64_t>(end - begin); });
  return covered;
}

}  // namespace edgewise::lab
