#include "app/run.h"

#include <CLI/CLI.hpp>
#include <exception>
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

constexpr const char* kProgramFooter = R"(Try:
  edgewise list                          scenes, backends, SIMD targets, culling modes
  edgewise render cube -o cube.png       a first picture
  edgewise verify                        do all backends agree on every bit?
  edgewise COMMAND --help                options and examples

Exit status: 0 done, 1 a difference was found, 2 bad input or failure, 128 + N stopped by signal N (130: Ctrl-C).)";

// CLI11 would only say that the word was not expected, or that a command is missing.
void check_first_word(const CLI::App& program, std::string_view word) {
  std::vector<std::string_view> known{"--help", "--version", "-h"};
  const bool option = word.starts_with('-');
  if (!option) {
    known.clear();
    const auto commands = program.get_subcommands([](const CLI::App*) { return true; });
    for (const CLI::App* command : commands) known.push_back(command->get_name());
  }
  for (const std::string_view name : known)
    if (name == word) return;
  throw std::invalid_argument(unknown_name(option ? "option" : "command", word, known));
}

int guarded(int argc, char** argv, viewer::ShowWindow show_window) {
  try {
    return parse(argc, argv, show_window)();
  } catch (const std::exception& error) {
    print_error(reason_of(error));
  }
  return kFailed;
}

}  // namespace

Action parse(int argc, char** argv, viewer::ShowWindow show_window) {
  CLI::App program("A laboratory for triangle rasterization on the CPU.", "edgewise");
  program.set_version_flag("--version", "edgewise " EDGEWISE_VERSION);
  program.require_subcommand(1);
  program.footer(kProgramFooter);
  Action action;
  add_list(program, action);
  add_render(program, action);
  add_verify(program, action);
  add_soak(program, action);
  add_accuracy(program, action);
  add_stability(program, action);
  add_diff(program, action);
  add_capture(program, action);
  add_view(program, action, show_window);
  add_demo(program, action, show_window);
  add_machine(program, action);
  if (argc < 2) throw std::invalid_argument("no command given; try edgewise --help");
  check_first_word(program, argv[1]);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw std::invalid_argument(error.what());
    std::ostringstream help;
    program.exit(error, help, help);
    return [text = help.str()] {
      print(text);
      return kDone;
    };
  }
  return action;
}

int run(int argc, char** argv, viewer::ShowWindow show_window) {
  prepare_process("edgewise");
  const int status = guarded(argc, argv, show_window);
  if (stdout_is_whole() || status == kFailed) return status;
  print_error("cannot write to standard output");
  return kFailed;
}

}  // namespace edgewise::app
