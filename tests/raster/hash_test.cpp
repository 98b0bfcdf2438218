// The hash of a picture is XXH3-64 of the bytes that edgewise/hash.h states. The expected values are those
// that Debian's libxxhash.so gives for these bytes.
#include "edgewise/hash.h"

#include <gtest/gtest.h>

#include <array>

namespace edgewise {
namespace {

TEST(Hash, IsXxh3OfTheStatedBytes) {
  constexpr int kStride = 5;  // px; the words beside the image do not count
  const std::array<std::uint32_t, 2 * kStride> depth{0x80,       0x81,       0x82,       7, 8,
                                                     0x7FFFFFFF, 0x7FFFFFFF, 0x90A0B0C0, 9, 10};
  const std::array<std::uint32_t, 2 * kStride> payload{0xFF010203, 0xFF040506, 0xFF070809, 11, 12,
                                                       0,          1,          0xDEADBEEF, 13, 14};
  EXPECT_EQ(hash_of({depth.data(), payload.data(), 3, 2, kStride}), 0xA320EDBD0E0323D0u);

  EXPECT_EQ(hash_of({depth.data(), nullptr, 3, 2, kStride}), 0xCC3FE9DA0A8DA77Bu) << "only depths";

  constexpr std::uint32_t kWidth = 300;
  std::array<std::uint32_t, kWidth> long_depth, long_payload;
  for (std::uint32_t i = 0; i < kWidth; ++i) long_depth[i] = i * 2654435761u, long_payload[i] = i * i;
  EXPECT_EQ(hash_of({long_depth.data(), long_payload.data(), kWidth, 1, kWidth}), 0x50F4302D47F61D38u);

  EXPECT_EQ(hash_of_all(std::array<std::uint64_t, 2>{0x0123456789ABCDEF, 1}), 0x7F0249B3E464163Au);
}

}  // namespace
}  // namespace edgewise
