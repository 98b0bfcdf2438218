// Draws any bytes as triangles, in any frame layout and configuration: all backends write the same bits, and
// none outside the frame. The bytes select how each vertex is made, so that vertices on samples, shared
// vertices, far vertices and equal depths are as likely as any others.
#include <algorithm>
#include <vector>

#include "edgewise/contract.h"
#include "fuzz.h"

using namespace edgewise;
using namespace edgewise::contract;

namespace {

struct Vertex {
  std::int32_t x, y;  // 1/256 px
  std::uint32_t z;
};

std::int32_t into_guard_band(std::int64_t sub) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(sub, -kGuardSub, kGuardSub));
}

Vertex place(fuzz::Bytes& bytes, int way, const std::vector<Vertex>& before) {
  const auto pair = [&](auto sub) {
    const std::int32_t x = sub(), y = sub();
    return Vertex{x, y, 0};
  };
  switch (way) {
    case 0:  // anywhere
      return pair([&] { return into_guard_band(bytes.take<std::int32_t>()); });
    case 1:  // within 128 px
      return pair([&] { return std::int32_t{bytes.take<std::int16_t>()}; });
    case 2:  // on a sample
      return pair([&] { return sample_sub(bytes.take<std::int8_t>()); });
    case 3:  // on a pixel's corner
      return pair([&] { return bytes.take<std::int8_t>() * kSub; });
    case 4:  // at the guard band
      return pair([&] {
        const std::int32_t inwards = bytes.take<std::uint8_t>();
        return inwards % 2 == 0 ? kGuardSub - inwards / 2 : inwards / 2 - kGuardSub;
      });
    default:  // at, or near, an earlier vertex
      if (before.empty()) return {};
      const Vertex& old = before[bytes.take<std::uint8_t>() % before.size()];
      if (way == 5) return old;
      return {into_guard_band(std::int64_t{old.x} + bytes.take<std::int8_t>()),
              into_guard_band(std::int64_t{old.y} + bytes.take<std::int8_t>()), old.z};
  }
}

std::uint32_t depth(fuzz::Bytes& bytes, int way, std::uint32_t before) {
  switch (way) {
    case 0:
      return kDepthHead + bytes.take<std::uint32_t>() % (kDepthRange + 1);
    case 1:
      return kDepthHead + (bytes.take<std::uint8_t>() % 2) * kDepthRange;
    case 2:
      return kDepthHead + kDepthRange / 2 + bytes.take<std::uint8_t>();
    default:
      return before;
  }
}

std::vector<ScreenTriangle> take_triangles(fuzz::Bytes& bytes) {
  std::vector<ScreenTriangle> triangles;
  std::vector<Vertex> vertices;
  std::uint32_t z = kDepthHead;
  while (!bytes.empty()) {
    ScreenTriangle t{};
    for (int i = 0; i < 3; ++i) {
      const int way = bytes.below(32);
      Vertex v = place(bytes, std::min(way % 8, 6), vertices);
      v.z = z = depth(bytes, way / 8, z);
      vertices.push_back(v);
      t.x_sub[i] = v.x, t.y_sub[i] = v.y, t.z[i] = v.z;
    }
    triangles.push_back(t);
  }
  return triangles;
}

// Repeats the triangles within a work budget: some code paths of the backends need many triangles.
void repeat(std::vector<ScreenTriangle>& triangles, int times, int pixels) {
  constexpr std::size_t kWork = 100'000;  // pixels times triangles
  const std::size_t once = triangles.size();
  if (once == 0) return;
  const std::size_t most = std::max(once, kWork / static_cast<std::size_t>(pixels));
  const std::size_t all = std::min(once * static_cast<std::size_t>(times), most);
  triangles.reserve(all);
  while (triangles.size() < all) triangles.push_back(triangles[triangles.size() - once]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const fuzz::Placement placement{1 + bytes.below(140), 1 + bytes.below(80), bytes.below(20),
                                  bytes.below(20)};
  AblatedExecution how;
  how.execution.threads = std::max(1, bytes.below(8) - 4);  // mostly 1, which is faster here
  how.execution.tile_size = 16 << bytes.below(3);
  const int ablation = bytes.below(static_cast<int>(kAblations.size()) + 1);
  if (ablation > 0) how.ablation = kAblations[static_cast<std::size_t>(ablation - 1)];
  const int times = 1 << bytes.below(12);

  std::vector<ScreenTriangle> triangles = take_triangles(bytes);
  repeat(triangles, times, placement.width * placement.height);
  for (std::uint32_t id = 0; ScreenTriangle & t : triangles) t.payload = id++;
  fuzz::check_backends(triangles, placement, how);
  return 0;
}
