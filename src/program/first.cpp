// `edgewise` with the commands that draw and verify, and nothing else.
#include "cli/basic/run.h"
#include "core/parallel.h"

int main(int argc, char** argv) {
  using namespace edgewise::tools;
  edgewise::allow_more_threads_than_cores();
  const Command commands[] = {kList, kRender, kVerify, kMachine};
  return run(argc, argv, commands);
}
