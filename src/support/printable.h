// Makes external text (file and scene names, messages that quote them) safe to print on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace edgewise::tools {

// Returns valid UTF-8 without control characters: replaces each control character and each invalid byte.
std::string printable(std::string_view text, char replacement = '?');

// The same, cut to a number of characters; a cut text ends in "..". Characters are never split.
std::string printable_within(std::string_view text, std::size_t columns);

}  // namespace edgewise::tools
