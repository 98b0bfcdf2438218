// How the commands view and demo show a viewer session.
#pragma once

#include "support/options.h"
#include "support/output_path.h"
#include "viewer/session.h"
#include "viewer/window.h"

namespace edgewise::tools {

// Throws std::invalid_argument if this program was built without window support.
void check_windows(viewer::ShowWindow show_window);

// Paints the texts into a drawn screen and writes it as a picture.
void write_screen(const OutputFile& file, viewer::Screen& screen, int font_scale);

// Draws the session and writes the picture that a window of this size would show.
void write_picture(const OutputFile& file, viewer::Session& session, Size size);

// Prints the names of the files that the session has saved.
void print_saved(viewer::Session& session);

}  // namespace edgewise::tools
