// The `edgewise` program without its main(), so that tests can link its parts.
#pragma once

#include <span>

#include "cli/commands.h"

namespace edgewise::tools {

// Parses a command line and returns its action without running it; argv may be freed afterwards. Throws
// std::invalid_argument with a one-line reason for an invalid command line.
Action parse(int argc, char** argv, std::span<const Command> commands);

// Returns the exit status: 0 success, 1 a difference was found, 2 bad input or failure (one line on stderr),
// 128 + N stopped by signal N.
int run(int argc, char** argv, std::span<const Command> commands);

}  // namespace edgewise::tools
