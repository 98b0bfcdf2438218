// The subcommands. Each function adds a subcommand's options, and returns what to do once they are parsed.
#pragma once

#include <functional>

#include "viewer/window.h"

namespace CLI {
class App;
}

namespace edgewise::tools {

inline constexpr int kDone = 0, kDiffers = 1, kFailed = 2;  // exit statuses

using Action = std::function<int()>;  // returns the exit status

Action add_list(CLI::App& command);
Action add_render(CLI::App& command);
Action add_hash(CLI::App& command);
Action add_verify(CLI::App& command);
Action add_accuracy(CLI::App& command);
Action add_stability(CLI::App& command);
Action add_diff(CLI::App& command);
Action add_needs(CLI::App& command);
Action add_portable(CLI::App& command);
Action add_capture(CLI::App& command);
Action add_view(CLI::App& command, viewer::ShowWindow show_window);
Action add_demo(CLI::App& command, viewer::ShowWindow show_window);
Action add_machine(CLI::App& command);

}  // namespace edgewise::tools
