// Standard output and error: written without exceptions, judged once at the end.
#pragma once

#include <string_view>

namespace edgewise::app {

void print(std::string_view text);  // to stdout

// Flushes stdout; false if anything since the start could not be written (a full disk, a closed pipe).
bool stdout_is_whole();

// "PROGRAM: MESSAGE" on stderr, always one line.
void print_error(std::string_view message, std::string_view program = "edgewise");

// Columns of the terminal behind a file descriptor; 80 where there is none.
int terminal_width(int descriptor = 1);

}  // namespace edgewise::app
