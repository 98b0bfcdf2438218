// A file can stand wherever a scene name can.
#pragma once

#include <string>

#include "edgewise/builtin.h"

namespace edgewise::app {

struct Source {
  std::string name;  // the scene's name, or the file's name without folder and extension
  Drawable drawable;
  bool stream;                          // drawn without culling and shading unless asked for
  const SceneInfo* built_in = nullptr;  // none for a file
};

// The name that load_source would give it, without loading anything.
std::string source_name(const std::string& name_or_path);
bool is_file_path(const std::string& name_or_path);  // by its look: a folder or an extension

// Throws what load_source would throw for an unknown name or a missing file: before work begins on other
// scenes.
void check_source(const std::string& name_or_path);

// A built-in scene's name, or a path that ends in .obj or .tri. `fit` centres a mesh scene and scales its
// longest side to 2 (built-in streams and .tri files ignore it). Throws std::invalid_argument for an unknown
// name (with the nearest) and what read_obj and read_tri throw.
Source load_source(const std::string& name_or_path, const SceneRequest& request, bool fit);

}  // namespace edgewise::app
