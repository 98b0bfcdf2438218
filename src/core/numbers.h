// Numbers as text, whatever the process's locale.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace edgewise {

// As short as possible.
template <typename T>
std::string number_text(T value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// The number that the whole text is; none if it isn't one, or beyond T's range.
template <typename T>
std::optional<T> parsed(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// std::from_chars does not accept a leading plus.
std::string_view without_plus(std::string_view word);

// NaN if the word is not a decimal number. Infinity if it is too large for a double. About 0 if it is too
// small, but NaN where the C++ library lacks std::from_chars for doubles. Words like "inf" and "nan" may give
// infinity and NaN.
double parse_number(std::string_view word);

}  // namespace edgewise
