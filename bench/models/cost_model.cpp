#include "bench/models/cost_model.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iterator>
#include <limits>
#include <vector>

#include "bench/models/cost_kernels.h"
#include "core/parallel.h"
#include "edgewise/contract.h"
#include "lab/cases/exact_spans.h"

namespace edgewise::bench {

using namespace contract;

BlockCounts count_blocks(std::span<const ScreenTriangle> triangles, int width, int height) {
  constexpr int kBlockLog2 = 2;
  const std::ptrdiff_t columns = (width >> kBlockLog2) + 1, rows = (height >> kBlockLog2) + 1;
  // For each block, 1 + the index of the last triangle that was counted there.
  std::vector<std::size_t> covered_by(static_cast<std::size_t>(columns * rows)), won_by = covered_by;
  std::vector<std::uint32_t> depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                   kDepthClear);
  BlockCounts counts;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Oriented oriented = orient(triangles[i]);
    if (oriented.area == 0) continue;
    const DepthPlane plane = make_depth(oriented);
    const auto count = [&](std::size_t& last, std::uint64_t& counter) {
      counter += last != i + 1;
      last = i + 1;
    };
    lab::for_each_span(triangles[i], width, height, [&](int y, int begin, int end) {
      std::uint32_t* row = depth.data() + std::ptrdiff_t{y} * width;
      std::uint32_t z = 0;
      for (int x = begin; x < end; ++x) {
        const auto block = static_cast<std::size_t>((y >> kBlockLog2) * columns + (x >> kBlockLog2));
        count(covered_by[block], counts.covered);
        z = x == begin || x % kDepthCell == 0 ? plane.at(x, y) : z + plane.zx;
        if (z >= row[x]) continue;
        row[x] = z;
        count(won_by[block], counts.won);
      }
    });
  }
  return counts;
}

namespace {

// The minimum of several timings, since disturbances only lengthen a timing.
template <typename Work>
double minimum_s(Work&& work) {
  constexpr int kMinRepetitions = 5;
  constexpr double kMinTotal_s = 0.02;
  double least = std::numeric_limits<double>::max(), spent = 0.0;
  for (int i = 0; i < kMinRepetitions || spent < kMinTotal_s; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    least = std::min(least, s);
    spent += s;
  }
  return least;
}

// Calls part(begin, end) for equal parts of [0, count) that begin at multiples of `unit`, on all threads.
template <typename Part>
void in_parts(std::size_t count, std::size_t unit, int threads, Part&& part) {
  const auto parts = static_cast<std::size_t>(4 * threads);
  const auto bound = [&](std::size_t i) { return i == parts ? count : count * i / parts / unit * unit; };
  parallel_for(threads, static_cast<int>(parts), [&](int i) {
    const auto p = static_cast<std::size_t>(i);
    part(bound(p), bound(p + 1));
  });
}

double measure_read_s(std::span<const ScreenTriangle> triangles, int threads) {
  static_assert(sizeof(ScreenTriangle) % sizeof(std::uint64_t) == 0);
  const auto* from = reinterpret_cast<const std::uint64_t*>(triangles.data());
  const std::size_t count = triangles.size_bytes() / sizeof(*from);
  std::atomic<std::uint64_t> sink;  // so that the compiler keeps the reads
  return minimum_s([&] {
    in_parts(count, 1, threads, [&](std::size_t begin, std::size_t end) {
      sink.store(read_all(from + begin, end - begin), std::memory_order_relaxed);
    });
  });
}

double measure_write_s(Framebuffer& frame, int threads) {
  const FrameView view = frame.view();
  const auto count = static_cast<std::size_t>(view.stride) * static_cast<std::size_t>(view.height);
  constexpr std::size_t kLinePixels = 16;  // a cache line's
  const auto fill = [&](bool streaming) {
    return minimum_s([&] {
      in_parts(count, kLinePixels, threads, [&](std::size_t begin, std::size_t end) {
        fill_all(view.depth + begin, end - begin, kDepthClear, streaming);
        fill_all(view.payload + begin, end - begin, 0, streaming);
      });
    });
  };
  return std::min(fill(false), fill(true));
}

double measure_tiles_s(Framebuffer& frame, int threads) {
  const FrameView view = frame.view();
  constexpr int kSide = L1Tile::kSide;
  const int columns = (view.width + kSide - 1) / kSide, rows = (view.height + kSide - 1) / kSide;
  const auto copy = [&](bool streaming) {
    return minimum_s([&] {
      in_parts(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 1, threads,
               [&](std::size_t begin, std::size_t end) {
                 L1Tile tile;
                 std::fill(std::begin(tile.payload), std::end(tile.payload), 0);
                 for (auto i = static_cast<int>(begin); i < static_cast<int>(end); ++i)
                   clear_and_copy(tile, view, i % columns * kSide, i / columns * kSide, streaming);
               });
    });
  };
  return std::min(copy(false), copy(true));
}

double measure_block_s(int threads) {
  constexpr int kRounds = 1000;
  const double s = minimum_s([&] {
    parallel_for(threads, threads, [&](int) {
      L1Tile tile{};
      for (int round = 0; round < kRounds; ++round) draw_blocks(tile, round);
    });
  });
  return s / (double{kRounds} * threads * L1Tile::kBlocks);
}

}  // namespace

FrameCost CostModel::estimate(std::span<const ScreenTriangle> triangles, const BlockCounts& blocks,
                              Framebuffer& frame, int threads) {
  double& block_s = block_s_[threads];
  if (block_s == 0.0) block_s = measure_block_s(threads);
  const auto [writing, is_new] = writing_.try_emplace({frame.width(), frame.height(), threads});
  if (is_new) writing->second = {measure_write_s(frame, threads), measure_tiles_s(frame, threads)};
  const auto [write_s, tiles_s] = writing->second;
  return {blocks, measure_read_s(triangles, threads), block_s * static_cast<double>(blocks.won), write_s,
          tiles_s};
}

}  // namespace edgewise::bench
