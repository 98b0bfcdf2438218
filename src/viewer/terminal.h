// The viewer in a terminal, for example over ssh.
#pragma once

#include "viewer/session.h"

namespace edgewise::viewer {

// Returns when the session is done. Throws std::runtime_error if standard input and output are not a terminal
// with cursor control. Restores the terminal's screen and mode, also after a signal.
void show_in_terminal(Session& session);

}  // namespace edgewise::viewer
