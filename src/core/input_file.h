// Opens input files. Errors state the reason, and the size is known before anything is allocated.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace edgewise {

// "PATH: REASON", the form of all messages about files.
std::runtime_error file_error(const std::filesystem::path& path, const std::string& reason);

struct InputFile {
  std::ifstream stream;  // binary, at its start
  std::uint64_t size;    // bytes
};

// Throws file_error() unless the path is a regular file that can be read. Pipes and devices are refused: they
// may never end, and have no size to check a header's counts against.
InputFile open_input(const std::filesystem::path& path);

}  // namespace edgewise
