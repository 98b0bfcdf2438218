#include "core/input_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>

namespace edgewise {

namespace fs = std::filesystem;

std::runtime_error file_error(const fs::path& path, const std::string& reason) {
  return std::runtime_error(path.string() + ": " + reason);
}

InputFile open_input(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw file_error(path, error ? error.message() : "no such file");
  if (fs::is_directory(status)) throw file_error(path, "is a directory");
  if (!fs::is_regular_file(status)) throw file_error(path, "is not a regular file");
  errno = 0;
  InputFile file{std::ifstream(path, std::ios::binary), 0};
  if (!file.stream) throw file_error(path, errno != 0 ? std::strerror(errno) : "cannot be opened");
  file.size = fs::file_size(path, error);
  if (error) throw file_error(path, error.message());
  return file;
}

}  // namespace edgewise
