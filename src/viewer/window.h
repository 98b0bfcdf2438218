// The viewer in a window.
#pragma once

#include <string>

#include "support/options.h"
#include "viewer/frame_times.h"

namespace edgewise::viewer {

class Session;

struct WindowOptions {
  std::string title;
  app::Size size;
  int frames = 0;  // to draw, as fast as they go, and leave; 0: until the user quits
};

// Until the session is done or the window closed; returns how long each frame took. Throws std::runtime_error
// where no window can be opened.
using ShowWindow = FrameTimes (*)(Session& session, const WindowOptions& options);

// sdl_window.cpp, which only the program has, and only if SDL was found when it was built.
FrameTimes show_sdl_window(Session& session, const WindowOptions& options);

}  // namespace edgewise::viewer
