// `edgewise` with the commands that draw and verify, and nothing else.
#include "cli/basic/run.h"
#include "core/parallel.h"

int main(int argc, char** argv) {
  using namespace edgewise::tools;
  edgewise::allow_more_threads_than_cores();
  const Command kCommands[] = {
      {"list", "List all scenes, backends, SIMD targets and culling modes", add_list},
      {"render", "Draw scenes into pictures and depth files", add_render},
      {"verify", "Check that all backends write the same bits", add_verify},
      {"machine", "Describe this machine and build as JSON, as result files do", add_machine}};
  return run(argc, argv, kCommands);
}
