// The `edgewise` program without its main(), so that tests can link its parts.
#pragma once

#include "cli/commands.h"

namespace edgewise::app {

// What a command line asks for, without doing it; the arguments are not needed any more. Throws
// std::invalid_argument, with a line that says what is wrong, where it asks for nothing that there is.
Action parse(int argc, char** argv, viewer::ShowWindow show_window = nullptr);

// Exit statuses: 0 done, 1 a difference was found, 2 bad input or failure (one line on stderr), 128 + N
// stopped by signal N. `show_window` is null where the program was built without SDL.
int run(int argc, char** argv, viewer::ShowWindow show_window);

}  // namespace edgewise::app
