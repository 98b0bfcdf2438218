#include "bench/program/flags.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "edgewise/limits.h"
#include "support/options.h"

namespace edgewise::bench {

std::optional<Flags> parse_flags(int argc, char** argv) {
  Flags flags;
  std::optional<tools::Size> size;
  CLI::App parser{"Compare all pictures, then time the backends, the front end and the laboratory's methods",
                  "edgewise_bench"};
  parser.allow_extras();
  parser
      .add_option("--scene", flags.suite.scenes,
                  "Only this scene, a name or an .obj or .tri file (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME|FILE");
  parser.add_option("--add-scene", flags.suite.more_scenes, "The whole suite and this scene (repeatable)")
      ->allow_extra_args(false)
      ->excludes("--scene")
      ->type_name("FILE");
  parser.add_flag("--fit", flags.suite.fit, "Centre a mesh from a file and scale its longest side to 2");
  parser.add_flag("--methods", flags.suite.methods, "Also time the laboratory's methods on --scene")
      ->needs("--scene");
  bool no_peers = false;
  auto* peers_flag =
      parser.add_flag("--peers", flags.need_peers, "Fail if none of other projects' rasterizers starts");
  parser.add_flag("--no-peers", no_peers, "Leave out other projects' rasterizers")->excludes(peers_flag);
  parser.add_flag("--quick", flags.suite.quick, "Fewer scenes, rows and rounds");
  parser
      .add_option("--needs", flags.suite.needs,
                  "Also time the pipelines in this file, such as results/facts/needs.json")
      ->excludes("--scene")
      ->excludes("--quick")
      ->type_name("FILE");
  tools::add_parsed(parser, "--threads", "N,N...",
                    "Numbers of threads of scenes' frames (1, 2, 4 ... and the usable cores)",
                    [&](const std::string& text) {
                      flags.suite.threads.clear();
                      std::istringstream numbers(text);
                      for (std::string number; std::getline(numbers, number, ',');)
                        flags.suite.threads.insert(tools::parse_number("--threads", number, 1, kMaxThreads));
                      if (flags.suite.threads.empty()) throw std::invalid_argument("--threads: no number");
                    });
  tools::add_size(parser, size, "Image size (1920x1080; a .tri file has its own)");
  tools::add_subpixel_bits(parser, flags.suite.subpixel_bits);
  std::string format;
  parser.add_option("--benchmark_out", flags.out, "Write the results to this file, complete or not at all")
      ->type_name("FILE");
  parser.add_option("--benchmark_out_format", format, "json only")->check(CLI::IsMember({"json"}));
  parser.footer(
      "Google Benchmark's other flags work too, for example --benchmark_filter=REGEX,\n"
      "--benchmark_list_tests, --benchmark_repetitions=N, --benchmark_min_time=SECONDS and\n"
      "--benchmark_format=console|json|csv.\n"
      "Exit status: 0 done, 1 a row drew wrong pixels, 2 bad input or failure, 130 after Ctrl-C.\n"
      "If a reader such as `head` closes standard output early, that is no error.");
  try {
    parser.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << parser.help();
    return std::nullopt;
  }

  if (size) {
    flags.suite.width = size->width;
    flags.suite.height = size->height;
    flags.suite.size_asked = true;
  }
  flags.suite.peers = !no_peers;
  flags.benchmark = parser.remaining();
  flags.known = tools::option_names(parser);
  for (const auto& flag : flags.benchmark)
    if (flag.starts_with("--benchmark_min_time")) flags.own_iterations = false;
  constexpr std::string_view kRepetitions = "--benchmark_repetitions=";
  std::erase_if(flags.benchmark, [&](const std::string& flag) {
    if (!flag.starts_with(kRepetitions)) return false;
    flags.repetitions =
        tools::parse_number("--benchmark_repetitions", flag.substr(kRepetitions.size()), 1, 1'000'000);
    return true;
  });
  return flags;
}

}  // namespace edgewise::bench
