#include "cli/run.h"
#include "core/parallel.h"
#include "viewer/window.h"

int main(int argc, char** argv) {
  edgewise::allow_more_threads_than_cores();
#ifdef EDGEWISE_SDL
  return edgewise::tools::run(argc, argv, edgewise::viewer::show_sdl_window);
#else
  return edgewise::tools::run(argc, argv, nullptr);
#endif
}
