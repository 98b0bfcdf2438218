#include "core/input_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <future>
#include <map>
#include <mutex>
#include <streambuf>
#include <string_view>
#include <system_error>

#include "edgewise/limits.h"

namespace edgewise {

namespace fs = std::filesystem;

namespace {

std::runtime_error system_error(const fs::path& path) {
  return file_error(path, std::strerror(errno));
}

std::string content_of(int descriptor, const fs::path& path) {
  std::string content;
  for (std::array<char, 1 << 16> block;;) {
    const ssize_t count = read(descriptor, block.data(), block.size());
    if (count == 0) return content;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(path);
    content.append(block.data(), static_cast<std::size_t>(count));
    if (content.size() > kMaxObjBytes)
      throw file_error(path, "has more than " + std::to_string(kMaxObjBytes) + " bytes");
  }
}

// All that can be read from the descriptor. A failure is kept too: the rest of the input must not pass for
// the whole.
const std::string& kept(int descriptor, const fs::path& path) {
  static std::mutex mutex;
  static std::map<int, std::shared_future<std::string>> contents;
  const std::lock_guard lock(mutex);
  auto& content = contents[descriptor];
  if (!content.valid())
    content = std::async(std::launch::deferred, [&] { return content_of(descriptor, path); });
  return content.get();
}

// Reads a string in place, which may have gigabytes.
class StringStream : private std::streambuf, public std::istream {
 public:
  explicit StringStream(const std::string& text) : std::istream(static_cast<std::streambuf*>(this)) {
    char* const begin = const_cast<char*>(text.data());  // nothing writes there
    setg(begin, begin, begin + text.size());
  }

 private:
  std::streampos seekoff(std::streamoff offset, std::ios::seekdir from, std::ios::openmode) override {
    if (from != std::ios::beg) offset += (from == std::ios::cur ? gptr() : egptr()) - eback();
    if (offset < 0 || offset > egptr() - eback()) return -1;
    setg(eback(), eback() + offset, egptr());
    return offset;
  }
  std::streampos seekpos(std::streampos position, std::ios::openmode mode) override {
    return seekoff(position, std::ios::beg, mode);
  }
};

}  // namespace

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
  if (!fs::is_regular_file(status)) {
    const auto descriptor = descriptor_of(path);
    if (!descriptor) throw file_error(path, "is not a regular file");
    if (!fs::is_fifo(status) && !fs::is_socket(status) && isatty(*descriptor) == 0)
      throw file_error(path, "is neither a regular file, a pipe nor a terminal");
    const std::string& content = kept(*descriptor, path);
    return {std::make_unique<StringStream>(content), content.size()};
  }
  errno = 0;
  InputFile opened{std::make_unique<std::ifstream>(path, std::ios::binary), 0};
  if (!*opened.stream) throw file_error(path, errno != 0 ? std::strerror(errno) : "cannot be opened");
  opened.size = fs::file_size(path, error);
  if (error) throw file_error(path, error.message());
  return opened;
}

bool starts_with(const fs::path& path, std::string_view text) {
  std::string start(text.size(), '\0');
  return open_input(path).stream->read(start.data(), static_cast<std::streamsize>(start.size())) &&
         start == text;
}

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace edgewise
