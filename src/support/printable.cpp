#include "support/printable.h"

namespace edgewise::tools {

namespace {

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

// Columns as {fmt} counts them: two for East Asian wide characters and pictographs.
std::size_t columns_of(char32_t code) {
  const auto within = [code](char32_t first, char32_t last) { return code >= first && code <= last; };
  const bool wide = within(0x1100, 0x115F) || within(0x2E80, 0xA4CF) || within(0xAC00, 0xD7A3) ||
                    within(0xF900, 0xFAFF) || within(0xFE30, 0xFE6F) || within(0xFF00, 0xFF60) ||
                    within(0xFFE0, 0xFFE6) || within(0x1F300, 0x1F64F) || within(0x1F900, 0x1F9FF) ||
                    within(0x20000, 0x3FFFD);
  return wide ? 2 : 1;
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
  constexpr std::string_view kEllipsis = "..";
  const std::string whole = printable(text);
  const std::size_t room = columns > kEllipsis.size() ? columns - kEllipsis.size() : 0;
  std::size_t used = 0, fitting = 0;  // columns; bytes that leave room for kEllipsis
  for (std::string_view rest = whole; !rest.empty();) {
    const Character c = first_character(rest);
    used += columns_of(c.code);
    if (used > columns) return whole.substr(0, fitting) + std::string(kEllipsis.substr(0, columns));
    rest.remove_prefix(c.bytes.size());
    if (used <= room) fitting = whole.size() - rest.size();
  }
  return whole;
}

}  // namespace edgewise::tools
