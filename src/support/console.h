// Standard output and error: written without exceptions, judged once at the end.
#pragma once

#include <string_view>

namespace edgewise::app {

void print(std::string_view text);  // to stdout

// Flushes stdout; false if anything since the start could not be written, as to a full disk. A reader that
// has closed its end of a pipe wants no more: true.
bool stdout_is_whole();

// "PROGRAM: MESSAGE" on stderr, always one line.
void print_error(std::string_view message, std::string_view program = "edgewise");

// Whether a file descriptor leads to a terminal that obeys cursor controls; TERM=dumb names one that doesn't.
bool moves_cursor(int descriptor);

// Columns of the terminal behind a file descriptor; 80 where there is none.
int terminal_width(int descriptor = 1);

}  // namespace edgewise::app
