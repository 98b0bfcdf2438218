// Text that is not ours (names of files and scenes, messages that quote them), made fit for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace edgewise::app {

// Valid UTF-8 without control characters: each of those, and each byte that is not UTF-8, becomes
// `replacement`.
std::string printable(std::string_view text, char replacement = '?');

// The same, of at most so many columns; a longer text ends in "..". Only whole characters are kept.
std::string printable_within(std::string_view text, std::size_t columns);

}  // namespace edgewise::app
