#include "cli/run.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands.h"
#include "core/nearest_name.h"
#include "support/console.h"
#include "support/options.h"
#include "support/process.h"

namespace edgewise::tools {

namespace {

constexpr const char* kProgramFooter = R"(Try:
  edgewise list                          scenes, backends, SIMD targets, culling modes
  edgewise render cube -o cube.png       a first picture
  edgewise verify                        check that all backends write the same bits
  edgewise COMMAND --help                options and examples

The folder of an output file must exist. An output that names a folder (-o pictures/) is created.
As the name of a file, - is standard input or output (./- is a file of this name). A file that the
shell redirects to standard input is read from its start.

Exit status: 0 success, 1 a difference was found, 2 bad input or failure, 128 + N stopped by
signal N (130: Ctrl-C). If a reader such as `head` closes standard output early, that is no error.)";

// Replaces CLI11's messages, which don't suggest the nearest command or option.
void check_first_word(const CLI::App& program, std::string_view word) {
  std::vector<std::string> words = option_names(program);
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    words.push_back(command->get_name());
  const std::vector<std::string_view> known(words.begin(), words.end());
  if (std::find(known.begin(), known.end(), word) != known.end()) return;
  throw std::invalid_argument(unknown_name(word.starts_with('-') ? "option" : "command", word, known));
}

// The message for a command line that CLI11 rejects. An unknown option comes first, because it causes other
// errors: its value is taken for a positional argument, or a required option seems to be missing.
std::string why_refused(const CLI::ParseError& error, const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands())
    for (const std::string& word : command->remaining())
      if (word.starts_with('-'))
        return unknown_option(word, option_names(*command), program.get_name() + ' ' + command->get_name());
  return error.what();
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
  const auto add = [&](const char* name, const char* summary, const auto& add_options, auto... window) {
    CLI::App& command = *program.add_subcommand(name, summary);
    command.callback([&action, chosen = add_options(command, window...)] { action = chosen; });
  };
  add("list", "List all scenes, backends, SIMD targets and culling modes", add_list);
  add("render", "Draw scenes into pictures and depth files", add_render);
  add("hash", "Print one number per picture that is the same on every machine", add_hash);
  add("verify", "Check that all backends write the same bits", add_verify);
  add("accuracy", "Count each method's errors", add_accuracy);
  add("stability", "Find where each method starts to fail", add_stability);
  add("diff", "Compare two pictures, or two depth files", add_diff);
  add("portable", "Find the pixels that conformant rasterizers may draw differently", add_portable);
  add("needs", "Find the least precise pipelines that draw a scene right", add_needs);
  add("capture", "Write a scene's screen triangles as a .tri stream", add_capture);
  add("view", "Explore a scene: move, switch methods, see errors", add_view, show_window);
  add("demo", "Show the tutorials that Edgewise grew from", add_demo, show_window);
  add("machine", "Describe this machine and build as JSON, as result files do", add_machine);
  if (argc < 2) throw std::invalid_argument("no command given; try edgewise --help");
  check_first_word(program, argv[1]);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw std::invalid_argument(why_refused(error, program));
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

}  // namespace edgewise::tools
