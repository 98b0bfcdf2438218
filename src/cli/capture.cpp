// `edgewise capture`: writes the front end's output, the input of a backend, as a .tri stream.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>

#include "cli/basic/describe.h"
#include "cli/commands.h"
#include "core/input_file.h"
#include "edgewise/tri_file.h"
#include "files/atomic_file.h"
#include "lab/cases/to_stream.h"
#include "support/console.h"
#include "support/options.h"
#include "support/output_path.h"

namespace edgewise::tools {

namespace {

struct CaptureOptions {
  std::string scene, output;
  SceneOptions options;
};

int capture(const CaptureOptions& o) {
  const bool on_stdout = o.output == "-";
  if (!on_stdout && extension_of(o.output) != ".tri")
    throw std::invalid_argument("--output " + o.output + ": the name must end in .tri");
  const std::string output = on_stdout ? "/dev/stdout" : o.output;
  if (on_stdout) print_to_stderr();
  check_files({{"--output", output}}, {o.scene});
  const Shot shot = load_shot(o.scene, o.options, o.options.time.value_or(0.0));
  Frontend frontend;
  const auto triangles = frontend.run(shot.source.drawable, shot.frontend);

  AtomicFile file(output);
  write_tri(file.stream(), lab::to_stream(triangles, shot.frontend.width, shot.frontend.height));
  file.commit();
  print(fmt::format("{} ({}x{}): {}\n  -> {}\n", printable(shot.source.name), shot.frontend.width,
                    shot.frontend.height, stats_text(frontend.stats()), listed({output})));
  return kDone;
}

constexpr const char* kCaptureFooter = R"(Examples:
  edgewise capture terrain --size 1920x1080 -o terrain.tri
  edgewise render terrain.tri -o terrain.png           (the same coverage; depths rounded to floats)
  edgewise verify terrain.tri

The stream holds the triangles that remain after transformation, clipping, culling and shading. The
file is little-endian: "TRI1", uint32 width, height, count; then for each triangle nine float32
(x, y, z of three vertices: pixels, y down, z in [0, 1], smaller is nearer) and a uint32 colour, R
in the lowest byte. Where floats would round a position, as with 15 subpixel bits beyond 512 pixels,
the file starts with "TRI2" and has nine float64 instead. Draw it with the same --subpixel-bits.)";

}  // namespace

Action add_capture(CLI::App& command) {
  const auto o = std::make_shared<CaptureOptions>();
  command.add_option("SCENE", o->scene, "A scene of `edgewise list`, or an .obj or .tri file")->required();
  add_text(command, "-o,--output", "FILE", o->output, "Stream file, .tri; - for stdout")->required();
  o->options.add_to(command);
  add_subpixel_bits(command, o->options.subpixel_bits);
  command.footer(kCaptureFooter);
  return [o] { return capture(*o); };
}

}  // namespace edgewise::tools
