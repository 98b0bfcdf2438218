#include "app/run.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/process.h"
#include "nearest_name.h"

namespace edgewise::app {

namespace {

constexpr const char* kFooter = R"(Try:
  edgewise list                          what can be named
  edgewise render cube -o cube.png       a first picture
  edgewise verify                        do all backends agree on every bit?
  edgewise COMMAND --help                options and examples

Exit status: 0 done, 1 a difference was found, 2 bad input or failure, 130 after Ctrl-C.)";

// CLI11 would only say that the word was not expected.
void check_command(const CLI::App& program, std::string_view word) {
  std::vector<std::string_view> known;
  const auto commands = program.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : commands) known.push_back(command->get_name());
  for (const std::string_view name : known)
    if (name == word) return;
  throw std::invalid_argument(unknown_name("command", word, known));
}

int parse_and_run(int argc, char** argv, viewer::ShowWindow show_window) {
  CLI::App program("A laboratory for triangle rasterization on the CPU.", "edgewise");
  program.set_version_flag("--version", "edgewise " EDGEWISE_VERSION);
  program.require_subcommand(1);
  program.footer(kFooter);
  Action action;
  add_list(program, action);
  add_render(program, action);
  add_verify(program, action);
  add_accuracy(program, action);
  add_stability(program, action);
  add_diff(program, action);
  add_capture(program, action);
  add_view(program, action, show_window);
  add_machine(program, action);
  if (argc < 2) throw std::invalid_argument("no command given; try edgewise --help");
  if (argv[1][0] != '-') check_command(program, argv[1]);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw std::invalid_argument(error.what());
    std::ostringstream help;
    program.exit(error, help, help);
    print(help.str());
    return kDone;
  }
  return action();
}

int guarded(int argc, char** argv, viewer::ShowWindow show_window) {
  try {
    return parse_and_run(argc, argv, show_window);
  } catch (const std::bad_alloc&) {
    print_error("out of memory");
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return kFailed;
}

}  // namespace

int run(int argc, char** argv, viewer::ShowWindow show_window) {
  prepare_process();
  const int status = guarded(argc, argv, show_window);
  if (stdout_is_whole() || status == kFailed) return status;
  print_error("cannot write to standard output");
  return kFailed;
}

}  // namespace edgewise::app
