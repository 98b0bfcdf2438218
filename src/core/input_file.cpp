// WASI's C++ library has no file streams. No program there opens a file, so its linker drops the calls.
#ifndef __wasm__
#include "core/input_file.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <locale>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/numbers.h"
#include "edgewise/limits.h"

namespace edgewise {

namespace fs = std::filesystem;

namespace {

std::string content_of(int descriptor, const fs::path& path) {
  std::string content;
  for (std::array<char, 1 << 16> block;;) {
    const ssize_t count = read(descriptor, block.data(), block.size());
    if (count == 0) return content;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(path, errno);
    content.append(block.data(), static_cast<std::size_t>(count));
    if (content.size() > kMaxObjBytes)
      throw FileError(path, "has more than " + std::to_string(kMaxObjBytes) + " bytes");
  }
}

}  // namespace

FileError system_error(const fs::path& path, int error, std::string what) {
  if (error != 0) what += (what.empty() ? "" : ": ") + std::generic_category().message(error);
  return {path, what, error};
}

std::optional<int> descriptor_of(const fs::path& path) {
  std::error_code ignored;  // of an empty path
  const std::string name = fs::absolute(path, ignored).lexically_normal().string();
  constexpr std::array<std::string_view, 3> kStreams{"/dev/stdin", "/dev/stdout", "/dev/stderr"};
  for (std::size_t i = 0; i < kStreams.size(); ++i)
    if (name == kStreams[i]) return static_cast<int>(i);
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!name.starts_with(folder)) continue;
    if (const auto descriptor = parsed<int>(std::string_view(name).substr(folder.size()))) return descriptor;
  }
  return {};
}

InputFile open_input(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw system_error(path, error.value());
  if (fs::is_directory(status)) throw FileError(path, "is a directory", EISDIR);
  if (!fs::is_regular_file(status)) {
    const auto descriptor = descriptor_of(path);
    if (!descriptor) throw FileError(path, "is not a regular file");
    if (!fs::is_fifo(status) && !fs::is_socket(status) && isatty(*descriptor) == 0)
      throw FileError(path, "is neither a regular file, a pipe nor a terminal");
    std::string content = content_of(*descriptor, path);
    const std::uint64_t size = content.size();
    return {std::make_unique<std::istringstream>(std::move(content)), size};
  }
  auto stream = std::make_unique<std::ifstream>();
  stream->imbue(std::locale::classic());  // another one may convert bytes
  errno = 0;
  stream->open(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream->is_open() ? std::streamoff{stream->tellg()} : -1;
  if (size < 0) throw system_error(path, errno, errno != 0 ? "" : "cannot be opened");
  stream->seekg(0);
  return {std::move(stream), static_cast<std::uint64_t>(size)};
}

bool starts_with(const InputFile& file, std::string_view text) {
  std::string start(text.size(), '\0');
  file.stream->read(start.data(), static_cast<std::streamsize>(start.size()));
  file.stream->clear();
  file.stream->seekg(0);
  return start == text;
}

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)  // std::tolower() asks the locale
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace edgewise
#endif
