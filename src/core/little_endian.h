// Files have little-endian numbers, whatever the machine's byte order.
#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <vector>

namespace edgewise {

// From a number whose bytes in memory are in little endian, and back.
template <std::unsigned_integral T>
constexpr T little_endian(T number) {
  static_assert(sizeof number <= 8);
  if constexpr (std::endian::native == std::endian::little)
    return number;
  else
    return static_cast<T>(__builtin_bswap64(number) >> (64 - 8 * sizeof(T)));
}

// Converts words of so many bytes, integers or floats, from this byte order to the machine's, and back.
inline void convert_words(std::span<std::byte> words, std::endian order, std::ptrdiff_t bytes = 4) {
  if (order == std::endian::native) return;
  for (auto word = words.begin(); word != words.end(); word += bytes) std::reverse(word, word + bytes);
}

// Writes words of so many bytes, integers or floats, in little endian.
inline void write_words(std::ostream& out, std::span<const std::byte> words, std::ptrdiff_t bytes = 4) {
  std::vector<std::byte> converted;
  if constexpr (std::endian::native != std::endian::little) {
    converted.assign(words.begin(), words.end());
    convert_words(converted, std::endian::little, bytes);
    words = converted;
  }
  out.write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(words.size()));
}

}  // namespace edgewise
