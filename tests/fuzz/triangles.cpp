// Draws hard triangles, made from any bytes instead of random numbers, in any frame layout and configuration:
// all backends write the same bits, and none outside the frame.
#include <algorithm>
#include <vector>

#include "fuzz.h"
#include "lab/cases/hard_triangles.h"

using namespace edgewise;

namespace {

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
  const int width = 1 + bytes.below(140), height = 1 + bytes.below(80), padding = bytes.below(20);
  const lab::GuardedFrame::Layout layout{padding, bytes.below(16)};
  lab::DrawOptions how;
  how.execution.threads = std::max(1, bytes.below(8) - 4);  // mostly 1, which is faster here
  how.execution.tile_size = 16 << bytes.below(3);
  const int tiles = bytes.below(static_cast<int>(lab::kTileOptions.size()) + 1);
  if (tiles > 0) how.tiles = lab::kTileOptions[static_cast<std::size_t>(tiles - 1)];
  const int times = 1 << bytes.below(12);

  const auto families = lab::triangle_families();
  const auto family = families[static_cast<std::size_t>(bytes.below(static_cast<int>(families.size())))];
  const int count = 1 + bytes.below(200);
  auto triangles = lab::adversarial(family, count, width, height, [&](std::uint64_t end) -> std::uint64_t {
    const bool fits_8 = end <= 1u << 8, fits_16 = end <= 1u << 16;
    return (fits_8    ? bytes.take<std::uint8_t>()
            : fits_16 ? bytes.take<std::uint16_t>()
                      : bytes.take<std::uint32_t>()) %
           end;
  });
  repeat(triangles, times, width * height);
  for (std::uint32_t id = 0; ScreenTriangle & t : triangles) t.payload = id++;
  fuzz::check_backends(triangles, width, height, layout, how);
  return 0;
}
