// Shows a screen as half-block characters: each shows two pixels, one above the other, in true colour.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/text.h"

namespace edgewise::viewer {

inline constexpr Cell kTerminalCell{1, 2};

class TerminalPicture {
 public:
  // Returns the bytes that change the last screen into this one. The first time and after a change of size,
  // they redraw everything.
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
