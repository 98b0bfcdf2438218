#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/models/cost_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "bench/models/cost_kernels.h"
#include "core/kernel_table.h"
#include "edgewise/contract.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise::bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<std::int32_t, L1Tile::kBlockPixels>;
using V = hn::Vec<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D{}));

std::uint64_t read_all(const std::uint64_t* from, std::size_t count) {
  const hn::CappedTag<std::uint64_t, 8> d;
  constexpr std::size_t kStep = hn::MaxLanes(d);
  auto even = hn::Zero(d), odd = hn::Zero(d);
  std::size_t i = 0;
  for (; i + 2 * kStep <= count; i += 2 * kStep) {
    even = hn::Add(even, hn::LoadU(d, from + i));
    odd = hn::Add(odd, hn::LoadU(d, from + i + kStep));
  }
  std::uint64_t sum = hn::GetLane(hn::SumOfLanes(d, hn::Add(even, odd)));
  for (; i < count; ++i) sum += from[i];
  return sum;
}

void fill_all(std::uint32_t* to, std::size_t count, std::uint32_t value, bool streaming) {
  const D d;
  auto* at = reinterpret_cast<std::int32_t*>(to);
  const V v = hn::Set(d, static_cast<std::int32_t>(value));
  if (streaming) {
    for (std::size_t i = 0; i < count; i += kLanes) hn::Stream(v, d, at + i);
    hwy::FlushStream();
  } else {
    for (std::size_t i = 0; i < count; i += kLanes) hn::Store(v, d, at + i);
  }
}

void draw_blocks(L1Tile& tile, std::int32_t payload) {
  const D d;
  const V new_payload = hn::Set(d, payload);
  for (int block = 0; block < L1Tile::kBlocks; ++block)
    for (int p = 0; p < L1Tile::kBlockPixels; p += kLanes) {
      const auto value = [&](int i) {
        return hn::Add(hn::Set(d, tile.at_block[i][block]), hn::Load(d, tile.in_block[i] + p));
      };
      const int at = block * L1Tile::kBlockPixels + p;
      const V outside = hn::Or(hn::Or(value(0), value(1)), value(2)), z = value(3);
      const V old_z = hn::Load(d, tile.depth + at);
      const auto wins = hn::AndNot(hn::Lt(outside, hn::Zero(d)), hn::Lt(z, old_z));
      hn::Store(hn::IfThenElse(wins, z, old_z), d, tile.depth + at);
      hn::Store(hn::IfThenElse(wins, new_payload, hn::Load(d, tile.payload + at)), d, tile.payload + at);
    }
}

void clear_and_copy(L1Tile& tile, const FrameView& frame, int x0, int y0, bool streaming) {
  const D d;
  constexpr int kSide = L1Tile::kSide;
  const int width = std::min<int>(kSide, static_cast<int>(frame.stride) - x0);
  const int height = std::min(kSide, frame.height - y0);
  const auto copy_rows = [&](const std::int32_t* from, std::uint32_t* plane, const auto& store) {
    for (int y = 0; y < height; ++y) {
      auto* const row = reinterpret_cast<std::int32_t*>(plane + (y0 + y) * frame.stride + x0);
      for (int x = 0; x < width; x += kLanes) store(hn::Load(d, from + y * kSide + x), row + x);
    }
  };
  const auto copy = [&](const auto& store) {
    copy_rows(tile.depth, frame.depth, store);
    copy_rows(tile.payload, frame.payload, store);
  };
  for (int i = 0; i < kSide * kSide; i += kLanes)
    hn::Store(hn::Set(d, static_cast<std::int32_t>(contract::kDepthClear)), d, tile.depth + i);
  if (streaming) {
    copy([&](V v, std::int32_t* at) { hn::Stream(v, d, at); });
    hwy::FlushStream();
  } else {
    copy([&](V v, std::int32_t* at) {
      __builtin_prefetch(at + kSide, 0, 2);  // the tile to the right, as `tiled` does
      hn::Store(v, d, at);
    });
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise::bench {

std::uint64_t read_all(const std::uint64_t* from, std::size_t count) {
  static const auto kernel = EDGEWISE_KERNEL(read_all, resolve(SimdTarget::best));
  return kernel(from, count);
}

void fill_all(std::uint32_t* to, std::size_t count, std::uint32_t value, bool streaming) {
  static const auto kernel = EDGEWISE_KERNEL(fill_all, resolve(SimdTarget::best));
  kernel(to, count, value, streaming);
}

void draw_blocks(L1Tile& tile, std::int32_t payload) {
  static const auto kernel = EDGEWISE_KERNEL(draw_blocks, resolve(SimdTarget::best));
  kernel(tile, payload);
}

void clear_and_copy(L1Tile& tile, const FrameView& frame, int x0, int y0, bool streaming) {
  static const auto kernel = EDGEWISE_KERNEL(clear_and_copy, resolve(SimdTarget::best));
  kernel(tile, frame, x0, y0, streaming);
}

}  // namespace edgewise::bench
#endif
