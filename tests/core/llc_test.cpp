#include "core/llc.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "temp_dir.h"

namespace edgewise {
namespace {

// Of a folder with these files `size`, by the number of the cache.
std::size_t largest_of(const std::map<int, std::string>& sizes) {
  const TempDir folder;
  for (const auto& [index, size] : sizes) {
    const std::string cache = "index" + std::to_string(index);
    std::filesystem::create_directory(folder.path() / cache);
    folder.write(cache + "/size", size);
  }
  return largest_cache_bytes(folder.path().c_str());
}

TEST(LargestCache, IsTheLargestThatTheFolderNames) {
  EXPECT_EQ(largest_of({{0, "48K\n"}, {1, "32K\n"}, {2, "1024K\n"}, {3, "32768K\n"}}), std::size_t{32} << 20);
  EXPECT_EQ(largest_of({{0, "32K\n"}, {3, "491520K\n"}, {2, "512K\n"}}), std::size_t{480} << 20)
      << "a cache of unknown size has no file";
  EXPECT_EQ(largest_of({{0, "64K\n"}, {9, "512K"}}), std::size_t{512} << 10);
  EXPECT_EQ(largest_of({{0, "64K\n"}, {1, "32K\n"}}), std::size_t{64} << 10) << "data, then instructions";
}

TEST(LargestCache, IsZeroWhereNoSizeIsKnown) {
  EXPECT_EQ(largest_of({}), 0u);
  EXPECT_EQ(largest_of({{0, ""}, {1, "K\n"}, {2, "512\n"}, {3, "512M\n"}, {4, "99999999999K\n"}}), 0u);
  EXPECT_EQ(largest_cache_bytes("/nowhere"), 0u);
}

TEST(LastLevelCache, IsOfThisMachineOrEightMegabytes) {
  const std::size_t own = largest_cache_bytes("/sys/devices/system/cpu/cpu0/cache");
  EXPECT_EQ(llc_bytes(), own >> 20 != 0 ? own : std::size_t{8} << 20);
}

}  // namespace
}  // namespace edgewise
