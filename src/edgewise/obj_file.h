// Wavefront OBJ meshes, read by tinyobjloader. Part of edgewise::files. Any thread may call this.
#pragma once

#include "edgewise/cxx20.h"

#include <filesystem>

#include "edgewise/scene.h"

namespace edgewise {

// A scene of one light grey mesh, with a camera placed by frame_camera. Polygons of any size are
// triangulated. Negative (relative) indices are resolved. Windings are reversed: the front is
// counter-clockwise in OBJ and clockwise here. Throws std::runtime_error, with the file's name and the fault,
// if the file is missing, malformed, without faces or larger than kMaxObjBytes, or if an index is out of
// range.
Scene read_obj(const std::filesystem::path& path);

}  // namespace edgewise
