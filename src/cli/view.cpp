// `edgewise view`: shows a scene in a window or a terminal, or writes the picture after some keys.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/show.h"
#include "edgewise/contract.h"
#include "edgewise/image.h"
#include "support/console.h"
#include "support/options.h"
#include "support/printable.h"
#include "viewer/session.h"
#include "viewer/terminal.h"
#include "viewer/typing.h"
#include "viewer/window.h"

namespace edgewise::tools {

namespace {

constexpr int kMostFrames = 1'000'000;

struct ViewOptions {
  std::string scene = "cube", keys, output, folder = ".";
  lab::Choice choice = lab::our_choice("tiled");
  SceneOptions options;
  ExecutionOptions execution;
  std::optional<glm::vec3> axis;
  std::optional<Format> format;
  bool terminal = false;
  int frames = 0;
};

// `first` is the shot that view() has already loaded; it is used once, unless the size has changed meanwhile.
viewer::Session make_session(const ViewOptions& o, Shot first) {
  viewer::Start start;
  start.load = [&o, kept = std::make_shared<std::optional<Shot>>(std::move(first))](Size size) {
    SceneOptions sized = o.options;
    sized.size = size;
    const bool fits =
        *kept && ((*kept)->source.built_in == nullptr || !(*kept)->source.stream ||
                  ((*kept)->frontend.width == size.width && (*kept)->frontend.height == size.height));
    if (!fits) return load_shot(o.scene, sized, o.options.time.value_or(0.0));
    Shot shot = std::move(**kept);
    kept->reset();
    return shot;
  };
  start.choice = o.choice;
  start.execution = o.execution.execution;
  start.axis = o.axis;
  start.folder = o.folder;
  return viewer::Session(std::move(start));
}

int view(const ViewOptions& o, viewer::ShowWindow show_window) {
  const auto strokes = viewer::parse_keys(o.keys);
  std::optional<OutputFile> output;
  if (!o.output.empty()) {
    output = output_file("--output", o.output, OutputKind::picture, o.format);
    check_files({{"--output", output->path}}, {o.scene});
  }
  if (o.terminal && (!o.output.empty() || o.frames > 0))
    throw std::invalid_argument("--terminal cannot be combined with --output or --frames");
  if (!o.output.empty() && o.frames > 0)
    throw std::invalid_argument("--output and --frames exclude each other");
  if (!o.terminal && o.output.empty()) check_windows(show_window);
  // Before a window opens, so that an invalid scene is reported first.
  Shot shot = load_shot(o.scene, o.options, o.options.time.value_or(0.0));
  const Size size{shot.frontend.width, shot.frontend.height};
  viewer::Session session = make_session(o, std::move(shot));
  if (!o.terminal || !strokes.empty())
    viewer::type(session, strokes, size, viewer::font_cell(viewer::font_scale(size.height)));
  if (output) {
    std::vector<Output> files{{"--output", output->path}};
    for (const std::string& saved : session.saved()) files.push_back({"the key p", saved});
    check_files(files, {});
    write_picture(*output, session, size);
  } else if (o.terminal) {
    viewer::show_in_terminal(session);
  } else {
    const auto times = show_window(session, {"edgewise: " + printable(o.scene), size, o.frames});
    if (o.frames > 0)
      print(fmt::format("{} {}x{}, {}\n", printable(o.scene), size.width, size.height, summary(times)));
  }
  print_saved(session);
  return kDone;
}

std::string footer() {
  std::string text = R"(Examples:
  edgewise view                                        the tutorials' cube; h shows the keys
  edgewise view terrain --size 1920x1080
  edgewise view bunny.obj --fit --terminal             half-block characters, for example over ssh
  edgewise view cube --coverage float_lt --keys ve     beside the exact picture, wrong pixels tinted
  edgewise view cube --keys "bbbe<enter>" -o seen.png  the picture after these keys, no window
  edgewise view torus-knot --keys r --frames 600       frame times while the knot rotates

--keys takes characters and, in angle brackets, other keys (<tab>), methods to select (<float_lt>)
and seconds to wait (<1.5>). For example: "v<tab><float_lt><1.5>".
The program prints the names of the files that p saves. They never replace existing files.

Keys:
)";
  for (const viewer::KeyRow& row : viewer::key_table())
    text += fmt::format("  {:<16}{}\n", row.keys, row.does);
  text.pop_back();
  return text;
}

}  // namespace

void add_view(CLI::App& program, Action& action, viewer::ShowWindow show_window) {
  CLI::App& command = *program.add_subcommand("view", "Explore a scene: move, switch methods, see errors");
  const auto o = std::make_shared<ViewOptions>();
  command.add_option("SCENE", o->scene, "A scene of `edgewise list`, or an .obj or .tri file (cube)");
  command.add_flag("--terminal", o->terminal,
                   "Show it in this terminal (needs true colour) instead of a window");
  const auto add_stage = [&](const char* option, const char* help, const auto& find,
                             auto lab::Choice::*stage) {
    command
        .add_option_function<std::string>(
            option, [o, find, stage](const std::string& name) { o->choice.*stage = &find(name); }, help)
        ->type_name("NAME")
        ->group("Initial methods");
  };
  add_stage("--coverage", "Backend or coverage method (tiled)", lab::find_drawing_method,
            &lab::Choice::coverage);
  add_stage("--clipping", "Clipping method (near_guard)", lab::find_clipping_method, &lab::Choice::clipping);
  add_stage("--visibility", "Visibility method (contract31)", lab::find_visibility_method,
            &lab::Choice::visibility);
  add_stage("--facing", "Facing test (snapped_area)", lab::find_facing_method, &lab::Choice::facing);
  command
      .add_option_function<std::string>(
          "--axis",
          [o](const std::string& text) {
            const glm::dvec3 axis = parse_vector("--axis", text), size = glm::abs(axis);
            o->axis = axis / std::max({size.x, size.y, size.z, 1.0});
          },
          "Rotation axis of the objects (the first object's)")
      ->type_name("X,Y,Z");
  command.add_option("--keys", o->keys, "Keys to press at the start")->type_name("KEYS");
  command
      .add_option("-o,--output", o->output,
                  "Write the resulting picture (.png, .ppm, or -) and open no window")
      ->type_name("FILE");
  add_format(command, o->format, {Format::png, Format::ppm});
  add_integer(command, "--frames", o->frames, 1, kMostFrames,
              "Draw N frames without a frame-rate limit, print their times and quit");
  command.add_option("--save-to", o->folder, "Folder for files saved with p (.)")->type_name("DIR");
  o->options.add_to(command);
  o->execution.add_to(command);
  command.footer(footer());
  command.callback(
      [o, &action, show_window] { action = [o, show_window] { return view(*o, show_window); }; });
}

}  // namespace edgewise::tools
