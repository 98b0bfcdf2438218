// Options that several subcommands share, and the one place where their text is judged. All parsers throw
// std::invalid_argument with a line that names the option, the text and what would have been right.
#pragma once

#include <cstdint>
#include <filesystem>
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

namespace edgewise::app {

struct Size {
  int width, height;  // px
};
inline constexpr Size kDefaultSize{1280, 720};

// All names of a command's options, with their dashes.
std::vector<std::string> option_names(const CLI::App& command);

// "unknown option 'WORD'; did you mean 'NEAREST'? (COMMAND --help lists all)". A value after "=" is ignored.
std::string unknown_option(std::string_view word, const std::vector<std::string>& known,
                           std::string_view command);

Size parse_size(std::string_view option, std::string_view text);
double parse_number(std::string_view option, std::string_view text, double min, double max);
int parse_integer(std::string_view option, std::string_view text, int min, int max);
std::uint64_t parse_count(std::string_view option, std::string_view text, std::uint64_t min,
                          std::uint64_t max);
double parse_duration(std::string_view option, std::string_view text);  // "90s", "20m", "2h" → s
glm::vec3 parse_vector(std::string_view option, std::string_view text);

CLI::Option* add_number(CLI::App& command, const std::string& name, std::optional<double>& value, double min,
                        double max, const std::string& help);
CLI::Option* add_integer(CLI::App& command, const std::string& name, int& value, int min, int max,
                         const std::string& help);
CLI::Option* add_size(CLI::App& command, std::optional<Size>& size, const std::string& help);

// What to draw: a scene at a size and time, its camera, what the front end does with it.
struct SceneOptions {
  std::optional<Size> size;
  std::optional<double> time, scale;  // s; factor
  std::optional<glm::vec3> eye, at;
  std::optional<double> fov_deg, near_z, far_z, yaw_deg, pitch_deg;
  std::optional<Cull> cull;  // none given: back for meshes, none for streams
  bool fit = false, no_shade = false;

  void add_to(CLI::App& command);
};

// A loaded scene with its camera as asked for, and the front end's options for it.
struct Shot {
  Source source;
  FrontendOptions frontend;
};
Shot load_shot(const std::string& name_or_path, const SceneOptions& options, double time);

int all_cores();  // of this machine; 1 … kMaxThreads

// How to draw it.
struct ExecutionOptions {
  ExecutionOptions();
  Execution execution;

  void add_to(CLI::App& command);
};

}  // namespace edgewise::app
