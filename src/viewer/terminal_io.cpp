#include "viewer/terminal_io.h"

#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <optional>

namespace edgewise::viewer {

// Control sequences as in xterm's documentation (ctlseqs): CSI and SS3 cursor keys, SGR mouse reports.
namespace {

constexpr char kEscape = '\x1b';
constexpr std::size_t kLongestSequence = 32;

std::optional<Key> cursor_key(char final) {
  constexpr Key kKeys[] = {Key::up, Key::down, Key::right, Key::left};
  if (final < 'A' || final > 'D') return std::nullopt;
  return kKeys[final - 'A'];
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

namespace {

constexpr std::uint32_t kBlack = rgb(0, 0, 0), kStatus = rgb(225, 225, 225);
constexpr const char* kUpperHalf = "\xe2\x96\x80";

void append_colour(std::string& out, int ground, std::uint32_t colour) {
  fmt::format_to(std::back_inserter(out), "\x1b[{};2;{};{};{}m", ground, colour & 255, colour >> 8 & 255,
                 colour >> 16 & 255);
}

}  // namespace

std::string TerminalPicture::show(const Screen& screen, std::string_view status) {
  const Image& image = screen.picture;
  const int columns = image.width, rows = (image.height + 1) / 2;
  std::vector<Character> now;
  now.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows + 1));
  const auto pixel = [&](int x, int y) {
    if (y >= image.height) return kBlack;
    return image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(x)];
  };
  for (int row = 0; row < rows; ++row)
    for (int x = 0; x < columns; ++x) {
      const std::uint32_t upper = pixel(x, 2 * row), lower = pixel(x, 2 * row + 1);
      // A space is shorter if both pixels have the same colour.
      now.push_back(upper == lower ? Character{' ', lower, lower} : Character{0, upper, lower});
    }
  for (const Label& label : screen.labels) {
    const int row = label.y / 2;
    for (std::size_t i = 0; i < label.words.size(); ++i) {
      const int x = label.x - static_cast<int>(label.words.size()) / 2 + static_cast<int>(i);
      if (x < 0 || x >= columns) continue;
      Character& c = now[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                         static_cast<std::size_t>(x)];
      c = {label.words[i], label.colour, kBlack};
    }
  }
  for (std::size_t x = 0; x < static_cast<std::size_t>(columns); ++x) {
    const char letter = x < status.size() ? status[x] : ' ';
    now.push_back({letter >= ' ' && letter <= '~' ? letter : '?', kStatus, kBlack});
  }

  const bool all = columns != columns_ || now.size() != shown_.size();
  std::string out = all ? "\x1b[0m\x1b[2J" : "";
  std::optional<std::uint32_t> foreground, background;
  std::size_t cursor = now.size();  // nowhere
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Character& c = now[i];
    if (!all && c == shown_[i]) continue;
    const auto width = static_cast<std::size_t>(columns);
    if (cursor != i || i % width == 0)
      fmt::format_to(std::back_inserter(out), "\x1b[{};{}H", i / width + 1, i % width + 1);
    if (c.letter != ' ' && foreground != c.foreground) {
      append_colour(out, 38, c.foreground);
      foreground = c.foreground;
    }
    if (background != c.background) {
      append_colour(out, 48, c.background);
      background = c.background;
    }
    if (c.letter == 0)
      out += kUpperHalf;
    else
      out += c.letter;
    cursor = i + 1;
  }
  shown_ = std::move(now);
  columns_ = columns;
  return out;
}

}  // namespace edgewise::viewer
