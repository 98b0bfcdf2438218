#include "cli/basic/run.h"
#include "core/parallel.h"
#include "viewer/window.h"

int main(int argc, char** argv) {
  edgewise::allow_more_threads_than_cores();
#ifdef EDGEWISE_SDL
  constexpr edgewise::viewer::ShowWindow kShowWindow = edgewise::viewer::show_sdl_window;
#else
  constexpr edgewise::viewer::ShowWindow kShowWindow = nullptr;
#endif
  return edgewise::tools::run(argc, argv, edgewise::tools::all_commands(kShowWindow));
}
