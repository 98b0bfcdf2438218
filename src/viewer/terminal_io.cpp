#include "viewer/terminal_io.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace edgewise::viewer {

namespace {

Key plain_key(char c) {
  if (c == '\x7f') return Key::backspace;
  return c == '\n' ? Key::enter : key_of(c);
}

constexpr std::uint32_t kBlack = rgb(0, 0, 0), kStatus = rgb(225, 225, 225);

void append_colour(std::string& out, int ground, std::uint32_t colour) {
  out += fmt::format("\x1b[{};2;{};{};{}m", ground, colour & 255, colour >> 8 & 255, colour >> 16 & 255);
}

// Two rows of pixels, from row y on.
std::string row_of(const Screen& screen, int y) {
  struct Character {
    char letter;  // 0: the upper half block
    std::uint32_t foreground, background;
  };
  const Image& image = screen.picture;
  const auto* const upper = image.pixels.data() + std::ptrdiff_t{y} * image.width;
  std::vector<Character> row;
  for (int x = 0; x < image.width; ++x) {
    const std::uint32_t lower = y + 1 < image.height ? upper[x + image.width] : kBlack;
    row.push_back({upper[x] == lower ? ' ' : '\0', upper[x], lower});
  }
  for (const Label& label : screen.labels) {
    auto x = static_cast<std::size_t>(label.x) - label.words.size() / 2;  // left of the border, it is huge
    for (const char letter : label.words) {
      if (label.y / 2 == y / 2 && x < row.size()) row[x] = {letter, label.colour, kBlack};
      ++x;
    }
  }
  std::string out;
  std::optional<std::uint32_t> foreground, background;
  for (const Character& c : row) {
    if (c.letter != ' ' && foreground != c.foreground) append_colour(out, 38, c.foreground);
    if (c.letter != ' ') foreground = c.foreground;
    if (background != c.background) append_colour(out, 48, c.background);
    background = c.background;
    out += c.letter == 0 ? "\u2580" : std::string(1, c.letter);
  }
  return out;
}

}  // namespace

// Control sequences as in xterm's documentation (ctlseqs): CSI and SS3 cursor keys.
std::vector<Key> take_keys(std::string& bytes, bool paused) {
  constexpr Key kCursor[] = {Key::up, Key::down, Key::right, Key::left};
  std::vector<Key> keys;
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const bool escaped = rest[0] == '\x1b';
    if (escaped && rest.size() == 1 && !paused) break;
    // A plain key, Escape, or Alt and a key.
    if (!escaped || rest.size() == 1 || (rest[1] != '[' && rest[1] != 'O')) {
      keys.push_back(plain_key(rest[0]));
      rest.remove_prefix(1);
      continue;
    }
    const std::size_t end = rest.find_first_not_of(";0123456789", 2);
    if (end == std::string_view::npos) {
      if (paused) rest = {};
      break;
    }
    if (rest[end] >= 'A' && rest[end] <= 'D') keys.push_back(kCursor[rest[end] - 'A']);
    rest.remove_prefix(end + 1);
  }
  bytes = std::string(rest);
  return keys;
}

std::string TerminalPicture::show(const Screen& screen, std::string_view status) {
  const int columns = screen.picture.width;
  std::vector<std::string> rows;
  for (int y = 0; y < screen.picture.height; y += 2) rows.push_back(row_of(screen, y));
  std::string& last = rows.emplace_back();
  append_colour(last, 38, kStatus);
  append_colour(last, 48, kBlack);
  for (int x = 0; x < columns; ++x) {
    const char letter =
        static_cast<std::size_t>(x) < status.size() ? status[static_cast<std::size_t>(x)] : ' ';
    last += letter >= ' ' && letter <= '~' ? letter : '?';
  }

  const bool all = columns != columns_ || rows.size() != shown_.size();
  std::string out = all ? "\x1b[0m\x1b[2J" : "";
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (all || rows[i] != shown_[i]) out += fmt::format("\x1b[{};1H", i + 1) + rows[i];
  shown_ = std::move(rows);
  columns_ = columns;
  return out;
}

}  // namespace edgewise::viewer
