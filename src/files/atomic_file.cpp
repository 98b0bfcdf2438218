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

void FileBuffer::attach(int descriptor) {
  close();
  descriptor_ = descriptor;
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

bool FileBuffer::close() {
  sync();
  if (descriptor_ >= 0 && ::close(descriptor_) != 0 && error_ == 0) error_ = errno;
  descriptor_ = -1;
  return error_ == 0;
}

FileBuffer::int_type FileBuffer::overflow(int_type c) {
  if (sync() != 0) return traits_type::eof();
  return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c)
                                                         : sputc(traits_type::to_char_type(c));
}

int FileBuffer::sync() {
  for (const char* at = pbase(); at < pptr() && error_ == 0;) {
    const ssize_t written = write(descriptor_, at, static_cast<std::size_t>(pptr() - at));
    if (written >= 0)
      at += written;
    else if (errno != EINTR)
      error_ = errno;
  }
  setp(pbase(), epptr());
  return error_ == 0 ? 0 : -1;
}

AtomicFile::Folder::~Folder() {
  if (descriptor >= 0) close(descriptor);
}

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  stream_.imbue(std::locale::classic());
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (status.type() == fs::file_type::none) throw system_error(path_, error.value(), kUnwritable);
  if (fs::is_directory(status)) throw FileError(path_, "is a directory", EISDIR);
  const bool exists = fs::exists(status);
  const fs::path target = after_links(path_);
  // A rename over /dev/null would replace it, and one over /dev/stdout a file that another process holds
  // open.
  if (is_descriptor(target) || (exists && !fs::is_regular_file(status))) {
    const auto descriptor = descriptor_of(target);
    buffer_.attach(descriptor ? fcntl(*descriptor, F_DUPFD_CLOEXEC, 0)
                              : open(path_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
    if (buffer_.descriptor() < 0) throw system_error(path_, errno, kUnwritable);
    return;
  }
  if (exists && access(target.c_str(), W_OK) != 0) throw system_error(path_, errno, kUnwritable);

  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  folder_.descriptor = open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (folder_.descriptor < 0 && errno == ENOENT)
    throw FileError(path_, "cannot be written: there is no folder " + folder.string(), ENOENT);
  if (folder_.descriptor < 0) throw system_error(path_, errno, kUnwritable);
  name_ = target.filename();
  buffer_.attach(openat(folder_.descriptor, ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
  const bool unnamed = buffer_.descriptor() >= 0 && access(link().c_str(), F_OK) == 0;
  const auto create = [this](const char* name) {
    buffer_.attach(openat(folder_.descriptor, name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    return buffer_.descriptor() >= 0;
  };
  if (!unnamed && !make_temporary(create))
    throw system_error(path_, errno, exists ? "cannot be replaced in its folder" : kUnwritable);
  if (exists) fchmod(buffer_.descriptor(), static_cast<mode_t>(status.permissions()));
}

template <typename Make>
bool AtomicFile::make_temporary(const Make& make) {
  // Not derived from the final name, which may already have the maximum length.
  static std::atomic<unsigned> counter = 0;
  do {
    temporary_ =
        ".edgewise." + std::to_string(getpid()) + "." + std::to_string(counter.fetch_add(1)) + ".partial";
    if (make(temporary_.c_str())) return true;
  } while (errno == EEXIST);
  temporary_.clear();
  return false;
}

std::string AtomicFile::link() const {
  return "/proc/self/fd/" + std::to_string(buffer_.descriptor());
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) unlinkat(folder_.descriptor, temporary_.c_str(), 0);
}

void AtomicFile::commit() {
  stream_.flush();
  const bool direct = folder_.descriptor < 0, written = stream_.good();
  const auto name_it = [this](const char* name) {
    return linkat(AT_FDCWD, link().c_str(), folder_.descriptor, name, AT_SYMLINK_FOLLOW) == 0;
  };
  if (written && !direct && temporary_.empty() && !make_temporary(name_it))
    throw system_error(path_, errno, kUnwritable);
  const bool closed = buffer_.close();
  if (direct && buffer_.error() == EPIPE) return;
  if (!written || !closed) throw system_error(path_, buffer_.error(), kUnwritable);
  if (direct) return;
  if (renameat(folder_.descriptor, temporary_.c_str(), folder_.descriptor, name_.c_str()) != 0)
    throw system_error(path_, errno, "cannot be replaced");
  temporary_.clear();
}

}  // namespace edgewise
