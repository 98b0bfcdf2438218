// A terminal's input bytes as keys, and screens as the bytes that show them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viewer/annotations.h"
#include "viewer/keys.h"

namespace edgewise::viewer {

// Removes complete keys from the front of `bytes`, and ignores other control sequences. After a pause, an
// escape character alone is the Escape key, and incomplete sequences are dropped.
std::vector<Key> take_keys(std::string& bytes, bool paused);

// Shows a screen as half-block characters: each shows two pixels, one above the other, in true colour.
class TerminalPicture {
 public:
  // Returns the bytes that change the last screen and the line below it into these. The first time and after
  // a change of size, they redraw everything.
  std::string show(const Screen& screen, std::string_view status);

 private:
  int columns_ = 0;
  std::vector<std::string> shown_;  // rows
};

}  // namespace edgewise::viewer
