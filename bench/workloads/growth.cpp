#include "bench/workloads/growth.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>

#include "edgewise/contract.h"

namespace edgewise::bench {

namespace {

// Small, so that the triangles dominate the cost. 10^7 of them cover each pixel of the full image 48 times.
constexpr double kCountArea_px = 10;
// Large, so that the pixels dominate the cost.
constexpr double kOverdrawArea_px = 1000;
// The same picture at every size: its triangles grow with the image.
constexpr const char* kSizeScene = "torus-knot";

std::uint64_t memory_bytes() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

bool two_frames_fit(std::uint64_t side) {
  constexpr std::uint64_t kPixelBytes = 8;
  return 2 * kPixelBytes * side * side <= memory_bytes() / 2;
}

std::shared_ptr<Workload> random_triangles(int width, int height, std::size_t count, double area_px) {
  return std::make_shared<Workload>(width, height, Cull::none,
                                    [=] { return random_source(width, height, count, area_px); });
}

std::shared_ptr<Workload> scene_of_side(int side) {
  SceneRequest request;
  request.width = request.height = side;
  return std::make_shared<Workload>(side, side, Cull::back,
                                    [request] { return tools::load_source(kSizeScene, request, false); });
}

}  // namespace

tools::Source random_source(int width, int height, std::size_t count, double area_px) {
  SceneRequest request;
  request.width = width;
  request.height = height;
  return {"random", random_stream(request, count, area_px, 0.0, 1), true};
}

std::vector<GrowthStep> growth_steps(int width, int height) {
  std::vector<GrowthStep> steps;
  for (std::size_t count = 100; count <= 10'000'000; count *= 10)
    steps.push_back({fmt::format("count:{}", count), random_triangles(width, height, count, kCountArea_px)});
  for (int side = 256; side <= contract::kMaxImageSide; side *= 2)
    if (two_frames_fit(static_cast<std::uint64_t>(side)))
      steps.push_back({fmt::format("{}/size:{}x{}", kSizeScene, side, side), scene_of_side(side)});
  for (double overdraw = 0.25; overdraw <= 256.0; overdraw *= 4) {
    const double count = overdraw * width * height / kOverdrawArea_px;
    steps.push_back(
        {fmt::format("overdraw:{:g}", overdraw),
         random_triangles(width, height, static_cast<std::size_t>(std::max(1.0, std::round(count))),
                          kOverdrawArea_px)});
  }
  return steps;
}

}  // namespace edgewise::bench
