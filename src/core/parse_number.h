// Numbers of text files, whatever the process's locale.
#pragma once

#include <string_view>

namespace edgewise {

// std::from_chars does not accept a leading plus.
std::string_view without_plus(std::string_view word);

// NaN if the word is not a decimal number. Infinity if it is too large for a double. About 0 if it is too
// small, but NaN where the C++ library lacks std::from_chars for doubles. Words like "inf" and "nan" may give
// infinity and NaN.
double parse_number(std::string_view word);

}  // namespace edgewise
