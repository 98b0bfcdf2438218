// Text over the picture: the state of the session, or the help.
#pragma once

#include "support/options.h"
#include "viewer/text.h"

namespace edgewise::viewer {

class Session;
enum class Overlay { full, brief, none };

// The full overlay if the screen has room for it beside the picture, else the brief one.
Overlay overlay_that_fits(tools::Size size, Cell cell);

// Adds the overlay, axes and labels of a drawn session. `panel` is the size of one side's picture. Returns
// the help page shown, or 0 if none: a page number beyond the last closes the help.
int add_overlay(const Session& session, tools::Size panel, Cell cell, Screen& screen);

}  // namespace edgewise::viewer
