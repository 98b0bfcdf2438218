// Options shared by several subcommands, and their parsers. All parsers throw std::invalid_argument with one
// line that names the option, the text and the expected form.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/frontend.h"
#include "support/source.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace edgewise::tools {

struct Size {
  int width, height;  // px
};
inline constexpr Size kDefaultSize{1280, 720};
inline constexpr double kLargestScale = 1e3;  // of --scale

// The names of all options of a command, with dashes.
std::vector<std::string> option_names(const CLI::App& command);

// "unknown option 'WORD'; did you mean 'NEAREST'? (COMMAND --help lists all)". A value after "=" is ignored.
std::string unknown_option(std::string_view word, const std::vector<std::string>& known,
                           std::string_view command);

Size parse_size(std::string_view option, std::string_view text);
template <typename T>  // int or std::uint64_t
T parse_number(std::string_view option, std::string_view text, T min, T max);
double parse_duration(std::string_view option, std::string_view text);  // "90s", "20m", "2h" → s
glm::dvec3 parse_vector(std::string_view option, std::string_view text);

// Adds an option whose text `parse` takes.
CLI::Option* add_parsed(CLI::App& command, const std::string& name, const char* type, const std::string& help,
                        std::function<void(const std::string&)> parse);
CLI::Option* add_text(CLI::App& command, const std::string& name, const char* type, std::string& value,
                      const std::string& help);
CLI::Option* add_number(CLI::App& command, const std::string& name, std::optional<double>& value, double min,
                        double max, const std::string& help);
CLI::Option* add_integer(CLI::App& command, const std::string& name, int& value, int min, int max,
                         const std::string& help);
CLI::Option* add_size(CLI::App& command, std::optional<Size>& size, const std::string& help);
CLI::Option* add_subpixel_bits(CLI::App& command, int& bits);

// Options for the scene: size, time, camera, and the front end's work on it.
struct SceneOptions {
  std::optional<Size> size;
  std::optional<double> time, scale;  // s; factor
  std::optional<glm::dvec3> eye, at;
  std::optional<double> fov_deg, near_z, far_z, yaw_deg, pitch_deg;
  std::optional<Cull> cull;  // not given: back for meshes, none for streams
  bool fit = false, recentre = false, no_shade = false;
  int subpixel_bits = FrontendOptions().subpixel_bits;  // add_subpixel_bits() adds its option

  void add_to(CLI::App& command);
};

// A loaded scene with its camera set by the options, and the front end's options for it.
struct Shot {
  Source source;
  FrontendOptions frontend;
};
Shot load_shot(const std::string& name_or_path, const SceneOptions& options, double time);

// Options for the frames of an animation.
struct MotionOptions {
  int frames = 1;
  std::optional<double> fps;

  void add_to(CLI::App& command);
  // Calls draw(shot, time in s, frame) for frame 1 … `frames`.
  void for_each_frame(const std::string& name_or_path, const SceneOptions& options,
                      const std::function<void(Shot&, double, int)>& draw) const;
};

int default_threads();  // the number of usable cores; 1 … kMaxThreads

// Options for drawing: threads, SIMD target, tile size.
struct ExecutionOptions {
  Execution execution{.threads = default_threads()};

  void add_to(CLI::App& command);
};

}  // namespace edgewise::tools
