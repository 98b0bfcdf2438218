// Parses a terminal's input bytes into key and mouse events.
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
  // Returns the complete events; an incomplete sequence is kept for the next call.
  std::vector<TerminalEvent> feed(std::string_view bytes);
  // To be called after a pause: a pending escape character was the Escape key.
  std::vector<TerminalEvent> settle();
  bool waits() const { return !pending_.empty(); }

 private:
  std::string pending_;
};

}  // namespace edgewise::viewer
