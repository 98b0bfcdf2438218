#include "support/output_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <system_error>

#include "core/file_extension.h"
#include "edgewise/image.h"

namespace edgewise::tools {

namespace fs = std::filesystem;

namespace {
constexpr std::string_view kPlaceholder = "{scene}";
}

OutputPaths::OutputPaths(const std::string& option, const std::string& pattern, Kind kind,
                         const std::vector<std::string>& scenes, int frames)
    : pattern_(pattern), frames_(frames) {
  if (pattern.empty()) throw std::invalid_argument(option + ": the file name is empty");
  std::error_code ignored;
  const bool depth = kind == Kind::depth;
  const bool known = depth ? extension_of(pattern) == ".pfm" : is_image_path(pattern);
  own_folder_ = pattern.ends_with('/');
  if (own_folder_ || fs::is_directory(pattern_, ignored))
    pattern_ /= std::string(kPlaceholder) + (depth ? ".pfm" : ".png");
  else if (!known)
    throw std::invalid_argument(
        fmt::format("{} {}: the name must end in {}", option, pattern, depth ? ".pfm" : ".png or .ppm"));
  else if (scenes.size() > 1 && pattern.find(kPlaceholder) == std::string::npos)
    throw std::invalid_argument(fmt::format("{} {}: several scenes need a folder, or a name with {} in it",
                                            option, pattern, kPlaceholder));

  std::set<fs::path> taken;
  for (const std::string& scene : scenes)
    if (!taken.insert(path(scene, 1)).second)
      throw std::invalid_argument(fmt::format("two scenes would be written to {}", path(scene, 1).string()));
}

fs::path OutputPaths::path(const std::string& scene, int frame) const {
  std::string text = pattern_.string();
  for (auto at = text.find(kPlaceholder); at != std::string::npos;
       at = text.find(kPlaceholder, at + scene.size()))
    text.replace(at, kPlaceholder.size(), scene);
  if (frames_ == 1) return text;
  const fs::path whole(text);
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(frames_).size());
  return whole.parent_path() /
         fmt::format("{}-{:0{}}{}", whole.stem().string(), frame, digits, whole.extension().string());
}

void OutputPaths::make_folder() const {
  if (!own_folder_) return;
  std::error_code error;
  fs::create_directories(pattern_.parent_path(), error);
  if (error) throw std::runtime_error(pattern_.parent_path().string() + ": " + error.message());
}

void check_output_is_not_input(const std::string& output, const std::string& input) {
  std::error_code not_there;  // a missing file cannot be overwritten
  if (fs::equivalent(output, input, not_there))
    throw std::invalid_argument(fmt::format("--output {} would overwrite the input {}", output, input));
}

}  // namespace edgewise::tools
