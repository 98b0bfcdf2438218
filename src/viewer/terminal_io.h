// A terminal's input bytes as key and mouse events, and screens as the bytes that show them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "viewer/annotations.h"
#include "viewer/keys.h"

namespace edgewise::viewer {

struct Pointed {
  int column, row;  // from 0
  bool held;
};
using TerminalEvent = std::variant<Key, Pointed>;

class TerminalInput {
 public:
  // Returns the complete events; an incomplete sequence is kept for the next call.
  std::vector<TerminalEvent> feed(std::string_view bytes);
  // To be called after a pause: a pending escape character was the Escape key.
  std::vector<TerminalEvent> settle();
  bool waits() const { return !pending_.empty(); }

 private:
  std::string pending_;
};

// Shows a screen as half-block characters: each shows two pixels, one above the other, in true colour.
class TerminalPicture {
 public:
  // Returns the bytes that change the last screen and the line below it into these. The first time and after
  // a change of size, they redraw everything.
  std::string show(const Screen& screen, std::string_view status);

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
