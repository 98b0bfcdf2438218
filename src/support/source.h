// Loads scenes by name or from files.
#pragma once

#include <string>

#include "edgewise/builtin.h"

namespace edgewise::tools {

struct Source {
  std::string name;  // the scene's name, or the file's name without folder and extension
  Drawable drawable;
  bool stream;                          // by default drawn without culling; never shaded
  const SceneInfo* built_in = nullptr;  // null for a file
};

// A file's name on the command line; "-" is standard input.
std::string input_path(const std::string& text);

// The name that load_source would set, without loading the scene.
std::string source_name(const std::string& name_or_path);
bool is_file_path(const std::string& name_or_path);  // whether it is "-", or has a slash or an extension
bool is_stream_file(const std::string& path);        // by the extension; standard input by its content

// Throws what load_source would throw for an unknown name, a missing file or an unknown extension; for checks
// before long work.
void check_source(const std::string& name_or_path);

// Loads a built-in scene by name, or a .obj or .tri file, or one of them from standard input ("-"). `fit`
// centres a mesh scene and scales its longest side to 2 (built-in streams and .tri files ignore it). Throws
// std::invalid_argument for an unknown name, with the nearest known one, and what read_obj and read_tri
// throw. Prints what read_obj warns of. `recentre` is an option of read_obj, ignored for other scenes; the
// offset is printed.
Source load_source(const std::string& name_or_path, const SceneRequest& request, bool fit,
                   bool recentre = false);

}  // namespace edgewise::tools
