#include "support/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/nearest_name.h"
#include "core/numbers.h"
#include "edgewise/contract.h"
#include "support/cores.h"

namespace edgewise::tools {

namespace {

constexpr double kMostDistance = 1e30;  // world units; bound of the near and far planes
constexpr double kLongestTime = 1e6;    // s, 11 days
constexpr double kSmallest = 1e-6;      // what "more than zero" means on the command line

[[noreturn]] void reject(std::string_view option, std::string_view text, std::string_view expected) {
  throw std::invalid_argument(fmt::format("{}: '{}' is not {}", option, text, expected));
}

SimdTarget parse_target(std::string_view text) {
  constexpr SimdTarget kTargets[] = {SimdTarget::scalar, SimdTarget::sse4, SimdTarget::avx2,
                                     SimdTarget::avx512, SimdTarget::neon, SimdTarget::best};
  return resolve(find_named("SIMD target", text, std::span<const SimdTarget>(kTargets),
                            [](SimdTarget target) { return name_of(target); }));
}

CLI::Option* add_vector(CLI::App& command, const std::string& name, std::optional<glm::dvec3>& value,
                        const std::string& help) {
  return add_parsed(command, name, "X,Y,Z", help,
                    [&value, name](const std::string& text) { value = parse_vector(name, text); });
}

bool moves_camera(const SceneOptions& o) {
  return o.eye || o.at || o.fov_deg || o.near_z || o.far_z || o.yaw_deg || o.pitch_deg;
}

void place_camera(Camera& camera, const SceneOptions& o) {
  if (o.at && (o.yaw_deg || o.pitch_deg))
    throw std::invalid_argument("--at and --yaw or --pitch exclude each other");
  const auto radians = [](double degrees) { return static_cast<float>(glm::radians(degrees)); };
  if (o.eye) camera.position = *o.eye;
  if (o.at && *o.at == camera.position)
    throw std::invalid_argument(
        "--at equals the camera position, which gives no view direction: change --eye or --at");
  if (o.at) camera.look_at(*o.at);
  if (o.yaw_deg) camera.yaw = radians(*o.yaw_deg);
  if (o.pitch_deg) camera.pitch = radians(*o.pitch_deg);
  if (o.fov_deg) camera.fov_y = radians(*o.fov_deg);
  if (o.near_z) camera.near_z = static_cast<float>(*o.near_z);
  if (o.far_z) camera.far_z = static_cast<float>(*o.far_z);
}

}  // namespace

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string unknown_option(std::string_view word, const std::vector<std::string>& known,
                           std::string_view command) {
  const std::string_view name = word.substr(0, word.find('='));
  const std::vector<std::string_view> names(known.begin(), known.end());
  const std::string nearest = name.starts_with('-') ? did_you_mean(name, names) : "";
  return fmt::format("unknown option '{}'{} ({} --help lists all)", name, nearest, command);
}

Size parse_size(std::string_view option, std::string_view text) {
  const auto cross = text.find('x');
  if (cross != std::string_view::npos) {
    const auto width = parsed<int>(text.substr(0, cross));
    const auto height = parsed<int>(text.substr(cross + 1));
    const auto fits = [](int side) { return side >= 1 && side <= contract::kMaxImageSide; };
    if (width && height && fits(*width) && fits(*height)) return {*width, *height};
  }
  reject(option, text, fmt::format("WIDTHxHEIGHT with sides of 1 to {} pixels", contract::kMaxImageSide));
}

template <typename T>
T parse_number(std::string_view option, std::string_view text, T min, T max) {
  const auto value = parsed<T>(text);
  if (value && *value >= min && *value <= max) return *value;  // not NaN
  const char* const kind = std::is_integral_v<T> ? "whole number" : "number";
  reject(option, text, fmt::format("a {} from {} to {}", kind, min, max));
}
template int parse_number(std::string_view, std::string_view, int, int);
template std::uint64_t parse_number(std::string_view, std::string_view, std::uint64_t, std::uint64_t);

double parse_duration(std::string_view option, std::string_view text) {
  constexpr std::pair<char, double> kUnits[] = {{'s', 1.0}, {'m', 60.0}, {'h', 3600.0}};
  for (const auto& [unit, seconds] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const auto value = parsed<double>(text.substr(0, text.size() - 1));
    if (value && *value > 0.0 && *value * seconds <= kLongestTime) return *value * seconds;
  }
  reject(option, text, fmt::format("a duration such as 90s, 20m or 2h, of at most {} s", kLongestTime));
}

glm::dvec3 parse_vector(std::string_view option, std::string_view text) {
  glm::dvec3 v;
  std::string_view rest = text;
  for (int i = 0; i < 3; ++i) {
    const auto comma = rest.find(',');
    const auto value = parsed<double>(rest.substr(0, comma));
    const bool last = i == 2;
    if (!value || !std::isfinite(*value) || (comma == std::string_view::npos) != last)
      reject(option, text, "X,Y,Z with finite numbers");
    v[i] = *value;
    rest.remove_prefix(last ? rest.size() : comma + 1);
  }
  return v;
}

CLI::Option* add_parsed(CLI::App& command, const std::string& name, const char* type, const std::string& help,
                        std::function<void(const std::string&)> parse) {
  return command.add_option_function<std::string>(name, std::move(parse), help)->type_name(type);
}

CLI::Option* add_text(CLI::App& command, const std::string& name, const char* type, std::string& value,
                      const std::string& help) {
  return command.add_option(name, value, help)->type_name(type);
}

CLI::Option* add_number(CLI::App& command, const std::string& name, std::optional<double>& value, double min,
                        double max, const std::string& help) {
  return add_parsed(command, name, "NUMBER", help, [&value, name, min, max](const std::string& text) {
    value = parse_number(name, text, min, max);
  });
}

CLI::Option* add_integer(CLI::App& command, const std::string& name, int& value, int min, int max,
                         const std::string& help) {
  return add_parsed(command, name, "N", help, [&value, name, min, max](const std::string& text) {
    value = parse_number(name, text, min, max);
  });
}

CLI::Option* add_size(CLI::App& command, std::optional<Size>& size, const std::string& help) {
  return add_parsed(command, "--size", "WxH", help,
                    [&size](const std::string& text) { size = parse_size("--size", text); });
}

CLI::Option* add_subpixel_bits(CLI::App& command, int& bits) {
  return add_integer(command, "--subpixel-bits", bits, kMinSubpixelBits, kMaxSubpixelBits,
                     "Round vertices to so many bits below a pixel, 4 to 15 (8)");
}

void SceneOptions::add_to(CLI::App& command) {
  add_size(command, size, "Image size (1280x720, or a .tri file's own, which other sizes crop)");
  add_number(command, "--time", time, -kLongestTime, kLongestTime, "Time of animated scenes in seconds (0)");
  add_number(command, "--scale", scale, kSmallest, kLargestScale,
             "Factor on the triangle count of knots and built-in streams (1)");
  add_parsed(command, "--cull", "MODE", "Faces to cull: none, back, front, both (back; streams: none)",
             [this](const std::string& text) {
               cull = find_named("culling mode", text, cull_modes(), [](Cull mode) { return name_of(mode); });
             });
  command.add_flag("--no-shade", no_shade, "Draw meshes unlit, as streams always are");
  command.add_flag("--fit", fit, "Centre a mesh and scale its longest side to 2");
  command.add_flag("--recentre", recentre, "Subtract a mesh file's centre from its positions, and print it");

  constexpr const char* kGroup = "Camera (meshes only)";
  add_vector(command, "--eye", eye, "Camera position")->group(kGroup);
  add_vector(command, "--at", at, "Point that the camera looks at; straight up or down sets yaw to 0")
      ->group(kGroup);
  add_number(command, "--yaw", yaw_deg, -3600, 3600, "Camera yaw to the left in degrees; 0 looks along -z")
      ->group(kGroup);
  add_number(command, "--pitch", pitch_deg, -90, 90, "Camera pitch upwards in degrees")->group(kGroup);
  add_number(command, "--fov", fov_deg, 0.1, 179, "Vertical field of view in degrees")->group(kGroup);
  add_number(command, "--near", near_z, kSmallest, kMostDistance, "Distance of the near plane")
      ->group(kGroup);
  add_number(command, "--far", far_z, kSmallest, kMostDistance, "Distance of the far plane")->group(kGroup);
}

Shot load_shot(const std::string& name_or_path, const SceneOptions& options, double time) {
  const Size size = options.size.value_or(kDefaultSize);
  const SceneRequest request{size.width, size.height, static_cast<float>(time), options.scale.value_or(1.0)};
  Shot shot{load_source(name_or_path, request, options.fit, options.recentre),
            {.width = size.width, .height = size.height}};
  Source& source = shot.source;

  if (options.recentre && (source.stream || source.built_in != nullptr))
    throw std::invalid_argument("--recentre: '" + source.name + "' is not a mesh file");
  if (options.scale && !(source.built_in != nullptr && source.built_in->scalable))
    throw std::invalid_argument("--scale: '" + source.name + "' has a fixed number of triangles");
  if (auto* stream = std::get_if<TriangleStream>(&source.drawable)) {
    if (moves_camera(options))
      throw std::invalid_argument("'" + source.name + "' is a stream of screen triangles and has no camera");
    if (!options.size) {
      shot.frontend.width = stream->width;
      shot.frontend.height = stream->height;
    }
  } else {
    place_camera(std::get<Scene>(source.drawable).camera, options);
  }
  shot.frontend.cull = options.cull.value_or(source.stream ? Cull::none : Cull::back);
  shot.frontend.shade = !source.stream && !options.no_shade;
  shot.frontend.subpixel_bits = options.subpixel_bits;
  return shot;
}

void MotionOptions::add_to(CLI::App& command) {
  constexpr int kMaxFrames = 100000;
  constexpr double kMaxFps = 1000;
  add_integer(command, "--frames", frames, 1, kMaxFrames, "Number of animation frames, from --time on (1)");
  add_number(command, "--fps", fps, 0.001, kMaxFps, "Frames per second of the animation (30)");
}

void MotionOptions::for_each_frame(const std::string& name_or_path, const SceneOptions& options,
                                   const std::function<void(Shot&, double, int)>& draw) const {
  std::optional<Shot> shot;
  for (int frame = 1; frame <= frames; ++frame) {
    const double time = options.time.value_or(0.0) + (frame - 1) / fps.value_or(30.0);
    // Files are not animated, and reading one per frame would dominate the time.
    if (!shot || shot->source.built_in != nullptr) shot = load_shot(name_or_path, options, time);
    draw(*shot, time, frame);
  }
}

int default_threads() {
  return std::min(usable_cores(), kMaxThreads);
}

void ExecutionOptions::add_to(CLI::App& command) {
  add_integer(command, "--threads", execution.threads, 1, kMaxThreads,
              "Threads, 1 to 256 (as many as usable cores)");
  add_parsed(command, "--target", "SIMD", "SIMD target: scalar, sse4, avx2, avx512, neon or best (best)",
             [this](const std::string& text) { execution.target = parse_target(text); });
  add_parsed(command, "--tile", "PX", "Tile size in pixels of the tiled backend: 16, 32 or 64 (64)",
             [this](const std::string& text) {
               const auto tile = parsed<int>(text);
               if (tile != 16 && tile != 32 && tile != 64) reject("--tile", text, "16, 32 or 64");
               execution.tile_size = *tile;
             });
}

}  // namespace edgewise::tools
