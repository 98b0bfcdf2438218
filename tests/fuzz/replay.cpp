// Feeds files to a fuzz target: `fuzz_obj FOLDER…`, every file of each folder. A fuzzer's finds stay found
// where there is no fuzzer.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz.h"

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void feed(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::vector<char> content(std::istreambuf_iterator<char>(in), {});
  // An allocation of just this size: a sanitizer sees who reads past its end.
  const std::vector<std::uint8_t> bytes(content.begin(), content.end());
  std::fprintf(stderr, "%s\n", path.c_str());  // stays the last line if it ends the process
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

}  // namespace

int main(int argc, char** argv) try {
  std::size_t count = 0;
  for (const char* folder : std::vector<const char*>(argv + 1, argv + argc))
    for (const fs::path& file : files_in(folder)) {
      feed(file);
      ++count;
    }
  std::printf("%zu inputs\n", count);
  return count > 0 ? 0 : 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
