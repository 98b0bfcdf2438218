#include "core/numbers.h"

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace edgewise {

std::string_view without_plus(std::string_view word) {
  return word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
}

double parse_number(std::string_view word) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
// libc++ may not define this macro even where it has from_chars for double; the slower way is then used.
#ifdef __cpp_lib_to_chars
  word = without_plus(word);
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, value);
  if (end != last || error == std::errc::invalid_argument) return kNone;
  if (error == std::errc()) return value;
#endif
  // Slower, but it says whether a value is too small or too large. libc++ takes one that becomes 0 for none,
  // and hexadecimal digits for a number.
  if (word.find_first_not_of("0123456789+-.eE") != word.npos) return kNone;
  std::istringstream in{std::string(word)};
  in.imbue(std::locale::classic());
  in >> value;
  if (!in.eof() || (in.fail() && value == 0.0)) return kNone;
  return in.fail() && std::abs(value) > 1.0 ? value * std::numeric_limits<double>::infinity() : value;
}

}  // namespace edgewise
