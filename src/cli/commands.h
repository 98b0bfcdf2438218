// The subcommands. Each function declares a subcommand's options. When the command line names
// the subcommand, parsing sets `action`.
#pragma once

#include <functional>

#include "viewer/window.h"

namespace CLI {
class App;
}

namespace edgewise::tools {

inline constexpr int kDone = 0, kDiffers = 1, kFailed = 2;  // exit statuses

using Action = std::function<int()>;  // returns the exit status

void add_list(CLI::App& program, Action& action);
void add_render(CLI::App& program, Action& action);
void add_verify(CLI::App& program, Action& action);
void add_accuracy(CLI::App& program, Action& action);
void add_stability(CLI::App& program, Action& action);
void add_diff(CLI::App& program, Action& action);
void add_needs(CLI::App& program, Action& action);
void add_portable(CLI::App& program, Action& action);
void add_capture(CLI::App& program, Action& action);
void add_view(CLI::App& program, Action& action, viewer::ShowWindow show_window);
void add_demo(CLI::App& program, Action& action, viewer::ShowWindow show_window);
void add_machine(CLI::App& program, Action& action);

}  // namespace edgewise::tools
