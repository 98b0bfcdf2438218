// `edgewise needs`: the least precise pipelines that still draw a scene right.
#include "lab/needs/needs.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cli/commands.h"
#include "core/trigonometry.h"
#include "support/console.h"
#include "support/json.h"
#include "support/options.h"
#include "support/progress.h"

namespace edgewise::tools {

namespace {

constexpr int kEdgeBits[] = {4, 5, 6, 7, 8};
constexpr double kSeconds = 10.0;  // over which --frames are spread
constexpr int kMostStudiedFrames = 100'000;
constexpr int kMostTolerated = 1'000'000'000;

struct NeedsCommandOptions {
  std::vector<std::string> scenes;
  SceneOptions scene;
  int frames = 1, orbit = 0, tolerance = 0, threads = default_threads();
  std::optional<double> displacement;
  bool json = false;
};

glm::dvec3 centre_of(const Scene& scene) {
  const auto [low, high] = bounds_of(scene);
  return low + 0.5 * (high - low);
}

// Moves the camera along a circle about the vertical axis through `centre`, which it looks at. A camera on
// that axis turns by yaw.
void turn_camera(Camera& camera, glm::dvec3 centre, double radians) {
  const glm::dvec3 from = camera.position - centre;
  const double c = cosine(radians), s = sine(radians);
  camera.position = centre + glm::dvec3(c * from.x + s * from.z, from.y, c * from.z - s * from.x);
  camera.look_at(centre);
  if (from.x == 0.0 && from.z == 0.0) camera.yaw = static_cast<float>(radians);
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

// Breaks text into lines of at most 78 characters.
std::string indented(const std::string& text) {
  constexpr std::size_t kWidth = 74;
  std::string result, rest = text;
  while (rest.size() > kWidth) {
    std::size_t space = rest.rfind(' ', kWidth);
    if (space == std::string::npos) space = rest.find(' ');
    if (space == std::string::npos) break;
    result += "    " + rest.substr(0, space) + "\n";
    rest.erase(0, space + 1);
  }
  return result + "    " + rest + "\n";
}

std::string line(std::string_view question, std::string_view answer) {
  return answer.empty() ? fmt::format("  {}\n", question) : fmt::format("  {:<35} {}\n", question, answer);
}

std::string text_of(const lab::Question& question) {
  const lab::Answer* const needed = question.needed();
  std::string text = line(question.name, needed == nullptr ? "none is enough" : needed->name);
  if (!question.proof.empty())
    text += indented("proven: " + question.proof);
  else if (needed != nullptr)
    text += indented("seen in " + counted(question.trials, question.trial));
  return text;
}

std::string text_of(const lab::Levels& pipeline) {
  std::vector<std::string> levels;
  for (const auto& [stage, level] : pipeline)
    if (level != "nothing") levels.push_back(stage + " " + level);
  return indented(fmt::format("{}", fmt::join(levels, ", ")));
}

std::string text_of(const lab::Minima& minima, std::uint64_t tolerance_px) {
  const std::string most = counted(tolerance_px, "wrong pixel");
  if (minima.right.empty())
    return fmt::format("no pipeline of {} has at most {} in each frame\n  the closest has {}\n",
                       minima.judged, most, minima.closest_px) +
           text_of(minima.closest);
  std::string text =
      fmt::format("least precise of {} pipelines, at most {} in each frame\n", minima.judged, most);
  for (const lab::Levels& pipeline : minima.right) text += text_of(pipeline);
  return text;
}

std::string text_of(const lab::Curve& curve, std::uint64_t frames) {
  const std::string stage = name_of(curve.stage);
  if (!curve.proof.empty() && curve.levels.front().wrong_px == curve.levels.back().wrong_px)
    return line(stage, curve.levels.front().name) + indented("proven: " + curve.proof);
  std::string text = line(stage, "");
  const auto mean = [&](std::uint64_t px) { return static_cast<double>(px) / static_cast<double>(frames); };
  for (std::size_t i = 0, end; i < curve.levels.size(); i = end) {
    const lab::Level& level = curve.levels[i];
    const auto goes_on = [&](const lab::Level& next) {
      return next.name.ends_with("bits") && next.wrong_px == level.wrong_px &&
             next.worst_px == level.worst_px && next.hidden_px == level.hidden_px &&
             next.farthest_squared_px == level.farthest_squared_px;
    };
    for (end = i + 1; end < curve.levels.size() && goes_on(curve.levels[end]);) ++end;
    const std::string name = level.name + (end > i + 1 ? " to " + curve.levels[end - 1].name : "");
    text += fmt::format("    {:<22}{:>11.1f}{:>9}{:>11.1f}{:>11.1f}{}\n", name, mean(level.wrong_px),
                        level.worst_px, mean(level.hidden_px), level.farthest_px(),
                        level.enough() ? "  enough" : "");
  }
  return text;
}

// How depth buffers are called by graphics interfaces, and as levels.
constexpr std::pair<const char*, const char*> kDepthFormats[] = {{"D16", "16 bits"},
                                                                 {"D24", "24 bits"},
                                                                 {"D32F", "float_z"},
                                                                 {"reversed D32F", "reversed_z"},
                                                                 {"ours", "contract31"}};

std::string depth_formats(const std::vector<lab::Curve>& curves, const lab::Ranges& ranges) {
  const lab::Curve& depths = *std::ranges::find(curves, lab::kDepth, &lab::Curve::stage);
  std::vector<std::string> formats;
  for (const auto& [format, name] : kDepthFormats) {
    const lab::Level& level = *std::ranges::find(depths.levels, name, &lab::Level::name);
    formats.push_back(
        fmt::format("{} {}", format, level.enough() ? "is enough" : counted(level.worst_px, "wrong pixel")));
  }
  const std::string planes =
      ranges.far_z() == 0.0 ? "" : fmt::format(", near {:.4g}, far {:.4g}", ranges.near_z(), ranges.far_z());
  return line("depth formats" + planes, "") + indented(fmt::format("{}", fmt::join(formats, ", ")));
}

std::string edge_integers(const lab::Ranges& ranges, double aspect) {
  std::string text = fmt::format("  {:<19}{:>14}{:>18}{:>25}\n", "integers of edges", "these need",
                                 "legs in 32, 64", "picture in 32");
  for (const int bits : kEdgeBits) {
    const double in_32 = lab::largest_box_px2(32, bits), in_64 = lab::largest_box_px2(64, bits);
    const std::string picture = fmt::format("{:.0f}x{:.0f} px", std::floor(std::sqrt(in_32 * aspect)),
                                            std::floor(std::sqrt(in_32 / aspect)));
    text += fmt::format("    {:<17}{:>11} bits{:>10.0f}, {:<10.0f}px{:>19}\n",
                        fmt::format("{} subpixel bits", bits), ranges.edge_value_bits(bits),
                        std::floor(std::sqrt(in_32)), std::floor(std::sqrt(in_64)), picture);
  }
  return text;
}

nlohmann::json json_of(const lab::Witness& w) {
  return {{"frame", w.frame}, {"x_px", w.x_px}, {"y_px", w.y_px}, {"right", w.right}, {"drawn", w.drawn}};
}

nlohmann::json json_of(const lab::Question& question) {
  nlohmann::json json{{"question", question.name},
                      {"answer", nullptr},
                      {"proven", !question.proof.empty()},
                      {"error", question.error}};
  if (question.needed() != nullptr) json["answer"] = question.needed()->name;
  if (question.proof.empty())
    json["trials"] = {{"count", question.trials}, {"of", question.trial}};
  else
    json["proof"] = question.proof;
  for (const lab::Answer& answer : question.answers) {
    nlohmann::json entry{{"answer", answer.name}, {"enough", answer.enough()}};
    if (answer.witness) {
      entry["witness"] = json_of(*answer.witness);
      entry["witness"]["wrong_px"] = answer.wrong_px;
    }
    json["answers"].push_back(std::move(entry));
  }
  return json;
}

nlohmann::json json_of(const lab::Curve& curve, std::uint64_t frames) {
  nlohmann::json json{{"stage", name_of(curve.stage)}};
  if (!curve.proof.empty()) json["proof"] = curve.proof;
  for (const lab::Level& level : curve.levels) {
    nlohmann::json entry{{"level", level.name},
                         {"enough", level.enough()},
                         {"mean_px", static_cast<double>(level.wrong_px) / static_cast<double>(frames)},
                         {"worst_px", level.worst_px},
                         {"hidden_px", static_cast<double>(level.hidden_px) / static_cast<double>(frames)},
                         {"farthest_px", level.farthest_px()}};
    if (level.witness) entry["witness"] = json_of(*level.witness);
    json["levels"].push_back(std::move(entry));
  }
  return json;
}

class NeedsCommand {
 public:
  explicit NeedsCommand(const NeedsCommandOptions& options) : options_(options) {
    if (options.orbit > 0 && options.frames > 1)
      throw std::invalid_argument("--frames and --orbit cannot be combined");
    if (options.orbit > 0 && (options.scene.at || options.scene.yaw_deg || options.scene.pitch_deg))
      throw std::invalid_argument(
          "--orbit looks at the scene's centre: --at, --yaw and --pitch cannot be given");
    for (const std::string& scene : options.scenes) {
      check_source(scene);
      const std::string name = source_name(scene);
      const bool stream = is_file_path(scene) ? is_stream_file(scene) : find_scene(scene).stream;
      if (options.orbit > 0 && stream)
        throw std::invalid_argument("--orbit: '" + name + "' is a stream of triangles and has no camera");
      if (options.frames > 1 && is_file_path(scene))
        throw std::invalid_argument("--frames: '" + name + "' does not move" +
                                    (stream ? "" : "; use --orbit"));
    }
  }

  void run() {
    for (const std::string& scene : options_.scenes) study(scene);
  }

 private:
  // Calls visit(shot) for each frame, the first one of which is given.
  template <typename Visit>
  void for_each_frame(const std::string& scene, const Shot& first, Visit&& visit) const {
    visit(first);
    if (options_.orbit > 0) {
      Shot shot = first;
      Camera& camera = std::get<Scene>(shot.source.drawable).camera;
      const Camera start = camera;
      const glm::dvec3 centre = centre_of(std::get<Scene>(shot.source.drawable));
      constexpr double kTurn = 6.283185307179586;
      for (int frame = 1; frame < options_.orbit; ++frame) {
        camera = start;
        turn_camera(camera, centre, kTurn * frame / options_.orbit);
        visit(shot);
      }
    }
    for (int frame = 1; frame < options_.frames; ++frame) visit(load(scene, frame));
  }

  Shot load(const std::string& scene, int frame) const {
    const double passed = kSeconds * frame / options_.frames;
    return load_shot(scene, options_.scene, options_.scene.time.value_or(0.0) + passed);
  }

  Shot load_first(const std::string& scene) const {
    Shot shot = load(scene, 0);
    if (options_.orbit == 0) return shot;
    auto& loaded = std::get<Scene>(shot.source.drawable);
    const glm::dvec3 centre = centre_of(loaded);
    if (loaded.camera.position == centre)
      throw std::invalid_argument("--orbit: the camera is at the centre of '" + shot.source.name + "'");
    turn_camera(loaded.camera, centre, 0.0);
    return shot;
  }

  void study(const std::string& scene) {
    const Shot first = load_first(scene);
    lab::Needs needs(
        {.tolerance_px = tolerance_px(), .displacement = options_.displacement, .threads = options_.threads});
    Progress progress;
    const double steps = std::max(options_.frames, options_.orbit);
    double done = 0.0;
    const auto show = [&] { progress.show(done / steps, first.source.name); };
    show();
    for_each_frame(scene, first, [&](const Shot& shot) {
      needs.add(shot.source.drawable, shot.frontend);
      ++done, show();
    });
    const lab::Minima minima =
        needs.minima([&](double share) { progress.show(share, first.source.name + ", whole pipelines"); });
    progress.erase();
    print(options_.json ? json_text(json(first, needs, minima)) + "\n" : table(first, needs, minima));
  }

  std::uint64_t tolerance_px() const { return static_cast<std::uint64_t>(options_.tolerance); }

  std::string table(const Shot& shot, const lab::Needs& needs, const lab::Minima& minima) const {
    std::string text = fmt::format("{}: {}x{} px, {}\n", printable(shot.source.name), shot.frontend.width,
                                   shot.frontend.height, counted(needs.frames(), "frame"));
    text += text_of(minima, tolerance_px());
    text += fmt::format("{:<26}{:>11}{:>9}{:>11}{:>11}\n", "wrong px, all else ours", "mean", "worst",
                        "hidden", "farthest");
    const auto curves = needs.curves();
    for (const lab::Curve& curve : curves) text += text_of(curve, needs.frames());
    const double aspect = double(shot.frontend.width) / shot.frontend.height;
    text += depth_formats(curves, needs.ranges()) + edge_integers(needs.ranges(), aspect);
    for (const lab::Question& question : needs.edges()) text += text_of(question);
    return text;
  }

  nlohmann::json json(const Shot& shot, const lab::Needs& needs, const lab::Minima& minima) const {
    nlohmann::json result{{"scene", shot.source.name},      {"width", shot.frontend.width},
                          {"height", shot.frontend.height}, {"scale", options_.scene.scale.value_or(1.0)},
                          {"frames", needs.frames()},       {"tolerance_px", options_.tolerance},
                          {"pipelines", minima.judged},     {"minima", minima.right}};
    if (!shot.source.stream)
      result["near_z"] = needs.ranges().near_z(), result["far_z"] = needs.ranges().far_z();
    if (minima.right.empty())
      result["closest"] = {{"levels", minima.closest}, {"worst_px", minima.closest_px}};
    for (const lab::Curve& curve : needs.curves()) result["curves"].push_back(json_of(curve, needs.frames()));
    for (const lab::Question& question : needs.edges()) result["edges"].push_back(json_of(question));
    return result;
  }

  const NeedsCommandOptions& options_;
};

constexpr const char* kNeedsFooter = R"(Examples:
  edgewise needs cube --frames 24
  edgewise needs bunny.obj --fit --orbit 36 --tolerance 20
  edgewise needs capture.tri
  edgewise needs terrain --displacement 100 --json

Prints the least precise pipelines that draw all these frames right, drawn as a whole: stages that
are enough alone may draw wrong pixels together. A pixel is wrong if it shows another triangle than
the exact picture of the scene's own vertices. A pipeline is right if no frame has more wrong
pixels than --tolerance. All pipelines are judged; one is least precise if no weaker one is right:
no facing test is weaker than each test, submission order than each painter's algorithm, these than
a depth buffer, and fewer bits than more. If none is right, the closest one is printed: the one
whose worst frame has the fewest wrong pixels. Less precise is not faster: only the benchmark
measures that.

Then the wrong pixels of each level while all else is as ours, with 8 bits, per frame:

  mean, worst   of all frames, and of the worst one
  hidden        the mean of those that show a triangle that the exact picture lacks
  farthest      of the others, in px: from such a pixel to the nearest one at which the exact
                picture shows the same

Levels, from the least precise on:

  near, far plane, guard band  what to do with triangles beyond it: nothing, drop or clip them;
                               "proven" follows from the ranges of the vertices
  facing test                  none, by three normals, by the area in floats, by the snapped area
  subpixel bits                0 to 8 bits, of the snapped vertices
  visibility                   submission order, the painter's algorithm by two sorts, depth buffer
  depth buffer                 1 to 30 bits, then ours of 31 bits, a float, a reversed float; only
                               nearer pixels pass

Then:

  depth formats                which of D16, D24, D32F, reversed D32F and ours are enough
  integers of edges            the bits, with the sign, that these triangles need; and the largest
                               triangle and picture for integers of 32 and 64 bits
  subpixel bits                so many that no larger number leaves a crack; so many that none
                               displaces more pixels than 8 bits do
  float edges                  methods that compute edges in floats, without a crack

All figures are of these frames only. --json has a wrong pixel of each level that is not enough, and
the triangles there, numbered in submission order from 0.

Exit status: 0 done, 2 bad input.)";

}  // namespace

Action add_needs(CLI::App& command) {
  const auto o = std::make_shared<NeedsCommandOptions>();
  command.add_option("SCENE", o->scenes, "Scenes of `edgewise list`, or .obj or .tri files")->required();
  add_integer(command, "--frames", o->frames, 1, kMostStudiedFrames,
              "Frames of a built-in scene's motion, over 10 s (1)");
  add_integer(command, "--orbit", o->orbit, 1, kMostStudiedFrames,
              "Frames of a camera that circles the scene, or spins straight above it");
  add_integer(command, "--tolerance", o->tolerance, 0, kMostTolerated,
              "Wrong pixels in each frame of a right pipeline (0)");
  add_number(command, "--displacement", o->displacement, 0, 1e6,
             "Pixels per 10^6 edge crossings that rounding may move (as with 8 bits)");
  o->scene.add_to(command);
  add_integer(command, "--threads", o->threads, 1, kMaxThreads,
              "Threads; answers don't depend on it (usable cores)");
  command.add_flag("--json", o->json, "Print one JSON object per scene, one per line");
  command.footer(kNeedsFooter);
  return [o] {
    NeedsCommand(*o).run();
    return kDone;
  };
}

}  // namespace edgewise::tools
