#include "cli/run.h"
#include "viewer/window.h"

int main(int argc, char** argv) {
#ifdef EDGEWISE_SDL
  return edgewise::tools::run(argc, argv, edgewise::viewer::show_sdl_window);
#else
  return edgewise::tools::run(argc, argv, nullptr);
#endif
}
