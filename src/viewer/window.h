// The viewer in a window, or in a terminal.
#pragma once

#include <string>
#include <vector>

#include "support/options.h"

namespace edgewise::viewer {

class Session;

struct WindowOptions {
  std::string title;
  tools::Size size;
  int frames = 0;  // to draw without a frame-rate limit before quitting; 0: run until the user quits
};

struct FrameTimes {
  std::vector<double> milliseconds;  // from each frame's events to its pixels in the window
  double cpu_ms = 0;                 // CPU time of all threads, summed over all frames
};

// Returns when the session is done or the window is closed, with the frame times if options.frames > 0.
// Throws std::runtime_error if no window can be opened.
using ShowWindow = FrameTimes (*)(Session& session, const WindowOptions& options);

// Defined in sdl_window.cpp, which is built only into the program, and only if SDL was found.
FrameTimes show_sdl_window(Session& session, const WindowOptions& options);

// In half-block characters, for example over ssh. Returns when the session is done. Throws std::runtime_error
// if standard input and output are not a terminal with cursor control. Restores the terminal's screen and
// mode, also after a signal.
void show_in_terminal(Session& session);

}  // namespace edgewise::viewer
