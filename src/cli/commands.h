// The subcommands. Each function adds a subcommand's options, and returns what to do once they are parsed.
#pragma once

#include <functional>
#include <vector>

#include "viewer/window.h"

namespace CLI {
class App;
}

namespace edgewise::tools {

inline constexpr int kDone = 0, kDiffers = 1, kFailed = 2;  // exit statuses

using Action = std::function<int()>;  // returns the exit status

struct Command {
  const char *name, *summary;
  std::function<Action(CLI::App&)> add;
};

// All, in the order of --help. `show_window` is null if the program was built without SDL.
std::vector<Command> all_commands(viewer::ShowWindow show_window = nullptr);

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

// Of both programs, src/program.
inline const Command kList{"list", "List all scenes, backends, SIMD targets and culling modes", add_list},
    kRender{"render", "Draw scenes into pictures and depth files", add_render},
    kVerify{"verify", "Check that all backends write the same bits", add_verify},
    kMachine{"machine", "Describe this machine and build as JSON, as result files do", add_machine};

}  // namespace edgewise::tools
