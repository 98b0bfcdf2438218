// The viewer in a window, or in a terminal.
#pragma once

#include <string>

#include "support/options.h"

namespace edgewise::viewer {

class Session;

// Returns when the session is done or the window is closed. Throws std::runtime_error if no window can be
// opened.
using ShowWindow = void (*)(Session& session, const std::string& title, tools::Size size);

// Defined in src/program, and only if SDL and Dear ImGui were found.
void show_sdl_window(Session& session, const std::string& title, tools::Size size);

// In half-block characters, for example over ssh. Returns when the session is done. Throws std::runtime_error
// if standard input and output are not a terminal with cursor control. Restores the terminal's screen and
// mode, also after a signal.
void show_in_terminal(Session& session);

}  // namespace edgewise::viewer
