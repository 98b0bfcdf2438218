// A screen as characters: two pixels in each, one above the other, in true colour.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/text.h"

namespace edgewise::viewer {

inline constexpr Cell kTerminalCell{1, 2};

class TerminalPicture {
 public:
  // The bytes that turn what was shown last into this. All of it the first time and when the size changes.
  std::string show(const Screen& screen);

 private:
  struct Character {
    char letter;  // 0: the upper half block
    std::uint32_t foreground, background;
    bool operator==(const Character&) const = default;
  };
  int columns_ = 0;
  std::vector<Character> shown_;
};

}  // namespace edgewise::viewer
