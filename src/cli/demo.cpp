// `edgewise demo`: shows the tutorials as text, as pictures, as animations, or in the viewer.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/show.h"
#include "support/console.h"
#include "support/json_text.h"
#include "support/options.h"
#include "support/output_path.h"
#include "support/progress.h"
#include "viewer/demos.h"
#include "viewer/terminal.h"
#include "viewer/typing.h"

namespace edgewise::tools {

namespace {

constexpr int kMostFrames = 100000;

struct DemoOptions {
  std::vector<std::string> names;
  std::optional<std::string> output;
  std::optional<Format> format;
  int frames = 1;
  bool view = false, terminal = false, json = false;
  std::optional<Size> size;
  ExecutionOptions execution;
};

// The demos with these names; all if there are none.
nlohmann::json as_json(const std::vector<std::string>& names) {
  auto list = nlohmann::json::array();
  for (const viewer::Demo& demo : viewer::demos()) {
    if (!names.empty() && std::find(names.begin(), names.end(), demo.name) == names.end()) continue;
    auto steps = nlohmann::json::array();
    for (const viewer::Step& step : demo.steps)
      steps.push_back({{"keys", step.keys}, {"notice", step.notice}});
    list.push_back(
        {{"name", demo.name}, {"tutorial", demo.tutorial}, {"summary", demo.summary}, {"steps", steps}});
  }
  return list;
}

std::string list_of_all() {
  std::string text;
  for (const viewer::Demo& demo : viewer::demos())
    text += fmt::format("{:<20} {}\n", demo.name, demo.summary);
  return text;
}

std::string steps_of(const viewer::Demo& demo) {
  std::string text = fmt::format("{}: {}\n", demo.tutorial, demo.summary);
  for (const viewer::Step& step : demo.steps) text += fmt::format("\n{}\n    {}\n", step.notice, step.keys);
  return text;
}

viewer::Session session_of(const viewer::Demo& demo, const DemoOptions& o, bool reproducible) {
  viewer::Start start = viewer::start_of(demo);
  start.execution = o.execution.execution;
  start.reproducible = reproducible;
  return viewer::Session(std::move(start));
}

// Plays all steps and writes `o.frames` pictures at equal time intervals. The last one shows the final state.
void write_frames(const viewer::Demo& demo, const DemoOptions& o, const OutputPaths& paths,
                  Progress& progress) {
  const Size size = o.size.value_or(viewer::kDemoSize);
  viewer::Session session = session_of(demo, o, true);
  double seconds = 0;
  for (const viewer::Step& step : demo.steps) seconds += viewer::seconds_of(viewer::parse_keys(step.keys));
  int frame = 0;
  const int scale = viewer::font_scale(size.height);
  const viewer::Cell cell = viewer::font_cell(scale);
  const auto write_next = [&](viewer::Screen& screen) {
    const OutputFile file = paths.file(std::string(demo.name), ++frame);
    write_screen(file, screen, scale);
    progress.erase();
    print(listed({file.path.string()}) + "\n");
    progress.show(static_cast<double>(frame) / o.frames, demo.name);
  };
  viewer::Film film(session, size, cell, seconds / o.frames, [&](viewer::Screen& screen) {
    if (frame + 1 < o.frames) write_next(screen);
  });
  for (const viewer::Step& step : demo.steps) {
    session.say(step.notice);
    film.type(viewer::parse_keys(step.keys));
  }
  write_next(session.draw(size, cell));
}

int write_all(const DemoOptions& o) {
  const OutputPaths paths("--output", *o.output, OutputKind::picture, o.names, o.frames, o.format);
  std::vector<Output> files;
  paths.append_to(files);
  check_files(files, {});
  paths.make_folder();
  Progress progress;
  for (const std::string& name : o.names) write_frames(viewer::find_demo(name), o, paths, progress);
  return kDone;
}

int show(const viewer::Demo& demo, const DemoOptions& o, viewer::ShowWindow show_window) {
  if (!o.terminal) check_windows(show_window);
  const Size size = o.size.value_or(viewer::kDemoSize);
  viewer::Session session = session_of(demo, o, false);
  viewer::type(session, viewer::parse_keys("5"), size, viewer::font_cell(viewer::font_scale(size.height)));
  if (o.terminal) {
    viewer::show_in_terminal(session);
  } else {
    show_window(session, {fmt::format("edgewise: {}", demo.name), size});
  }
  print_saved(session);
  return kDone;
}

int demonstrate(const DemoOptions& o, viewer::ShowWindow show_window) {
  for (const std::string& name : o.names) viewer::find_demo(name);
  const bool alive = o.view || o.terminal;
  if (alive && o.output) throw std::invalid_argument("--view and --output exclude each other");
  if (o.frames > 1 && !o.output) throw std::invalid_argument("--frames needs --output");
  if (o.names.empty()) {
    if (alive || o.output) throw std::invalid_argument("no TUTORIAL is named; `edgewise demo` lists them");
    print(o.json ? json_text(as_json({}), 2) + "\n" : list_of_all());
    return kDone;
  }
  if (o.output) return write_all(o);
  if (alive && o.names.size() > 1) throw std::invalid_argument("--view shows one TUTORIAL");
  if (alive) return show(viewer::find_demo(o.names.front()), o, show_window);
  if (o.json)
    print(json_text(as_json(o.names), 2) + "\n");
  else
    for (const std::string& name : o.names) print(steps_of(viewer::find_demo(name)));
  return kDone;
}

constexpr const char* kDemoFooter = R"(Examples:
  edgewise demo                                      list all tutorials
  edgewise demo p5js-clipping                        list its steps, with explanations and keys
  edgewise demo p5js-clipping --view                 show it in a window; 5: next step, h: all keys
  edgewise demo p5js-clipping --view --terminal      show it in half-block characters, as over ssh
  edgewise demo p5js-clipping -o clipping.png        picture of the last step
  edgewise demo p5js-clipping -o film/ --frames 120  all steps (p5js-clipping-0001.png, ...)

Pictures are identical on every machine. To encode an animation as a film, run for example
  ffmpeg -framerate 20 -i film/p5js-clipping-%04d.png clipping.webm)";

}  // namespace

void add_demo(CLI::App& program, Action& action, viewer::ShowWindow show_window) {
  CLI::App& command = *program.add_subcommand("demo", "Show the tutorials that Edgewise grew from");
  const auto o = std::make_shared<DemoOptions>();
  command.add_option("TUTORIAL", o->names, "Tutorials that `edgewise demo` lists; only one with --view");
  command
      .add_option("-o,--output", o->output,
                  "Picture (.png, .ppm), folder (may be new), name with {scene}, or -")
      ->type_name("FILE");
  add_format(command, o->format, {Format::png, Format::ppm});
  add_integer(command, "--frames", o->frames, 1, kMostFrames,
              "Number of pictures, spread over all steps (1)");
  command.add_flag("--view", o->view, "Show it in a window");
  command.add_flag("--terminal", o->terminal, "Show it in this terminal (needs true colour)");
  command.add_flag("--json", o->json, "Print all tutorials and their steps as JSON");
  add_size(command, o->size, "Size of the window or pictures (960x540)");
  o->execution.add_to(command);
  command.footer(kDemoFooter);
  command.callback(
      [o, &action, show_window] { action = [o, show_window] { return demonstrate(*o, show_window); }; });
}

}  // namespace edgewise::tools
