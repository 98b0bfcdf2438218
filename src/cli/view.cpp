// `edgewise view` shows a scene in a window or a terminal, or writes the picture after some keys. `edgewise
// demo` shows the tutorials as text, as pictures, as animations, or in the viewer.
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
#include "edgewise/contract.h"
#include "edgewise/image.h"
#include "support/console.h"
#include "support/json.h"
#include "support/options.h"
#include "support/output_path.h"
#include "support/progress.h"
#include "viewer/demos.h"
#include "viewer/panel/panel.h"
#include "viewer/session.h"
#include "viewer/window.h"

namespace edgewise::tools {

namespace {

constexpr int kMostPictures = 100'000;

// Throws std::invalid_argument if this program was built without window support.
void check_windows(viewer::ShowWindow show_window) {
  if (show_window == nullptr)
    throw std::invalid_argument(
        "this program was built without SDL2 or Dear ImGui and cannot open a window: use --terminal, or "
        "install libsdl2-dev and libimgui-dev and rebuild");
}

// Prints the names of the files that the session has saved.
void print_saved(const viewer::Session& session) {
  for (const std::string& path : session.saved()) print(printable(path) + "\n");
}

// ---- view

struct ViewOptions {
  std::string scene = "cube", keys, output, folder = ".";
  lab::StageMethods choice = lab::our_choice("tiled");
  SceneOptions options;
  ExecutionOptions execution;
  std::optional<glm::vec3> axis;
  std::optional<Format> format;
  bool terminal = false;
};

// Only built-in streams are loaded again, at every size: they fill the picture.
viewer::Session make_session(const ViewOptions& o, Shot first) {
  viewer::Start start;
  start.load = [&o, first = std::make_shared<Shot>(std::move(first))](Size size) {
    if (!first->source.stream || first->source.built_in == nullptr) return std::move(*first);
    SceneOptions sized = o.options;
    sized.size = size;
    return load_shot(o.scene, sized, o.options.time.value_or(0.0));
  };
  start.choice = o.choice;
  start.execution = o.execution.execution;
  start.axis = o.axis;
  start.folder = o.folder;
  start.reproducible = !o.output.empty();
  return viewer::Session(std::move(start));
}

int view(const ViewOptions& o, viewer::ShowWindow show_window) {
  const auto strokes = viewer::parse_keys(o.keys);
  std::optional<OutputFile> output;
  if (!o.output.empty()) {
    output = output_file("--output", o.output, OutputKind::picture, o.format);
    check_files({{"--output", output->path}}, {o.scene});
  }
  if (o.terminal && !o.output.empty())
    throw std::invalid_argument("--terminal and --output cannot be combined");
  if (!o.terminal && o.output.empty()) check_windows(show_window);
  // Before a window opens, so that an invalid scene is reported first.
  Shot shot = load_shot(o.scene, o.options, o.options.time.value_or(0.0));
  const Size size{shot.frontend.width, shot.frontend.height};
  viewer::Panel panel;
  viewer::Session session = make_session(o, std::move(shot));
  if (!o.terminal || !strokes.empty()) {
    session.draw(size, o.terminal ? 0 : panel.width_px(size));
    session.type(strokes);
  }
  if (output) {
    std::vector<Output> files{{"--output", output->path}};
    for (const std::string& saved : session.saved()) files.push_back({"the key p", saved});
    check_files(files, {});
    write_image(output->path, panel.show(session, size), output->format);
  } else if (o.terminal) {
    viewer::show_in_terminal(session);
  } else {
    show_window(session, "edgewise: " + printable(o.scene), size);
  }
  print_saved(session);
  return kDone;
}

std::string view_footer() {
  std::string text = R"(Examples:
  edgewise view                                        the tutorials' cube; h shows the keys
  edgewise view terrain --size 1920x1080
  edgewise view bunny.obj --fit --terminal             half-block characters, for example over ssh
  edgewise view cube --coverage float_lt --keys ve     beside the exact picture, wrong pixels tinted
  edgewise view cube --keys "bbbe<enter>" -o seen.png  the picture after these keys, no window

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

// ---- demo

struct DemoOptions {
  std::vector<std::string> names;
  std::optional<std::string> output;
  std::optional<Format> format;
  int frames = 1;
  bool view = false, terminal = false, json = false;
  std::optional<Size> size;
  ExecutionOptions execution;
};

nlohmann::json as_json(const std::vector<viewer::Demo>& demos) {
  auto list = nlohmann::json::array();
  for (const viewer::Demo& demo : demos) {
    auto steps = nlohmann::json::array();
    for (const viewer::Step& step : demo.steps)
      steps.push_back({{"keys", step.keys}, {"notice", step.notice}});
    list.push_back(
        {{"name", demo.name}, {"tutorial", demo.tutorial}, {"summary", demo.summary}, {"steps", steps}});
  }
  return list;
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

// By default, the panel stands beside a picture of kDemoSize.
Size size_of(const DemoOptions& o, const viewer::Panel& panel) {
  const auto [width, height] = viewer::kDemoSize;
  return o.size.value_or(Size{width + panel.width_px({2 * width, height}), height});
}

// Plays all steps and writes `o.frames` pictures at equal time intervals. The last one shows the final state.
void write_frames(const viewer::Demo& demo, const DemoOptions& o, const OutputPaths& paths,
                  Progress& progress) {
  viewer::Panel panel;
  const Size size = size_of(o, panel);
  viewer::Session session = session_of(demo, o, true);
  session.draw(size, panel.width_px(size));
  double seconds = 0;
  for (const viewer::Step& step : demo.steps)
    for (const viewer::Stroke& stroke : viewer::parse_keys(step.keys)) seconds += viewer::seconds_of(stroke);
  int frame = 0;
  const auto write_next = [&] {
    const OutputFile file = paths.file(std::string(demo.name), ++frame);
    write_image(file.path, panel.show(session, size), file.format);
    progress.erase();
    print(listed({file.path.string()}) + "\n");
    progress.show(static_cast<double>(frame) / o.frames, demo.name);
  };
  constexpr double kRounding_s = 1e-9;  // of sums of 0.1 s
  const double frame_s = seconds / o.frames;
  double to_next_s = frame_s;
  const auto pass = [&](double stroke_s) {
    for (; to_next_s <= stroke_s + kRounding_s; to_next_s = frame_s) {
      session.advance(to_next_s);
      stroke_s -= to_next_s;
      if (frame + 1 < o.frames) write_next();
    }
    stroke_s = std::max(stroke_s, 0.0);
    session.advance(stroke_s);
    to_next_s -= stroke_s;
  };
  for (std::size_t i = 0; i < demo.steps.size(); ++i) {
    session.show_step(i);
    session.type(viewer::parse_keys(demo.steps[i].keys), pass);
  }
  write_next();
}

int write_all(const std::vector<viewer::Demo>& demos, const DemoOptions& o) {
  const OutputPaths paths("--output", *o.output, OutputKind::picture, o.names, o.frames, o.format);
  std::vector<Output> files;
  paths.append_to(files);
  check_files(files, {});
  paths.make_folder();
  Progress progress;
  for (const viewer::Demo& demo : demos) write_frames(demo, o, paths, progress);
  return kDone;
}

int show(const viewer::Demo& demo, const DemoOptions& o, viewer::ShowWindow show_window) {
  if (!o.terminal) check_windows(show_window);
  viewer::Panel panel;
  const Size size = size_of(o, panel);
  viewer::Session session = session_of(demo, o, false);
  session.draw(size, o.terminal ? 0 : panel.width_px(size));
  session.take_step(0);
  if (o.terminal) {
    viewer::show_in_terminal(session);
  } else {
    show_window(session, fmt::format("edgewise: {}", demo.name), size);
  }
  print_saved(session);
  return kDone;
}

int demonstrate(const DemoOptions& o, viewer::ShowWindow show_window) {
  std::vector<viewer::Demo> demos;
  for (const std::string& name : o.names) demos.push_back(viewer::find_demo(name));
  const bool alive = o.view || o.terminal;
  if (alive && o.output) throw std::invalid_argument("--view and --output exclude each other");
  if (o.frames > 1 && !o.output) throw std::invalid_argument("--frames needs --output");
  if (demos.empty() && (alive || o.output))
    throw std::invalid_argument("no TUTORIAL is named; `edgewise demo` lists them");
  if (o.output) return write_all(demos, o);
  if (alive && demos.size() > 1) throw std::invalid_argument("--view shows one TUTORIAL");
  if (alive) return show(demos.front(), o, show_window);
  const bool all = demos.empty();
  if (all) demos.assign(viewer::demos().begin(), viewer::demos().end());
  if (o.json) print(json_text(as_json(demos), 2) + "\n");
  for (const viewer::Demo& demo : demos)
    if (!o.json) print(all ? fmt::format("{:<20} {}\n", demo.name, demo.summary) : steps_of(demo));
  return kDone;
}

constexpr const char* kDemoFooter = R"(Examples:
  edgewise demo                                      list all tutorials
  edgewise demo p5js-clipping                        list its steps, with explanations and keys
  edgewise demo p5js-clipping --view                 show it in a window, with its steps in a panel
  edgewise demo p5js-clipping --view --terminal      show it in half-block characters, as over ssh
  edgewise demo p5js-clipping -o clipping.png        picture of the last step
  edgewise demo p5js-clipping -o film/ --frames 120  all steps (p5js-clipping-0001.png, ...)

Pictures are identical on every machine. To encode an animation as a film, run for example
  ffmpeg -framerate 20 -i film/p5js-clipping-%04d.png clipping.webm)";

}  // namespace

Action add_view(CLI::App& command, viewer::ShowWindow show_window) {
  const auto o = std::make_shared<ViewOptions>();
  command.add_option("SCENE", o->scene, "A scene of `edgewise list`, or an .obj or .tri file (cube)");
  command.add_flag("--terminal", o->terminal,
                   "Show it in this terminal (needs true colour) instead of a window");
  const auto add_stage = [&](const char* option, const char* help, const auto& find,
                             auto lab::StageMethods::*stage) {
    add_parsed(command, option, "NAME", help, [o, find, stage](const std::string& name) {
      o->choice.*stage = &find(name);
    })->group("Initial methods");
  };
  add_stage("--coverage", "Backend or coverage method (tiled)", lab::find_drawing_method,
            &lab::StageMethods::coverage);
  add_stage("--clipping", "Clipping method (near_guard)", lab::find_clipping_method,
            &lab::StageMethods::clipping);
  add_stage("--visibility", "Visibility method (contract31)", lab::find_visibility_method,
            &lab::StageMethods::visibility);
  add_stage("--facing", "Facing test (snapped_area)", lab::find_facing_method, &lab::StageMethods::facing);
  add_parsed(command, "--axis", "X,Y,Z", "Rotation axis of the objects (the first object's)",
             [o](const std::string& text) {
               const glm::dvec3 axis = parse_vector("--axis", text), size = glm::abs(axis);
               o->axis = axis / std::max({size.x, size.y, size.z, 1.0});
             });
  add_text(command, "--keys", "KEYS", o->keys, "Keys to press at the start");
  add_text(command, "-o,--output", "FILE", o->output,
           "Write the picture (.png, .ppm, or -), without times; open no window");
  add_format(command, o->format, {Format::png, Format::ppm});
  add_text(command, "--save-to", "DIR", o->folder, "Folder for files saved with p (.)");
  o->options.add_to(command);
  add_subpixel_bits(command, o->options.subpixel_bits);
  o->execution.add_to(command);
  command.footer(view_footer());
  return [o, show_window] { return view(*o, show_window); };
}

Action add_demo(CLI::App& command, viewer::ShowWindow show_window) {
  const auto o = std::make_shared<DemoOptions>();
  command.add_option("TUTORIAL", o->names, "Tutorials that `edgewise demo` lists; only one with --view");
  command
      .add_option("-o,--output", o->output,
                  "Picture (.png, .ppm), folder (may be new), name with {scene}, or -")
      ->type_name("FILE");
  add_format(command, o->format, {Format::png, Format::ppm});
  add_integer(command, "--frames", o->frames, 1, kMostPictures,
              "Number of pictures, spread over all steps (1)");
  command.add_flag("--view", o->view, "Show it in a window");
  command.add_flag("--terminal", o->terminal, "Show it in this terminal (needs true colour)");
  command.add_flag("--json", o->json, "Print all tutorials and their steps as JSON");
  add_size(command, o->size, "Size of the window or pictures (a picture of 960x540 and the panel)");
  o->execution.add_to(command);
  command.footer(kDemoFooter);
  return [o, show_window] { return demonstrate(*o, show_window); };
}

}  // namespace edgewise::tools
