// Sessions of the viewer as commands show them.
#pragma once

#include <filesystem>

#include "support/options.h"
#include "viewer/session.h"
#include "viewer/window.h"

namespace edgewise::app {

// Throws std::invalid_argument if this program was built without windows.
void check_windows(viewer::ShowWindow show_window);

// Paints the texts into a screen that has been drawn, and writes it.
void write_screen(const std::filesystem::path& path, viewer::Screen& screen, int font_scale);

// Draws what is seen, and writes it. The same as a window of this size shows.
void write_seen(const std::filesystem::path& path, viewer::Session& session, Size size);

// The names of the files that the session has saved.
void print_saved(viewer::Session& session);

}  // namespace edgewise::app
