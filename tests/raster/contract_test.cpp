// Compares the contract's arithmetic with exact 128-bit arithmetic.
#include "edgewise/contract.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "support.h"

namespace edgewise {
namespace {

using namespace contract;

std::uint64_t exact_gradient(std::int64_t n, std::int64_t area) {
  const int128 wide = static_cast<int128>(n) * (std::int64_t{1} << kPlaneBits);
  return static_cast<std::uint64_t>(wide / area - (wide % area < 0));
}

TEST(Contract, GradientIsTheExactFloor) {
  const auto expect_exact = [](std::int64_t n, std::int64_t area) {
    ASSERT_EQ(gradient(n, area), exact_gradient(n, area)) << n << " / " << area;
  };
  Random random(1);
  const auto below_2_to = [&](std::uint64_t bits) {
    return static_cast<std::int64_t>(random.below(std::uint64_t{1} << bits));
  };
  for (int i = 0; i < 2'000'000; ++i) {
    const std::int64_t n = below_2_to(random.below(62));
    expect_exact(random.below(2) ? n : -n, 1 + below_2_to(random.below(60)));
  }
  for (const int shift : {0, 1, 20, 26, 27, 28, 29, 45, 46, 59, 60})
    for (const std::int64_t wobble : {-2, -1, 0, 1, 2})
      for (const std::int64_t n : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, std::int64_t{1} << 61,
                                   -(std::int64_t{1} << 61), (std::int64_t{1} << 53) + 1})
        expect_exact(n, std::max<std::int64_t>(1, (std::int64_t{1} << shift) + wobble));
}

// The depth at every covered sample is within kDepthError of the exact plane, and inside the head-room.
// Returns the number of samples.
int expect_depth_error_bounded(const ScreenTriangle& triangle, int size) {
  const Oriented t = orient(triangle);
  if (t.area == 0) return 0;
  const PixelBox box = pixel_box(triangle, size, size);
  const Edge edges[3] = {make_edge(t, 0), make_edge(t, 1), make_edge(t, 2)};
  const DepthPlane plane = make_depth(t);
  int samples = 0;
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x) {
      if (edges[0].at(x, y) < 0 || edges[1].at(x, y) < 0 || edges[2].at(x, y) < 0) continue;
      // area * z by barycentric weights, which are the unbiased edge values opposite each vertex.
      int128 weighted = 0;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const int128 weight = static_cast<int128>(t.x[j] - t.x[i]) * (sample_q15(y) - t.y[i]) -
                              static_cast<int128>(t.y[j] - t.y[i]) * (sample_q15(x) - t.x[i]);
        weighted += weight * t.z[k];
      }
      const std::uint32_t z = plane.at(x, y);
      const int128 error = static_cast<int128>(z) * t.area - weighted,
                   most = static_cast<int128>(kDepthError) * t.area;
      EXPECT_TRUE(-most <= error && error <= most && z < kDepthClear) << "at " << x << ", " << y;
      ++samples;
    }
  return samples;
}

TEST(Contract, DepthStaysWithinItsStatedError) {
  constexpr int kSize = 150;
  int samples = 0;
  for (const auto family : testing::kFamilies)
    for (const auto& t : testing::adversarial(family, 150, kSize, kSize, 7))
      samples += expect_depth_error_bounded(t, kSize);
  Random random(3);
  for (auto t : testing::adversarial("steep", 3000, 64, 64, 10)) {  // far from the origin
    const std::int32_t dx = testing::between(random, 0, 16200) * kPixel_q15,
                       dy = testing::between(random, 0, 16200) * kPixel_q15;
    for (int i = 0; i < 3; ++i) t.x_q15[i] += dx, t.y_q15[i] += dy;
    samples += expect_depth_error_bounded(t, kMaxImageSide);
  }
  EXPECT_GT(samples, 10'000);
}

}  // namespace
}  // namespace edgewise
