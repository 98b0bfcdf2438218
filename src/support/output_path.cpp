#include "support/output_path.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/input_file.h"
#include "core/nearest_name.h"
#include "files/atomic_file.h"
#include "support/console.h"
#include "support/options.h"
#include "support/source.h"

namespace edgewise::tools {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPlaceholder = "{scene}";
constexpr std::array<std::string_view, 3> kFormatNames{"png", "ppm", "pfm"};  // by Format

std::string_view name_of(Format format) {
  return kFormatNames[static_cast<std::size_t>(format)];
}

Format default_format(OutputKind kind) {
  return kind == OutputKind::depth ? Format::pfm : Format::png;
}

using FileId = std::tuple<dev_t, ino_t, std::string>;

// None for a terminal, /dev/null and other character devices: they have nothing to lose.
std::optional<FileId> id_of(const fs::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) {
    if (S_ISCHR(status.st_mode)) return {};
    return FileId{status.st_dev, status.st_ino, ""};
  }
  const fs::path file = fs::absolute(after_links(path));
  if (stat(file.parent_path().c_str(), &status) == 0)
    return FileId{status.st_dev, status.st_ino, file.filename()};
  std::error_code error;  // then the names alone are compared
  const fs::path resolved = fs::weakly_canonical(file, error);
  return FileId{0, 0, (error ? file.lexically_normal() : resolved).string()};
}

}  // namespace

void add_format(CLI::App& command, std::optional<Format>& format, const std::vector<Format>& choices) {
  std::vector<std::string_view> names;
  for (const Format choice : choices) names.push_back(name_of(choice));
  add_parsed(command, "--format", "FORMAT",
             fmt::format("Picture format for - and for folders: {} (png)", fmt::join(names, ", ")),
             [&format, choices](const std::string& text) {
               format =
                   find_named("format", text, std::span(choices), [](Format one) { return name_of(one); });
             });
}

OutputFile output_file(const std::string& option, const std::string& text, OutputKind kind,
                       std::optional<Format> format) {
  if (text.empty()) throw std::invalid_argument(option + ": the file name is empty");
  const fs::path path = text == "-" ? "/dev/stdout" : text;
  if (const auto descriptor = descriptor_of(path)) {
    if (descriptor == 1) print_to_stderr();
    return {path, format.value_or(default_format(kind))};
  }
  const auto named = format_of(path);
  const bool depth = kind == OutputKind::depth;
  if (!named || (named == Format::pfm) != depth)
    throw std::invalid_argument(
        fmt::format("{} {}: the name must end in {}", option, text, depth ? ".pfm" : ".png or .ppm"));
  if (format && named != format)
    throw std::invalid_argument(fmt::format("{} {}: with --format {} the name must end in .{}", option, text,
                                            name_of(*format), name_of(*format)));
  return {path, *named};
}

std::string listed(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& file : files)
    names.push_back(descriptor_of(file) == 1 ? "standard output" : printable(file));
  return fmt::format("{}", fmt::join(names, ", "));
}

OutputPaths::OutputPaths(const std::string& option, const std::string& pattern, OutputKind kind,
                         std::vector<std::string> scenes, int frames, std::optional<Format> format)
    : option_(option), scenes_(std::move(scenes)), frames_(frames) {
  std::error_code ignored;
  own_folder_ = pattern.ends_with('/');
  fs::path name = pattern;
  if (own_folder_ || (pattern != "-" && fs::is_directory(pattern, ignored)))
    name /= fmt::format("{}.{}", kPlaceholder, name_of(format.value_or(default_format(kind))));
  pattern_ = output_file(option, name, kind, format);
  on_descriptor_ = descriptor_of(pattern_.path).has_value();
  if (!on_descriptor_ && scenes_.size() > 1 && name.string().find(kPlaceholder) == std::string::npos)
    throw std::invalid_argument(fmt::format("{} {}: several scenes need a folder, or a name with {} in it",
                                            option, pattern, kPlaceholder));
}

OutputFile OutputPaths::file(const std::string& scene, int frame) const {
  if (on_descriptor_) return pattern_;
  std::string text = pattern_.path.string();
  for (auto at = text.find(kPlaceholder); at != std::string::npos;
       at = text.find(kPlaceholder, at + scene.size()))
    text.replace(at, kPlaceholder.size(), scene);
  if (frames_ == 1) return {text, pattern_.format};
  const fs::path whole(text);
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(frames_).size());
  const std::string name =
      fmt::format("{}-{:0{}}{}", whole.stem().string(), frame, digits, whole.extension().string());
  return {whole.parent_path() / name, pattern_.format};
}

void OutputPaths::append_to(std::vector<Output>& outputs) const {
  if (on_descriptor_) {
    outputs.push_back({option_, pattern_.path});
    return;
  }
  for (const std::string& scene : scenes_)
    for (int frame = 1; frame <= frames_; ++frame) outputs.push_back({option_, file(scene, frame).path});
}

void OutputPaths::make_folder() const {
  if (!own_folder_) return;
  const fs::path folder = pattern_.path.parent_path();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": " + error.message());
}

void check_files(const std::vector<Output>& outputs, const std::vector<std::string>& inputs) {
  std::map<FileId, const Output*> taken;
  for (const Output& output : outputs) {
    const auto id = id_of(output.path);
    if (!id) continue;
    const auto [other, is_new] = taken.try_emplace(*id, &output);
    if (is_new) continue;
    const std::string& option = other->second->option;
    throw std::invalid_argument(
        option == output.option
            ? fmt::format("{}: two pictures would be written to {}", option, output.path.string())
            : fmt::format("{} and {} would write the same file, {}", option, output.option,
                          output.path.string()));
  }
  for (const std::string& input : inputs) {
    std::error_code not_there;  // a missing file cannot be overwritten
    const fs::path path = input_path(input);
    if (!is_file_path(input) || !fs::is_regular_file(path, not_there)) continue;
    if (const auto output = taken.find(id_of(path).value()); output != taken.end())
      throw std::invalid_argument(fmt::format("{} {} would overwrite the input {}", output->second->option,
                                              output->second->path.string(), path.string()));
  }
}

void check_json_file(const std::string& json, const std::string& folder,
                     const std::vector<std::string>& inputs) {
  if (json.empty() || json == "-") return;
  check_files({{"--json", json}}, inputs);
  const std::string extension = extension_of(json);
  if ((extension == ".png" || extension == ".tri") && !folder.empty() &&
      id_of(folder) == id_of(fs::absolute(json).parent_path()))
    throw std::invalid_argument(
        fmt::format("--json {}: a file of the folder {} may have this name", json, folder));
}

}  // namespace edgewise::tools
