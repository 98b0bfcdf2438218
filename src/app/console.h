// Standard output and error: written without exceptions, judged once at the end.
#pragma once

#include <string_view>

namespace edgewise::app {

void print(std::string_view text);  // to stdout

// Flushes stdout; false if anything since the start could not be written (a full disk, a closed pipe).
bool stdout_is_whole();

// "edgewise: MESSAGE" on stderr, always one line.
void print_error(std::string_view message);

// Columns of the terminal behind stdout; 80 where there is none.
int terminal_width();

}  // namespace edgewise::app
