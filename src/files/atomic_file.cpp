#include "files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <locale>

#include "core/input_file.h"

namespace edgewise {

namespace {

namespace fs = std::filesystem;

constexpr const char* kUnwritable = "cannot be written";
constexpr const char* kIrreplaceable = "cannot be replaced in its folder";

// A link to an open file, of this or of another process. The name that it shows may be another file's by now.
bool is_descriptor(const fs::path& path) {
  std::error_code ignored;
  const fs::path name = fs::absolute(path, ignored).lexically_normal();
  return descriptor_of(path) ||
         (name.string().starts_with("/proc/") && name.parent_path().filename() == "fd");
}

}  // namespace

fs::path after_links(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks && !is_descriptor(path) && fs::is_symlink(path, error); ++i)
    path = path.parent_path() / fs::read_symlink(path);
  return path;
}

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  stream_.imbue(std::locale::classic());
  stream_.exceptions(std::ios::badbit);  // std::bad_alloc
  std::error_code error;
  target_ = fs::absolute(after_links(path_), error);
  const fs::file_status status = fs::status(path_, error);
  if (status.type() == fs::file_type::none) throw system_error(path_, error.value(), kUnwritable);
  if (fs::is_directory(status)) throw FileError(path_, "is a directory", EISDIR);
  exists_ = fs::exists(status);
  // A rename over /dev/null would replace it, and one over /dev/stdout a file that another process holds
  // open.
  direct_ = is_descriptor(target_) || (exists_ && !fs::is_regular_file(status));
  if (direct_) return;
  if (exists_ && access(target_.c_str(), W_OK) != 0) throw system_error(path_, errno, kUnwritable);
  const fs::path folder = target_.parent_path();
  if (access((folder / ".").c_str(), W_OK) == 0) return;
  if (errno == ENOENT)
    throw FileError(path_, "cannot be written: there is no folder " + folder.string(), ENOENT);
  throw system_error(path_, errno, exists_ ? kIrreplaceable : kUnwritable);
}

void AtomicFile::write_directly() const {
  const auto descriptor = descriptor_of(target_);
  const int file = descriptor ? fcntl(*descriptor, F_DUPFD_CLOEXEC, 0)
                              : open(path_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (file < 0) throw system_error(path_, errno, kUnwritable);
  const int error = write_all(file, stream_.view());
  close(file);
  if (error != 0 && error != EPIPE) throw system_error(path_, error, kUnwritable);
}

void AtomicFile::commit() {
  if (direct_) return write_directly();
  static std::atomic<unsigned> counter = 0;
  fs::path partial;
  int file = -1;
  do {  // not derived from the final name, which may already have the maximum length
    partial = target_.parent_path() / (".edgewise." + std::to_string(getpid()) + "." +
                                       std::to_string(counter.fetch_add(1)) + ".partial");
    file = open(partial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (file < 0 && errno == EEXIST);
  if (file < 0) throw system_error(path_, errno, exists_ ? kIrreplaceable : kUnwritable);
  struct stat older {};
  if (stat(target_.c_str(), &older) == 0) fchmod(file, older.st_mode);
  int error = write_all(file, stream_.view());
  const char* what = kUnwritable;
  if (close(file) != 0 && error == 0) error = errno;
  if (error == 0 && rename(partial.c_str(), target_.c_str()) != 0) error = errno, what = "cannot be replaced";
  if (error == 0) return;
  unlink(partial.c_str());
  throw system_error(path_, error, what);
}

}  // namespace edgewise
