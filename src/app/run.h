// The `edgewise` program without its main(), so that tests can link its parts.
#pragma once

#include "viewer/window.h"

namespace edgewise::app {

// Exit statuses: 0 done, 1 a difference was found, 2 bad input or failure (one line on stderr), 130 after
// Ctrl-C. `show_window` is null where the program was built without SDL.
int run(int argc, char** argv, viewer::ShowWindow show_window);

}  // namespace edgewise::app
