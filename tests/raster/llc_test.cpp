#include "raster/llc.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "temp_dir.h"

namespace edgewise {
namespace {

TEST(LargestCache, IsTheLargestThatTheFolderNames) {
  const struct {
    std::map<int, std::string> sizes;  // the files `size`, by the number of the cache
    std::size_t kib;                   // 0: none is known
  } cases[] = {{{{0, "48K\n"}, {1, "32K\n"}, {2, "1024K\n"}, {3, "32768K\n"}}, 32768},
               {{{0, "32K\n"}, {3, "491520K\n"}, {2, "512K\n"}}, 491520},  // one of unknown size
               {{{0, "64K\n"}, {9, "512K"}}, 512},
               {{}, 0},
               {{{0, ""}, {1, "K\n"}, {2, "512\n"}, {3, "512M\n"}, {4, "99999999999K\n"}}, 0}};
  for (const auto& [sizes, kib] : cases) {
    const TempDir folder;
    for (const auto& [index, size] : sizes) {
      const std::string cache = "index" + std::to_string(index);
      std::filesystem::create_directory(folder.path() / cache);
      folder.write(cache + "/size", size);
    }
    EXPECT_EQ(largest_cache_bytes(folder.path().string()), kib << 10);
  }
}

TEST(LastLevelCache, IsOfThisMachineOrEightMegabytes) {
  const std::size_t own = largest_cache_bytes("/sys/devices/system/cpu/cpu0/cache");
  EXPECT_EQ(llc_bytes(), own >> 20 != 0 ? own : std::size_t{48} << 20);
}

}  // namespace
}  // namespace edgewise
