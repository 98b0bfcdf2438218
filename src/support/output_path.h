// Output file names: pictures and depth files, of one or of several scenes and frames.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/format.h"

namespace CLI {
class App;
}

namespace edgewise::tools {

enum class OutputKind { picture, depth };

// Adds --format with these values, for outputs whose names do not give the format.
void add_format(CLI::App& command, std::optional<Format>& format, const std::vector<Format>& choices);

struct OutputFile {
  std::filesystem::path path;
  Format format;
};

// The file that an option names; "-" is standard output, and then print() writes to stderr. The extension
// gives the format, and must not contradict `format`. Standard output has none: there `format` decides, and
// by default it is PNG or PFM. Throws std::invalid_argument.
OutputFile output_file(const std::string& option, const std::string& text, OutputKind kind,
                       std::optional<Format> format);

// The paths of written outputs, as printed text: "a.png, a.pfm", or "standard output".
std::string listed(const std::vector<std::string>& files);

struct Output {
  std::string option;
  std::filesystem::path path;
};

// `pattern` is what output_file() takes, a name that contains "{scene}", or a folder: an existing one, or a
// name that ends in a slash and is created if missing. Files in a folder are named after their scenes. With
// several frames, "-0001" and so on precedes the extension; on standard output they follow each other. The
// constructor throws std::invalid_argument for several scenes and one name, and what output_file() throws.
class OutputPaths {
 public:
  OutputPaths(const std::string& option, const std::string& pattern, OutputKind kind,
              std::vector<std::string> scenes, int frames, std::optional<Format> format = {});

  OutputFile file(const std::string& scene, int frame) const;
  void append_to(std::vector<Output>& outputs) const;  // all files
  void make_folder() const;                            // throws std::runtime_error on failure

 private:
  std::string option_;
  OutputFile pattern_;
  std::vector<std::string> scenes_;
  int frames_;
  bool on_descriptor_ = false, own_folder_ = false;
};

// Throws std::invalid_argument if two outputs are one file, or an output is one of the inputs: the same
// device and inode, or, if it does not exist yet, the same folder and name.
void check_files(const std::vector<Output>& outputs, const std::vector<std::string>& inputs);

// check_files() for --json of a command that also writes files to `folder` (.png, .tri), or to none if empty.
void check_json_file(const std::string& json, const std::string& folder,
                     const std::vector<std::string>& inputs);

}  // namespace edgewise::tools
