// Output file names for several scenes or frames.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace edgewise::tools {

// `pattern` is a file, a name that contains "{scene}", or a folder: an existing one, or a name that ends in a
// slash and is created if missing. Files in a folder are named after their scenes, .png or .pfm. With several
// frames,
// "-0001" and so on precedes the extension. The constructor throws std::invalid_argument if several scenes
// would write the same file, or if the extension is not that of a picture (.png, .ppm) or a depth file
// (.pfm).
class OutputPaths {
 public:
  enum class Kind { picture, depth };
  OutputPaths(const std::string& option, const std::string& pattern, Kind kind,
              const std::vector<std::string>& scenes, int frames);

  std::filesystem::path path(const std::string& scene, int frame) const;
  void make_folder() const;  // throws std::runtime_error on failure

 private:
  std::filesystem::path pattern_;
  int frames_;
  bool own_folder_ = false;
};

// Throws std::invalid_argument if both paths name the same file, even with different spellings or through
// links.
void check_output_is_not_input(const std::string& output, const std::string& input);

}  // namespace edgewise::tools
