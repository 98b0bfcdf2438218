#include "core/input_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <future>
#include <map>
#include <mutex>
#include <string_view>
#include <system_error>

#include "edgewise/limits.h"

namespace edgewise {

namespace fs = std::filesystem;

namespace {

std::runtime_error system_error(const fs::path& path) {
  return file_error(path, std::strerror(errno));
}

void copy(int from, int to, const fs::path& path) {
  std::array<char, 1 << 16> block;
  std::uint64_t size = 0;
  for (;;) {
    const ssize_t count = read(from, block.data(), block.size());
    if (count == 0) return;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(path);
    if ((size += static_cast<std::uint64_t>(count)) > kMaxObjBytes)
      throw file_error(path, "has more than " + std::to_string(kMaxObjBytes) + " bytes");
    for (ssize_t done = 0; done < count;) {
      const ssize_t written = write(to, block.data() + done, static_cast<std::size_t>(count - done));
      if (written < 0) throw system_error(path);
      done += written;
    }
  }
}

// A file in memory with all that can be read from the descriptor. A failure is kept too: the rest of the
// input must not pass for the whole.
fs::path kept(int descriptor, const fs::path& path) {
  static std::mutex mutex;
  static std::map<int, std::shared_future<fs::path>> files;
  const std::lock_guard lock(mutex);
  auto& file = files[descriptor];
  if (!file.valid())
    file = std::async(std::launch::deferred, [&] {
      const int memory = memfd_create("edgewise", MFD_CLOEXEC);
      if (memory < 0) throw system_error(path);
      copy(descriptor, memory, path);
      return fs::path("/proc/self/fd/" + std::to_string(memory));
    });
  return file.get();
}

}  // namespace

std::runtime_error file_error(const fs::path& path, const std::string& reason) {
  return std::runtime_error(path.string() + ": " + reason);
}

std::optional<int> descriptor_of(const fs::path& path) {
  std::error_code ignored;  // of an empty path
  const std::string name = fs::absolute(path, ignored).lexically_normal().string();
  constexpr std::array<std::string_view, 3> kStreams{"/dev/stdin", "/dev/stdout", "/dev/stderr"};
  for (std::size_t i = 0; i < kStreams.size(); ++i)
    if (name == kStreams[i]) return static_cast<int>(i);
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!name.starts_with(folder)) continue;
    int descriptor = 0;
    const char* const end = name.data() + name.size();
    const auto parsed = std::from_chars(name.data() + folder.size(), end, descriptor);
    if (parsed.ec == std::errc() && parsed.ptr == end) return descriptor;
  }
  return {};
}

InputFile open_input(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw file_error(path, error ? error.message() : "no such file");
  if (fs::is_directory(status)) throw file_error(path, "is a directory");
  fs::path file = path;
  if (!fs::is_regular_file(status)) {
    const auto descriptor = descriptor_of(path);
    if (!descriptor) throw file_error(path, "is not a regular file");
    if (!fs::is_fifo(status) && !fs::is_socket(status) && isatty(*descriptor) == 0)
      throw file_error(path, "is neither a regular file, a pipe nor a terminal");
    file = kept(*descriptor, path);
  }
  errno = 0;
  InputFile opened{std::ifstream(file, std::ios::binary), 0};
  if (!opened.stream) throw file_error(path, errno != 0 ? std::strerror(errno) : "cannot be opened");
  opened.size = fs::file_size(file, error);
  if (error) throw file_error(path, error.message());
  return opened;
}

bool starts_with(const fs::path& path, std::string_view text) {
  std::string start(text.size(), '\0');
  return open_input(path).stream.read(start.data(), static_cast<std::streamsize>(start.size())) &&
         start == text;
}

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace edgewise
