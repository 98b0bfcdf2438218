// A number for a message: as short as possible, and the same in every locale.
#pragma once

#include <charconv>
#include <string>

namespace edgewise {

template <typename T>
std::string number_text(T value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace edgewise
