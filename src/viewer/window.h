// The viewer in a window.
#pragma once

#include <string>

#include "support/options.h"
#include "viewer/frame_times.h"

namespace edgewise::viewer {

class Session;

struct WindowOptions {
  std::string title;
  tools::Size size;
  int frames = 0;  // to draw without a frame-rate limit before quitting; 0: run until the user quits
};

// Returns when the session is done or the window is closed, with the frame times if options.frames > 0.
// Throws std::runtime_error if no window can be opened.
using ShowWindow = FrameTimes (*)(Session& session, const WindowOptions& options);

// Defined in sdl_window.cpp, which is built only into the program, and only if SDL was found.
FrameTimes show_sdl_window(Session& session, const WindowOptions& options);

}  // namespace edgewise::viewer
