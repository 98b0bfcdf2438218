#include "support/console.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <string>

namespace edgewise::tools {

namespace {

std::FILE* printed = stdout;

struct Character {
  std::string_view bytes;
  char32_t code;
  bool valid;
};

// The first character of a non-empty text, or its first byte if that starts no valid character. The Unicode
// Standard, table 3-7, "Well-Formed UTF-8 Byte Sequences".
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {text.substr(0, 1), lead, true};
  const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  const Character invalid{text.substr(0, 1), lead, false};
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return invalid;
  char32_t code = lead & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return invalid;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool too_long = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (too_long || surrogate || code > 0x10FFFF) return invalid;
  return {text.substr(0, length), code, true};
}

// Includes characters that change the writing direction, because they can reorder the text around them.
bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string printable(std::string_view text, char replacement) {
  std::string result;
  while (!text.empty()) {
    const Character c = first_character(text);
    if (c.valid && !is_control(c.code))
      result += c.bytes;
    else
      result += replacement;
    text.remove_prefix(c.bytes.size());
  }
  return result;
}

std::string printable_within(std::string_view text, std::size_t columns) {
  const std::string whole = printable(text);
  const int most = static_cast<int>(columns);
  if (fmt::format("{:.{}}", whole, most) == whole) return whole;
  return fmt::format("{:.{}}{:.{}}", whole, std::max(0, most - 2), "..", most);
}

void print(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), printed);
}

void print_to_stderr() {
  printed = stderr;
}

bool stdout_is_whole() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

void print_error(std::string_view message, std::string_view program) {
  const std::string line = std::string(program) + ": " + printable(message, ' ') + '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void print_note(std::string_view message) {
  static std::mutex mutex;
  static std::set<std::string> earlier;
  const std::string line = printable(message, ' ') + '\n';
  const std::lock_guard lock(mutex);
  if (earlier.insert(line).second) std::fwrite(line.data(), 1, line.size(), stderr);
}

bool moves_cursor(int descriptor) {
  const char* const term = std::getenv("TERM");
  return isatty(descriptor) != 0 && term != nullptr && std::string_view(term) != "dumb";
}

int terminal_width(int descriptor) {
  winsize size{};
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace edgewise::tools
