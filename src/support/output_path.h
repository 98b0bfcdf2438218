// Where pictures go when one name has to serve several scenes or frames.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace edgewise::app {

// `pattern` is a file, a name that contains "{scene}", or a folder (one that exists, or that ends in a slash
// and is made if missing), in which files are named after their scenes, .png or .pfm. With more than one
// frame, "-0001" and so on stands before the extension. Throws std::invalid_argument if several scenes would
// write the same file, or for a file that is no picture (.png, .ppm) or depth file (.pfm).
class OutputPaths {
 public:
  enum class Kind { picture, depth };
  OutputPaths(const std::string& option, const std::string& pattern, Kind kind,
              const std::vector<std::string>& scenes, int frames);

  std::filesystem::path path(const std::string& scene, int frame) const;
  void make_folder() const;  // throws std::runtime_error where it cannot

 private:
  std::filesystem::path pattern_;
  int frames_;
  bool own_folder_ = false;
};

// Throws std::invalid_argument if both paths name the same file, however they are spelled or linked.
void check_output_is_not_input(const std::string& output, const std::string& input);

}  // namespace edgewise::app
