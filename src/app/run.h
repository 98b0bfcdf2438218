// The `edgewise` program without its main(), so that tests can link its parts.
#pragma once

namespace edgewise::app {

// Exit statuses: 0 done, 1 a difference was found, 2 bad input or failure (one line on stderr), 128 + N stopped
// by signal N.
int run(int argc, char** argv);

}  // namespace edgewise::app
