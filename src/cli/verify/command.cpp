// `edgewise verify`: compares all backends, on scenes or on random pictures.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "cli/commands.h"
#include "cli/verify/random.h"
#include "cli/verify/verify.h"
#include "support/console.h"
#include "support/json.h"
#include "support/machine.h"
#include "support/output_path.h"
#include "support/process.h"
#include "support/progress.h"

namespace edgewise::tools {

namespace {

struct VerifyOptions {
  VerifyPlan plan;
  std::string json, out = "edgewise-verify-failures";
  bool random = false;
  randomized::Plan random_plan;
};

randomized::Shard parse_shard(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos)
    throw std::invalid_argument(fmt::format("--shard: '{}' is not I/N, with I from 0 to N - 1", text));
  const auto of = parse_number<std::uint64_t>("--shard", text.substr(slash + 1), 1, randomized::kMostShards);
  return {parse_number<std::uint64_t>("--shard", text.substr(0, slash), 0, of - 1), of};
}

int verify_random_command(VerifyOptions& o) {
  randomized::Plan& plan = o.random_plan;
  const StopRequest request;
  plan.backends.assign(backends().begin(), backends().end());
  plan.failure_folder = o.out;
  check_json_file(o.json, o.out, {});
  JsonOutput json(o.json);

  const nlohmann::json machine = machine_description();  // now: the source tree may change meanwhile
  Progress progress;
  const auto show = [&](const std::string& text) {
    progress.erase();
    if (json.on_stdout())
      std::fputs(text.c_str(), stderr);
    else
      print(text);
    std::fflush(stdout);
  };
  plan.stop = [&] { return request.signal() != 0; };
  plan.on_finding = show;
  plan.on_progress = [&](const randomized::Report& now) {
    const double fraction = now.seconds / plan.seconds;  // 0 without a limit
    progress.show(std::isfinite(plan.seconds) ? std::optional(fraction) : std::nullopt,
                  fmt::format("{} cases, {} differ", now.cases, now.differences));
  };
  randomized::Report report;
  std::exception_ptr error;
  try {
    randomized::run(plan, report);
  } catch (...) {
    error = std::current_exception();  // write the results until there first
  }
  progress.erase();
  if (!json.on_stdout()) print(summary(report, plan));
  if (json.wanted()) json.write(json_text(to_json(report, plan, machine)) + '\n');
  if (error) std::rethrow_exception(error);
  if (report.differences != 0) return kDiffers;
  return request.signal() == 0 ? kDone : 128 + request.signal();
}

int verify_command(VerifyOptions& o) {
  VerifyPlan& plan = o.plan;
  if (plan.scenes.empty())
    for (const SceneInfo& scene : builtin_scenes()) plan.scenes.emplace_back(scene.name);
  for (const std::string& scene : plan.scenes) check_source(scene);
  plan.backends.assign(backends().begin(), backends().end());
  plan.failure_folder = o.out;

  check_json_file(o.json, o.out, plan.scenes);
  JsonOutput json(o.json);

  Progress progress;
  plan.on_progress = [&](double fraction, std::string_view scene) { progress.show(fraction, scene); };
  const auto show = [&](const std::string& text) {
    if (json.on_stdout()) return;
    progress.erase();
    print(text);
    std::fflush(stdout);
  };
  std::string header = verify_header();  // printed only after the first scene was read
  const VerifyReport report = verify(plan, [&](const SceneVerdict& verdict) {
    show(std::exchange(header, {}) + verify_line(verdict) + explain(verdict));
  });
  show(summary(report, plan));

  if (json.wanted()) json.write(json_text(report_json(report, plan), 2) + '\n');
  return report.ok() ? kDone : kDiffers;
}

constexpr const char* kVerifyFooter = R"(Examples:
  edgewise verify                              all built-in scenes, streams scaled down
  edgewise verify --full                       at 1920x1080, all triangles (long)
  edgewise verify bunny.obj capture.tri --fit  your own files
  edgewise verify --json verify.json
  edgewise verify --random --for 1h --seed 7 --shard 3/64 --json 3.json
  edgewise verify --random --seed 7 --case 123456              reproduce one case

Verify draws every scene with every backend in every culling mode: on 1, 2 and 3 threads, on each
SIMD target of this machine, with other tile sizes on the best target, and with optimizations
switched off. It compares depth and payload (colours, and triangle ids) of each frame bit for bit
with the reference: the first backend of `edgewise list`, on one thread, in scalar code.

Verify also compares all backends with an oracle, which computes each pixel in exact 128-bit
arithmetic. It does so on a small image, or at the size of a .tri file whose pixels times triangles
are at most 7.5 million.

Columns: triangles submitted; frames compared; pixels that differ; pixels that differ from the
oracle.
On a difference, verify writes pictures and a .tri file that reproduces it (with the same
--subpixel-bits), and exits with 1.

With --random it draws random and adversarial cases instead, until the time limit or Ctrl-C: lists
of triangles, and scenes around the camera that go through the front end. Each case is drawn on one
thread and on several, with random tile sizes, strides, alignments and optimizations switched off.
The front end is compared with its own code for single triangles. Verify describes a case's first
difference of each backend, of the front end and from the oracle, up to 20 differences in all. For
each it writes a .tri file with as few triangles as possible, unless only a scene shows it, and says
with how many --subpixel-bits to draw it. --json writes one line, and scripts/reporting/shards.py
adds lines up.

A case depends on the seed and its number alone. Case k of shard I/N is number I + k N, so shards
are disjoint. A shard draws one case at a time: run one per core. On a signal, verify writes its
results and stops; the same signal again ends it at once. Exit status: 1 if anything differs;
otherwise 0, or 128 + N if stopped by signal N.)";

}  // namespace

Action add_verify(CLI::App& command) {
  const auto o = std::make_shared<VerifyOptions>();
  command.add_option("SCENE", o->plan.scenes,
                     "Scenes of `edgewise list`, or .obj or .tri files (all built-in)");
  command.add_flag("--full", o->plan.full, "1920x1080, and streams with all their triangles");
  add_size(command, o->plan.size, "Image size (509x283; for .tri files their own)");
  command.add_flag("--fit", o->plan.fit, "Centre meshes and scale their longest side to 2");
  add_subpixel_bits(command, o->plan.subpixel_bits);
  add_text(command, "--json", "FILE", o->json,
           "Also write all results as JSON; - for stdout, instead of the table");
  add_text(command, "--out", "DIR", o->out,
           "Folder for files that show differences (edgewise-verify-failures)");
  CLI::Option* const random =
      command.add_flag("--random", o->random, "Random and adversarial cases instead of scenes");
  for (const char* of_scenes : {"SCENE", "--full", "--size", "--fit", "--subpixel-bits"})
    random->excludes(command.get_option(of_scenes));
  randomized::Plan& plan = o->random_plan;
  const auto add = [&](const char* name, const char* type, const char* help, auto parse) {
    return add_parsed(command, name, type, help, parse)->needs(random);
  };
  add("--seed", "S", "Seed of the sequence of cases (1)", [&plan](const std::string& text) {
    plan.seed = parse_number<std::uint64_t>("--seed", text, 0, ~std::uint64_t{0});
  });
  CLI::Option* const seconds =
      add("--for", "DURATION", "Time limit: 90s, 20m or 2h (until Ctrl-C)",
          [&plan](const std::string& text) { plan.seconds = parse_duration("--for", text); });
  CLI::Option* const shard = add("--shard", "I/N", "Draw every N-th case, starting at number I (0/1: all)",
                                 [&plan](const std::string& text) { plan.shard = parse_shard(text); });
  add("--case", "NUMBER", "Draw only this case",
      [&plan](const std::string& text) {
        const auto number = parse_number<std::uint64_t>("--case", text, 0, ~std::uint64_t{0} - 1);
        plan.shard = {number, number + 1};
        plan.cases = 1;
      })
      ->excludes(seconds)
      ->excludes(shard);
  command.footer(kVerifyFooter);
  return [o] { return o->random ? verify_random_command(*o) : verify_command(*o); };
}

}  // namespace edgewise::tools
