#include "cli/commands.h"

namespace edgewise::tools {

std::vector<Command> all_commands(viewer::ShowWindow show_window) {
  return {
      kList,
      kRender,
      {"hash", "Print one number per picture that is the same on every machine", add_hash},
      kVerify,
      {"accuracy", "Count each method's errors", add_accuracy},
      {"stability", "Find where each method starts to fail", add_stability},
      {"diff", "Compare two pictures, or two depth files", add_diff},
      {"portable", "Find the pixels that conformant rasterizers may draw differently", add_portable},
      {"needs", "Find the least precise pipelines that draw a scene right", add_needs},
      {"capture", "Write a scene's screen triangles as a .tri stream", add_capture},
      {"view", "Explore a scene: move, switch methods, see errors",
       [=](CLI::App& command) { return add_view(command, show_window); }},
      {"demo", "Show the tutorials that Edgewise grew from",
       [=](CLI::App& command) { return add_demo(command, show_window); }},
      kMachine,
  };
}

}  // namespace edgewise::tools
