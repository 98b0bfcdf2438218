// Control sequences as in xterm's documentation (ctlseqs): CSI and SS3 cursor keys, SGR mouse reports.
#include "viewer/terminal_input.h"

#include <charconv>
#include <optional>

namespace edgewise::viewer {

namespace {

constexpr char kEscape = '\x1b';
constexpr std::size_t kLongestSequence = 32;

std::optional<Key> cursor_key(char final) {
  switch (final) {
    case 'A':
      return Key::up;
    case 'B':
      return Key::down;
    case 'C':
      return Key::right;
    case 'D':
      return Key::left;
    default:
      return std::nullopt;
  }
}

// "<button;column;row", counted from 1.
std::optional<Pointed> mouse(std::string_view parameters, bool released) {
  int n[3];
  const char* at = parameters.data() + 1;
  const char* const end = parameters.data() + parameters.size();
  for (int i = 0; i < 3; ++i) {
    const auto [next, error] = std::from_chars(at, end, n[i]);
    if (error != std::errc{} || (i < 2 && (next == end || *next != ';'))) return std::nullopt;
    at = next + 1;
  }
  constexpr int kButtons = 3, kMotion = 32;
  const bool left = (n[0] & kButtons) == 0 && (n[0] & ~(kButtons | kMotion)) == 0;
  return Pointed{n[1] - 1, n[2] - 1, left && !released};
}

std::optional<Key> plain_key(char c) {
  if (c == '\x7f') return Key::backspace;
  if (c == '\n') return Key::enter;
  return key_of(c);
}

}  // namespace

std::vector<TerminalEvent> TerminalInput::feed(std::string_view bytes) {
  pending_ += bytes;
  std::vector<TerminalEvent> events;
  std::string_view rest = pending_;
  while (!rest.empty()) {
    if (rest[0] != kEscape) {
      if (const auto key = plain_key(rest[0])) events.emplace_back(*key);
      rest.remove_prefix(1);
      continue;
    }
    if (rest.size() < 2) break;
    if (rest[1] != '[' && rest[1] != 'O') {  // Escape and another key, or Alt and a key
      events.emplace_back(Key::escape);
      rest.remove_prefix(1);
      continue;
    }
    const std::size_t end = rest.find_first_not_of("<;0123456789", 2);
    if (end == std::string_view::npos) {
      if (rest.size() < kLongestSequence) break;
      rest = {};
      break;
    }
    const char final = rest[end];
    const std::string_view parameters = rest.substr(2, end - 2);
    if (const auto key = cursor_key(final)) events.emplace_back(*key);
    if ((final == 'M' || final == 'm') && parameters.starts_with('<'))
      if (const auto pointed = mouse(parameters, final == 'm')) events.emplace_back(*pointed);
    rest.remove_prefix(end + 1);
  }
  pending_ = std::string(rest);
  return events;
}

std::vector<TerminalEvent> TerminalInput::settle() {
  const bool escape = pending_.starts_with(kEscape);
  pending_.clear();
  if (!escape) return {};
  return {Key::escape};
}

}  // namespace edgewise::viewer
