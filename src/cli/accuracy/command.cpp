// `edgewise accuracy`: counts each method's errors.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/accuracy/accuracy.h"
#include "cli/commands.h"
#include "support/console.h"
#include "support/json.h"
#include "support/options.h"
#include "support/output_path.h"
#include "support/progress.h"

namespace edgewise::tools {

namespace {

struct AccuracyOptions {
  AccuracyPlan plan;
  std::string json, pictures;
};

int accuracy_command(AccuracyOptions& o) {
  AccuracyPlan& plan = o.plan;
  plan.pictures = !o.pictures.empty();

  check_json_file(o.json, o.pictures, plan.scenes);
  if (plan.pictures) check_closeup_folder(o.pictures);
  JsonOutput json(o.json);

  Progress progress;
  plan.on_progress = [&](double fraction, std::string_view scene) { progress.show(fraction, scene); };
  const AccuracyReport report = measure_accuracy(plan);
  progress.erase();

  // At the end, so that Ctrl-C during minutes of work leaves no partial output.
  if (plan.pictures) write_closeups(o.pictures, report.closeups);
  if (!json.on_stdout()) print(accuracy_tables(report));
  if (json.wanted()) json.write(json_text(accuracy_json(report, plan), 2) + '\n');
  if (report.ok()) return kDone;
  print_error("a method broke a promise that must hold on every scene; the JSON output names it");
  return kDiffers;
}

constexpr const char* kAccuracyFooter = R"(Examples:
  edgewise accuracy --quick                  a first look
  edgewise accuracy --json accuracy.json --pictures errors
  edgewise accuracy bunny.obj capture.tri    your own files
  edgewise accuracy turning-cube drtk_quad --method float_le --method float_lt

Families: coverage, visibility, facing, clipping, projection. Coverage, visibility and facing are
compared with two exact references: one for positions snapped to 1/256 px, and the source, which is
the exact projection of the scene's own vertices, or the floats of a stream. The same holds for the
visible triangle of each pixel. Against the snapped reference, exact methods have no coverage
errors. They misjudge only faces whose first three vertices have another winding than the whole
face. Projection methods are compared with the source, and with its positions rounded exactly.

Errors are counted per 10^6 crossings of an edge with a row or column of samples, per 10^6 pixels,
or per 10^6 faces. If no error was observed, the number in parentheses is the 95 % upper bound of
the rate. Over half on: the scene that has over half of the errors. Meshes, single triangles and
scenes with vertices on our grid of 1/256 px have tables of their own.

Cracks are samples at an edge that two triangles share, drawn by neither (gap) or by both (double
hit), whatever lies behind. They share it if their vertices agree within 2^-10 px and 2^-20 of the
depth range. Cracks are judged by exact coverage of the positions that the method uses, rounded as
it rounds them, after unequal copies of a vertex are moved together. Double hits include folds,
where this rounding lets neighbours overlap. Cracks at T-junctions are counted apart. A slit is what
a viewer sees of a crack or of a seam whose sides are farther apart: background one pixel wide.

SCENE is a scene of `edgewise list`, a small test scene (the tables name them), turning-cube, choice
(whole frames, from a scene's vertices to the picture), or an .obj or .tri file. Large streams are
judged in part, always the same part, and a smaller one with --quick. The JSON gives the number of
triangles. Meshes are judged in coverage, visibility and projection, streams in coverage only.
Facing and clipping use their own scenes.
`edgewise_bench --scene SCENE --methods` times the methods.

Pictures are named FAMILY-SCENE-METHOD.png. Their colours:
  vermilion  nothing drawn where a triangle must be (coverage: a crack where triangles meet)
  blue       drawn twice, or by the wrong triangle
  yellow     missing from a triangle, but covered by another one or on the outline
  purple     drawn where no triangle must be)";

}  // namespace

Action add_accuracy(CLI::App& command) {
  const auto o = std::make_shared<AccuracyOptions>();
  command.add_option("SCENE", o->plan.scenes, "Scenes or files, see below (all scenes but quads and knots)");
  command.add_flag("--quick", o->plan.quick, "Smaller scenes, fewer frames");
  add_parsed(command, "--family", "NAME", "Only one family of methods",
             [o](const std::string& text) { o->plan.family = lab::find_family(text); });
  command.add_option("--method", o->plan.methods, "Only this method (repeatable)")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->type_name("NAME");
  command.add_flag("--peers", o->plan.peers, "Measure other projects' rasterizers in the scene choice");
  add_integer(command, "--subpixel-bits", o->plan.subpixel_bits, kMinSubpixelBits, kMaxSubpixelBits,
              "Of positions that our backends get in the coverage family (8)");
  command.add_flag("--fit", o->plan.fit, "Centre your meshes and scale their longest side to 2");
  add_text(command, "--json", "FILE", o->json,
           "Also write all results as JSON; - for stdout, instead of the tables");
  add_text(command, "--pictures", "DIR", o->pictures,
           "Folder for pictures of coverage and clipping on the small scenes");
  o->plan.threads = default_threads();
  add_integer(command, "--threads", o->plan.threads, 1, kMaxThreads,
              "Threads; results don't depend on it (usable cores)");
  command.footer(kAccuracyFooter);
  return [o] { return accuracy_command(*o); };
}

}  // namespace edgewise::tools
