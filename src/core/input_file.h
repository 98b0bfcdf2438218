// Opens input files. Errors state the reason, and the size is known before anything is allocated.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace edgewise {

// "PATH: REASON", the form of all messages about files.
struct FileError : std::runtime_error {
  FileError(const std::filesystem::path& file, const std::string& why, int number = 0)
      : std::runtime_error(file.string() + ": " + why), path(file), reason(why), code(number) {}

  std::filesystem::path path;
  std::string reason;
  int code;  // errno's; 0: the system reported none
};

// What errno says. `what`, if not empty, precedes it: "cannot be written".
FileError system_error(const std::filesystem::path& path, int error, std::string what = {});

// The open descriptor that a name stands for: 0 for /dev/stdin, 3 for /dev/fd/3 or /proc/self/fd/3.
std::optional<int> descriptor_of(const std::filesystem::path& path);

struct InputFile {
  std::unique_ptr<std::istream> stream;  // binary, at its start
  std::uint64_t size;                    // bytes
};

// Throws FileError unless the path is a regular file that can be read, or a descriptor_of() a pipe, a
// socket or a terminal, which is then read to its end. A descriptor of a regular file is read from the file's
// start, wherever the descriptor stands. Other pipes and devices are refused without opening them: they may
// never end, and have no size to check a header's counts against.
InputFile open_input(const std::filesystem::path& path);

// Whether the file starts with this text, which stays unread.
bool starts_with(const InputFile& file, std::string_view text);

// A file name's extension, with its dot and in lower case: ".obj" for "a/BUNNY.OBJ"; empty if there is none.
std::string extension_of(const std::filesystem::path& path);

}  // namespace edgewise
