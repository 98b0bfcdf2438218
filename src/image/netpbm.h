// Reads files of the Netpbm kind (PGM, PPM and PFM): a header of words, then samples. Sizes are checked
// before memory is allocated for them.
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

// Both throw std::runtime_error with the file's name: for a side out of range, or if `pixels` is not
// width x height.
Size checked_size(const std::filesystem::path& path, std::uint64_t width, std::uint64_t height);
void check_pixels(const std::filesystem::path& path, int width, int height, std::size_t pixels);

// Reads the words of a file's header, then its samples. Comments from # to the end of the line are skipped.
// All functions throw std::runtime_error, with the file's name, if the file is malformed, truncated or too
// long.
class Reader {
 public:
  // The file must start with one of these: "Pf or PF".
  Reader(const std::filesystem::path& path, InputFile file, std::string_view magics);

  char kind() const { return kind_; }  // the magic's second character
  std::string word();
  std::uint64_t integer(const char* noun = "size");
  Size size();

  // Of the plain kinds, samples are integers, which follow begin_plain() and must be the rest of the file.
  bool is_plain() const { return kind_ == '2' || kind_ == '3'; }
  void begin_plain(std::uint64_t samples);
  void end_plain();

  // Reads `count` samples, which must be the rest of the file. They begin one blank or CR LF after the last
  // word.
  template <typename Sample>
  std::vector<Sample> samples(std::size_t count) {
    check_rest(count * sizeof(Sample));
    std::vector<Sample> samples(count);
    read(samples.data(), count * sizeof(Sample));
    return samples;
  }

 private:
  int next();
  void skip_blanks();
  void check_rest(std::uint64_t bytes);
  void read(void* samples, std::size_t bytes);

  const std::filesystem::path& path_;
  InputFile file_;
  char kind_ = 0;
  int end_ = 0;        // the character behind the last word
  bool crlf_ = false;  // an earlier line ended in CR LF
};

}  // namespace edgewise::netpbm
