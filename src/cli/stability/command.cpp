// `edgewise stability`: finds where each method starts to fail.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/stability/report.h"
#include "support/console.h"
#include "support/json.h"
#include "support/options.h"
#include "support/progress.h"

namespace edgewise::tools {

namespace {

struct StabilityOptions {
  std::vector<std::string> sweeps;
  std::string json;
  int threads = 2;
  bool quick = false, list = false;
};

std::vector<const lab::Sweep*> chosen(const StabilityOptions& o) {
  std::vector<const lab::Sweep*> list;
  if (o.sweeps.empty())
    for (const lab::Sweep& sweep : lab::sweeps()) list.push_back(&sweep);
  for (const std::string& name : o.sweeps) list.push_back(&lab::find_sweep(name));
  return list;
}

int stability_command(const StabilityOptions& o) {
  const auto sweeps = chosen(o);
  if (o.list) {
    print(list_of_sweeps());
    return kDone;
  }
  JsonOutput json(o.json);

  Progress progress;
  std::vector<lab::SweepResult> results;
  for (const lab::Sweep* sweep : sweeps) {
    progress.show(static_cast<double>(results.size()) / static_cast<double>(sweeps.size()), sweep->name);
    results.push_back(lab::run_sweep(*sweep, o.quick ? lab::kQuick : lab::kFull, o.threads));
    if (json.on_stdout()) continue;
    progress.erase();
    print(stability_table(results.back()) + (sweep == sweeps.back() ? "" : "\n"));
    std::fflush(stdout);
  }
  progress.erase();

  if (json.wanted()) json.write(json_text(stability_json(results), 2) + '\n');
  return kDone;
}

constexpr const char* kStabilityFooter = R"(Examples:
  edgewise stability --quick
  edgewise stability --json stability.json       all sweeps (minutes)
  edgewise stability legs separation_at_100

A sweep varies one parameter of random scenes from easy to hard. At each value it counts the errors
of every method of a family against an exact reference for the positions that the caller gave, in
at least 100,000 trials (--quick: 5,000). Sweeps of coverage have vertices at random positions, or
as NAME_on_halves at pixel centres, corners and between, or as NAME_on_our_grid on 1/256 px. ours_8,
ours_12 and ours_15 are all backends, with so many subpixel bits.

Columns: the first value where the method fails, which is where it errs in more than 1 of 10,000
trials; and its largest error at any value, per 10^6 trials. If no error was observed, the number
after "<" is the 95 % upper bound: 3 divided by the smallest number of trials at a value.)";

}  // namespace

Action add_stability(CLI::App& command) {
  const auto o = std::make_shared<StabilityOptions>();
  command.add_option("SWEEP", o->sweeps, "Sweeps from --list (all)");
  command.add_flag("--quick", o->quick, "Fewer trials per value");
  command.add_flag("--list", o->list, "List all sweeps");
  add_text(command, "--json", "FILE", o->json,
           "Also write all results as JSON; - for stdout, instead of the tables");
  add_integer(command, "--threads", o->threads, 1, kMaxThreads, "Threads; results don't depend on it (2)");
  command.footer(kStabilityFooter);
  return [o] { return stability_command(*o); };
}

}  // namespace edgewise::tools
