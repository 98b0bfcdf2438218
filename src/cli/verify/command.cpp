// `edgewise verify`: compares all backends.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cli/commands.h"
#include "cli/verify/report.h"
#include "cli/verify/verify.h"
#include "core/atomic_file.h"
#include "support/console.h"
#include "support/json_text.h"
#include "support/output_path.h"
#include "support/progress.h"

namespace edgewise::tools {

namespace {

struct VerifyOptions {
  VerifyPlan plan;
  std::string json, out = "edgewise-verify-failures";
};

int verify_command(VerifyOptions& o) {
  VerifyPlan& plan = o.plan;
  if (plan.scenes.empty())
    for (const SceneInfo& scene : builtin_scenes()) plan.scenes.emplace_back(scene.name);
  for (const std::string& scene : plan.scenes) check_source(scene);
  plan.backends.assign(backends().begin(), backends().end());
  plan.failure_folder = o.out;

  check_json_file(o.json, o.out, plan.scenes);
  const bool json_on_stdout = o.json == "-";
  std::optional<AtomicFile> file;  // opened first, so that an unwritable path fails before minutes of work
  if (!o.json.empty() && !json_on_stdout) file.emplace(o.json);

  Progress progress;
  plan.on_progress = [&](double fraction, std::string_view scene) { progress.show(fraction, scene); };
  const VerifyTable table(terminal_width());
  const auto show = [&](const std::string& text) {
    if (json_on_stdout) return;
    progress.erase();
    print(text);
    std::fflush(stdout);
  };
  std::string header = table.header();  // printed only after the first scene was read
  const VerifyReport report = verify(plan, [&](const SceneVerdict& verdict) {
    show(std::exchange(header, {}) + table.line(verdict) + explain(verdict));
  });
  show(summary(report, plan));

  if (json_on_stdout || file) {
    const std::string text = json_text(report_json(report, plan), 2) + '\n';
    if (json_on_stdout) print(text);
    if (file) {
      file->stream() << text;
      file->commit();
    }
  }
  return report.ok() ? kDone : kDiffers;
}

constexpr const char* kVerifyFooter = R"(Examples:
  edgewise verify                              all built-in scenes, streams scaled down
  edgewise verify --full                       at 1920x1080, all triangles (long)
  edgewise verify bunny.obj capture.tri --fit  your own files
  edgewise verify --json verify.json

Verify draws every scene with every backend in every culling mode: on 1, 2 and 3 threads, on each
SIMD target of this machine, with other tile sizes on the best target, and with optimizations
switched off. It compares depth and payload (colours, and triangle ids) of each frame bit for bit
with the reference: the first backend of `edgewise list`, on one thread, in scalar code.

Verify also compares all backends with an oracle, which computes each pixel in exact 128-bit
arithmetic. It does so on a small image, or at the size of a .tri file whose pixels times triangles
are at most 7.5 million.

Columns: triangles submitted; triangles emitted by the front end, over all culling modes; frames
compared; pixels that differ; pixels that differ from the oracle.
On a difference, verify writes pictures and a .tri file that reproduces it, and exits with 1.)";

}  // namespace

void add_verify(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("verify", "Check that all backends write the same bits");
  const auto o = std::make_shared<VerifyOptions>();
  command.add_option("SCENE", o->plan.scenes,
                     "Scenes of `edgewise list`, or .obj or .tri files (all built-in)");
  command.add_flag("--full", o->plan.full, "1920x1080, and streams with all their triangles");
  add_size(command, o->plan.size, "Image size (509x283; for .tri files their own)");
  command.add_flag("--fit", o->plan.fit, "Centre meshes and scale their longest side to 2");
  command.add_option("--json", o->json, "Also write all results as JSON; - for stdout, instead of the table")
      ->type_name("FILE");
  command.add_option("--out", o->out, "Folder for pictures of differences (edgewise-verify-failures)")
      ->type_name("DIR");
  command.footer(kVerifyFooter);
  command.callback([o, &action] { action = [o] { return verify_command(*o); }; });
}

}  // namespace edgewise::tools
