// Numbers of text files, whatever the process's locale.
#pragma once

#include <string_view>

namespace edgewise {

// A decimal number. NaN if the word is none; infinity or about 0 if it is too large or too small for a
// double.
double parse_number(std::string_view word);

}  // namespace edgewise
