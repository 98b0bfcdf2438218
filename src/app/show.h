// Sessions of the viewer as commands show them.
#pragma once

#include <filesystem>

#include "app/options.h"
#include "viewer/session.h"
#include "viewer/window.h"

namespace edgewise::app {

// Throws std::invalid_argument if this program was built without windows.
void check_windows(viewer::ShowWindow show_window);

// Writes what is seen. The same as a window of this size shows.
void write_seen(const std::filesystem::path& path, viewer::Session& session, Size size);

// The names of the files that the session has saved.
void print_saved(viewer::Session& session);

}  // namespace edgewise::app
