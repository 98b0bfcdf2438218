// The viewer in a terminal, over ssh for example.
#pragma once

#include "viewer/session.h"

namespace edgewise::viewer {

// Until the session is done. Throws std::runtime_error where standard input and output are no terminal, or
// one that cannot move its cursor. The terminal gets back what it showed before, also after a signal.
void show_in_terminal(Session& session);

}  // namespace edgewise::viewer
