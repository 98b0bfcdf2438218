// What PPM and PFM share: a header of words, then samples. Every size is checked before memory is taken for
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/input_file.h"

namespace edgewise::netpbm {

struct Size {
  int width, height;  // px, 1 … contract::kMaxImageSide
  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

// Both throw std::runtime_error, naming the file: for a side out of range, and for pixels that don't fill the
// size.
Size checked_size(const std::filesystem::path& path, std::uint64_t width, std::uint64_t height);
void check_pixels(const std::filesystem::path& path, int width, int height, std::size_t pixels);

// Reads a file word by word, then its samples; comments from # to the end of the line are skipped. Throws
// std::runtime_error, naming the file.
class Reader {
 public:
  Reader(const std::filesystem::path& path, std::string_view magic);

  std::string word();
  std::uint64_t integer();
  Size size();

  // The samples follow one blank after the last word.
  template <typename Sample>
  std::vector<Sample> samples(std::size_t count) {
    check_rest(count * sizeof(Sample));
    std::vector<Sample> samples(count);
    read(samples.data(), count * sizeof(Sample));
    return samples;
  }

 private:
  void check_rest(std::uint64_t bytes);
  void read(void* samples, std::size_t bytes);

  const std::filesystem::path& path_;
  InputFile file_;
};

}  // namespace edgewise::netpbm
