// What a terminal sends when keys are pressed and the mouse is moved: bytes → events.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "viewer/inset.h"
#include "viewer/keys.h"

namespace edgewise::viewer {

struct Pointed {
  int column, row;  // from 0
  bool held;
};
using TerminalEvent = std::variant<Key, Pointed>;

class TerminalInput {
 public:
  // What is complete; the beginning of a sequence waits for its rest.
  std::vector<TerminalEvent> feed(std::string_view bytes);
  // Nothing has come for a while: an escape that waits was the key.
  std::vector<TerminalEvent> settle();
  bool waits() const { return !pending_.empty(); }

 private:
  std::string pending_;
};

}  // namespace edgewise::viewer
