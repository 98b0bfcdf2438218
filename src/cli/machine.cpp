// `edgewise machine`: describes the machine and the build, as every result file does.
#include "support/machine.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.h"
#include "support/console.h"
#include "support/json_text.h"

namespace edgewise::tools {

void add_machine(CLI::App& program, Action& action) {
  CLI::App& command =
      *program.add_subcommand("machine", "Describe this machine and build as JSON, as result files do");
  const auto name_only = std::make_shared<bool>(false);
  command.add_flag("--name", *name_only, "Print only the name of this machine's folder below results/");
  command.callback([name_only, &action] {
    action = [name_only] {
      print((*name_only ? machine_name() : json_text(machine_description(), 2)) + "\n");
      return kDone;
    };
  });
}

}  // namespace edgewise::tools
