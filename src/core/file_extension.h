// The extension of a file name.
#pragma once

#include <filesystem>
#include <string>

namespace edgewise {

// With its dot and in lower case: ".obj" for "a/BUNNY.OBJ"; empty if there is none.
std::string extension_of(const std::filesystem::path& path);

}  // namespace edgewise
