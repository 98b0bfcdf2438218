#include "cli/show.h"

#include <stdexcept>

#include "edgewise/image.h"
#include "support/console.h"
#include "support/printable.h"

namespace edgewise::tools {

void check_windows(viewer::ShowWindow show_window) {
  if (show_window == nullptr)
    throw std::invalid_argument(
        "this program was built without SDL2 and cannot open a window: use --terminal, or install "
        "libsdl2-dev and rebuild");
}

void write_screen(const OutputFile& file, viewer::Screen& screen, int font_scale) {
  viewer::paint(screen, font_scale);
  write_image(file.path, screen.picture, file.format);
}

void write_picture(const OutputFile& file, viewer::Session& session, Size size) {
  const int scale = viewer::font_scale(size.height);
  write_screen(file, session.draw(size, viewer::font_cell(scale)), scale);
}

void print_saved(viewer::Session& session) {
  for (const std::string& path : session.take_saved()) print(printable(path) + "\n");
}

}  // namespace edgewise::tools
