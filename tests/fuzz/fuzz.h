// What the fuzz targets share. Each is a file with one LLVMFuzzerTestOneInput, the function that libFuzzer
// calls with bytes of its making; without libFuzzer, replay.cpp calls it with files. A target ends the
// process where something is wrong, since that is all that libFuzzer looks for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>

#include "edgewise/scene.h"
#include "raster/ablation.h"

// No header declares it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace edgewise::fuzz {

// Ends the process, and says why.
[[noreturn]] void fail(const std::string& what);
inline void require(bool holds, const std::string& what) {
  if (!holds) fail(what);
}

// Takes numbers off the front of an input; zeros where it has ended.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}
  bool empty() const { return rest_.empty(); }

  template <typename Number>
  Number take() {
    Number number{};
    const std::size_t n = std::min(sizeof number, rest_.size());
    if (n > 0) std::memcpy(&number, rest_.data(), n);
    rest_ = rest_.subspan(n);
    return number;
  }
  // 0 … count - 1
  int below(int count) { return take<std::uint8_t>() % count; }

 private:
  std::span<const std::uint8_t> rest_;
};

// A file in memory with these bytes, for readers that want a path.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

// How a frame lies in the caller's memory.
struct Placement {
  int width, height;  // px
  int padding;        // px from the end of a row to the next one
  int start;          // px before the first row
};

// Every backend and SIMD target draws the same picture, which is the oracle's where that is affordable, and
// writes nothing beside it. `how.execution.target` is ignored.
void check_backends(std::span<const ScreenTriangle> triangles, const Placement& placement,
                    AblatedExecution how);

// The front end makes the same triangles with every SIMD target, in the contract's ranges, and the backends
// draw them. An image of more than 64 px a side is cut off there. Nothing that was read may be refused but a
// camera that is out of range.
void check_frontend(const Drawable& drawable, int width, int height);

}  // namespace edgewise::fuzz
