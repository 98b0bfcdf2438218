// Wavefront OBJ meshes, read by tinyobjloader. Part of edgewise::files; any thread may call it.
#pragma once

#include "edgewise/cxx20.h"

#include <filesystem>

#include "edgewise/scene.h"

namespace edgewise {

// A scene of one mesh in one light grey, with a camera in front of it that sees all of it. Polygons of any
// size are triangulated, negative (relative) indices are resolved, and windings are reversed, since
// counter-clockwise is front in OBJ and clockwise is front here. Throws std::runtime_error, naming the file
// and what is wrong with it, for a file that is missing, malformed, without faces, larger than kMaxObjBytes,
// or with an index that is out of range.
Scene read_obj(const std::filesystem::path& path);

}  // namespace edgewise
