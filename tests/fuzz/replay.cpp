// Runs a fuzz target on files: `fuzz_obj FOLDER…` takes every file of each folder. So inputs that a fuzzer
// found are tested without a fuzzer, too.
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
  // An allocation of exactly this size, so that a sanitizer detects reads past its end.
  const std::vector<std::uint8_t> bytes(content.begin(), content.end());
  std::fprintf(stderr, "%s\n", path.c_str());  // the last line if the target aborts
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
