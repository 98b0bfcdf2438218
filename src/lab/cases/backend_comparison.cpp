#include "lab/cases/backend_comparison.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "edgewise/contract.h"
#include "lab/cases/exact_spans.h"

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

std::string describe(const TileOptions& options) {
  std::string text;
  const auto add = [&](bool differs, const char* what) {
    if (differs) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(!options.coverage_masks, "no coverage masks");
  add(!options.hierarchical_depth, "no hierarchical depth");
  add(options.tile_store == TileStore::cached, "cached stores");
  add(options.tile_store == TileStore::streaming, "streaming stores");
  return text;
}

std::unique_ptr<Backend> make(const BackendInfo& info, const TileOptions& options) {
  return info.name == "tiled" ? make_tiled(options) : info.make();
}

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

std::vector<std::vector<std::uint32_t>> disjoint_sets(std::span<const ScreenTriangle> triangles, int width,
                                                      int height) {
  // Each triangle goes to the first set that is free in its whole box. A pixel's bits say which sets of a
  // pass use it; triangles that find no free set wait for the next pass.
  constexpr std::size_t kSetsPerPass = 64;
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  std::vector<std::uint64_t> used;
  std::vector<std::vector<std::uint32_t>> sets;
  std::vector<std::uint32_t> pending(triangles.size()), later;
  std::iota(pending.begin(), pending.end(), 0u);
  for (std::size_t first = 0; !pending.empty(); first += kSetsPerPass) {
    used.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    later.clear();
    for (const std::uint32_t i : pending) {
      const PixelBox box = pixel_box(triangles[i], width, height);
      if (box.empty()) continue;
      const auto row_at = [&](int y) { return used.begin() + std::ptrdiff_t{y} * width; };
      std::uint64_t taken = 0;
      for (int y = box.y0; y < box.y1 && taken != kAll; ++y)
        taken = std::reduce(row_at(y) + box.x0, row_at(y) + box.x1, taken, std::bit_or{});
      if (taken == kAll) {
        later.push_back(i);
        continue;
      }
      const auto slot = static_cast<std::size_t>(std::countr_one(taken));
      for (int y = box.y0; y < box.y1; ++y)
        for (auto p = row_at(y) + box.x0; p != row_at(y) + box.x1; ++p) *p |= std::uint64_t{1} << slot;
      if (sets.size() <= first + slot) sets.resize(first + slot + 1);
      sets[first + slot].push_back(i);
    }
    pending.swap(later);
  }
  return sets;
}

std::vector<std::uint32_t> count_hits(Backend& backend, std::span<const ScreenTriangle> triangles, int width,
                                      int height, const Execution& execution,
                                      const std::function<void(double)>& on_progress) {
  std::vector<std::uint32_t> hits(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  Framebuffer frame(width, height);
  std::vector<ScreenTriangle> drawn;
  const auto sets = disjoint_sets(triangles, width, height);
  std::size_t done = 0;
  for (const auto& set : sets) {
    if (on_progress) on_progress(static_cast<double>(done++) / static_cast<double>(sets.size()));
    drawn.clear();
    for (const std::uint32_t i : set) drawn.push_back(triangles[i]);
    backend.draw(drawn, frame.view(), {0}, execution);
    for (int y = 0; y < height; ++y) {
      const std::uint32_t* depth = frame.depth_row(y);
      std::uint32_t* row = &hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
      for (int x = 0; x < width; ++x) row[x] += depth[x] != kDepthClear;
    }
  }
  return hits;
}

std::vector<std::uint32_t> payloads_of(const Framebuffer& frame) {
  std::vector<std::uint32_t> payloads;
  payloads.reserve(static_cast<std::size_t>(frame.width()) * static_cast<std::size_t>(frame.height()));
  for (int y = 0; y < frame.height(); ++y)
    payloads.insert(payloads.end(), frame.payload_row(y), frame.payload_row(y) + frame.width());
  return payloads;
}

std::uint64_t covered_pixels(std::span<const ScreenTriangle> triangles, int width, int height) {
  std::uint64_t covered = 0;
  for (const auto& triangle : triangles)
    for_each_span(triangle, width, height,
                  [&](int, int begin, int end) { covered += static_cast<std::uint64_t>(end - begin); });
  return covered;
}

}  // namespace edgewise::lab
