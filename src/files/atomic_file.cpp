#include "files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <locale>
#include <string>
#include <string_view>

#include "core/input_file.h"

namespace edgewise {

namespace {

namespace fs = std::filesystem;

constexpr const char* kUnwritable = "cannot be written";

// A link to an open file, of this or of another process. The name that it shows may be another file's by now.
bool is_descriptor(const fs::path& path) {
  std::error_code ignored;
  const fs::path name = fs::absolute(path, ignored).lexically_normal();
  return descriptor_of(path) ||
         (name.string().starts_with("/proc/") && name.parent_path().filename() == "fd");
}

// Writes to an open file and closes it. Returns errno of what failed first, opening it included, or 0.
int write_all(int descriptor, std::string_view bytes) {
  if (descriptor < 0) return errno;
  int error = 0;
  while (error == 0 && !bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      error = errno;
  }
  return close(descriptor) != 0 && error == 0 ? errno : error;
}

}  // namespace

fs::path after_links(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks && !is_descriptor(path) && fs::is_symlink(path, error); ++i)
    path = path.parent_path() / fs::read_symlink(path);
  return path;
}

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  stream_.imbue(std::locale::classic());
  stream_.exceptions(std::ios::badbit);  // of a lack of memory
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (status.type() == fs::file_type::none) throw system_error(path_, error.value(), kUnwritable);
  if (fs::is_directory(status)) throw FileError(path_, "is a directory", EISDIR);
  exists_ = fs::exists(status);
  target_ = after_links(path_);
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
  target_ = fs::absolute(target_);  // the current folder may change
  // A rename over /dev/null would replace it, and one over /dev/stdout a file that another process holds
  // open.
  direct_ = is_descriptor(target_) || (exists_ && !fs::is_regular_file(status));
  if (is_descriptor(target_)) return;
  if (exists_ && access(target_.c_str(), W_OK) != 0) throw system_error(path_, errno, kUnwritable);
  if (direct_ || access((folder / ".").c_str(), W_OK | X_OK) == 0) return;
  if (errno == ENOENT)
    throw FileError(path_, "cannot be written: there is no folder " + folder.string(), ENOENT);
  throw system_error(path_, errno, exists_ ? "cannot be replaced in its folder" : kUnwritable);
}

void AtomicFile::commit() {
  if (direct_) {
    const auto open_one = descriptor_of(target_);
    const int error = write_all(open_one ? fcntl(*open_one, F_DUPFD_CLOEXEC, 0)
                                         : open(target_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC),
                                stream_.view());
    if (error != 0 && error != EPIPE) throw system_error(path_, error, kUnwritable);
    return;
  }
  // Not derived from the final name, which may already have the maximum length.
  static std::atomic<unsigned> counter = 0;
  fs::path temporary;
  int descriptor = -1;
  do {
    const std::string number = std::to_string(getpid()) + "." + std::to_string(counter.fetch_add(1));
    temporary = target_.parent_path() / (".edgewise." + number + ".partial");
    descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0)
    throw system_error(path_, errno, exists_ ? "cannot be replaced in its folder" : kUnwritable);
  struct stat older {};
  if (stat(target_.c_str(), &older) == 0) fchmod(descriptor, older.st_mode & 07777);
  int error = write_all(descriptor, stream_.view());
  const bool written = error == 0;
  if (written && std::rename(temporary.c_str(), target_.c_str()) == 0) return;
  if (written) error = errno;
  unlink(temporary.c_str());
  throw system_error(path_, error, written ? "cannot be replaced" : kUnwritable);
}

}  // namespace edgewise
