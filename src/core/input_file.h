// Files that are read: opened with a clear reason when they cannot be, and sized before anything is allocated
// for them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace edgewise {

// "PATH: REASON", the form of every complaint about a file.
std::runtime_error file_error(const std::filesystem::path& path, const std::string& reason);

struct InputFile {
  std::ifstream stream;  // binary, at its start
  std::uint64_t size;    // bytes
};

// Throws what file_error makes unless the path is a regular file that can be read. Pipes and devices are
// refused: they have no size to check a header's promise against, and may never end.
InputFile open_input(const std::filesystem::path& path);

}  // namespace edgewise
