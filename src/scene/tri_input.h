// Triangle streams from elsewhere than a file.
#pragma once

#include <filesystem>

#include "core/input_file.h"
#include "edgewise/scene.h"

namespace edgewise {

// As read_tri() of edgewise/tri_file.h. `path` is for messages.
TriangleStream read_tri(const std::filesystem::path& path, InputFile file);

}  // namespace edgewise
