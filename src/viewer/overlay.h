// What is written over the picture: the state of the session, or the help.
#pragma once

#include "support/options.h"
#include "viewer/text.h"

namespace edgewise::viewer {

class Session;
enum class Overlay { full, brief, none };

// The full one where there is something to be seen beside it.
Overlay overlay_that_fits(app::Size size, Cell cell);

// Adds the overlay of a session that has been drawn, with axes and labels. `panel` is the size of one side's
// picture. Returns the page of the help that is shown, 0 if none: pages that don't exist close it.
int add_overlay(const Session& session, app::Size panel, Cell cell, Screen& screen);

}  // namespace edgewise::viewer
