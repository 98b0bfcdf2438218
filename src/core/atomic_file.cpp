// A signal handler may only use lock-free atomics and async-signal-safe functions, so the names of the
// temporary files are kept in a fixed table. The handler unlinks them and raises the signal again with its
// default action, so that the exit status still reports it.
#include "core/atomic_file.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <string>
#include <utility>

#include "core/input_file.h"

namespace edgewise {

namespace {

namespace fs = std::filesystem;

enum class SlotState { free, claimed, live };
static_assert(std::atomic<SlotState>::is_always_lock_free);

struct Slot {
  std::atomic<SlotState> state = SlotState::free;
  char path[PATH_MAX] = {};
};
std::array<Slot, 32> slots;
std::atomic<int> ending{0};       // 0 or 1; riscv64 has no atomic bytes without a lock
std::atomic<int> overwriting{0};  // files
static_assert(std::atomic<int>::is_always_lock_free);

constexpr std::array kEndSignals{SIGINT, SIGTERM, SIGHUP, SIGQUIT};

// If another thread is ending the process, removes the file just begun and waits for the end.
void wait_if_ending(const fs::path& begun) {
  if (!ending) return;
  unlink(begun.c_str());
  while (true) pause();
}

extern "C" void remove_temporaries(int signal_number) {
  remove_unfinished_files();
  // SA_RESETHAND has restored the default action, which runs as soon as this handler returns.
  raise(signal_number);
}

void install_handlers() {
  for (const int signal_number : kEndSignals) {
    struct sigaction action {};
    // Keeps signals that are ignored (nohup) or have another handler.
    if (sigaction(signal_number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
    action = {};
    action.sa_handler = remove_temporaries;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal_number, &action, nullptr);
  }
}

int claim_slot(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    auto expected = SlotState::free;
    if (!slots[i].state.compare_exchange_strong(expected, SlotState::claimed)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].state.store(SlotState::live);
    return static_cast<int>(i);
  }
  return -1;
}

void release_slot(int slot) {
  if (slot >= 0) slots[static_cast<std::size_t>(slot)].state.store(SlotState::free);
}

// While one exists, signals that end the process wait.
class Overwriting {
 public:
  Overwriting() {
    sigset_t ends;
    sigemptyset(&ends);
    for (const int signal_number : kEndSignals) sigaddset(&ends, signal_number);
    pthread_sigmask(SIG_BLOCK, &ends, &before_);
    ++overwriting;
    if (!ending) return;
    --overwriting;  // remove_unfinished_files() waits for none
    while (true) pause();
  }
  ~Overwriting() {
    --overwriting;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  Overwriting(const Overwriting&) = delete;
  Overwriting& operator=(const Overwriting&) = delete;

 private:
  sigset_t before_;
};

// Whether renaming failed, or would fail, for a reason that does not prevent writing to the file itself. A
// full disk is no such reason: it would leave the older file half overwritten.
bool only_renaming_fails(int error) {
  return error == EACCES || error == EPERM || error == EROFS || error == EBUSY || error == EXDEV;
}

std::runtime_error write_error(const fs::path& path, int error = errno) {
  return file_error(path, error != 0 ? std::string("cannot be written: ") + std::strerror(error)
                                     : std::string("cannot be written"));
}

}  // namespace

fs::path after_links(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks && !descriptor_of(path) && fs::is_symlink(path, error); ++i)
    path = path.parent_path() / fs::read_symlink(path);
  return path;
}

void remove_unfinished_files() {
  ending = 1;
  while (overwriting > 0) poll(nullptr, 0, 1);
  for (Slot& slot : slots)
    if (slot.state.load() == SlotState::live) unlink(slot.path);
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

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (status.type() == fs::file_type::none) throw file_error(path, "cannot be written: " + error.message());
  if (fs::is_directory(status)) throw file_error(path, "is a directory");
  target_ = after_links(path_);
  if (open_directly(status)) return;

  const bool exists = fs::exists(status);
  if (exists && access(target_.c_str(), W_OK) != 0) throw write_error(path_);
  install_handlers();
  if (make_temporary()) {
    if (exists) fs::permissions(temporary_, status.permissions(), error);
    return;
  }
  const int reason = errno;
  if (exists && only_renaming_fails(reason)) {
    buffer_.attach(memfd_create("edgewise", MFD_CLOEXEC));
    if (buffer_.descriptor() < 0) throw write_error(path_);
    return;
  }
  const fs::path folder = target_.parent_path();
  if (folder.empty() || fs::exists(folder, error)) throw write_error(path_, reason);
  throw file_error(path, "cannot be written: there is no folder " + folder.string());
}

// A rename over /dev/null would replace it, and one over /dev/stdout a file that another process holds open.
bool AtomicFile::open_directly(const fs::file_status& status) {
  const auto descriptor = descriptor_of(target_);
  const bool in_proc = fs::absolute(target_).lexically_normal().string().starts_with("/proc/");
  direct_ = descriptor || in_proc || (fs::exists(status) && !fs::is_regular_file(status));
  if (!direct_) return false;
  buffer_.attach(descriptor ? fcntl(*descriptor, F_DUPFD_CLOEXEC, 0)
                            : open(target_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (buffer_.descriptor() < 0) throw write_error(path_);
  return true;
}

bool AtomicFile::make_temporary() {
  // Not derived from the final name, which may already have the maximum length.
  static std::atomic<unsigned> counter = 0;
  int descriptor = -1;
  do {
    release_slot(slot_);
    temporary_ = target_.parent_path() / (".edgewise." + std::to_string(getpid()) + "." +
                                          std::to_string(counter.fetch_add(1)) + ".partial");
    slot_ = claim_slot(temporary_.string());
    if (slot_ < 0)
      throw file_error(path_, "cannot be written: the path is too long, or too many files are open");
    wait_if_ending(temporary_);
    descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) {
    release_slot(std::exchange(slot_, -1));
    return false;
  }
  buffer_.attach(descriptor);
  wait_if_ending(temporary_);
  return true;
}

AtomicFile::~AtomicFile() {
  if (slot_ < 0) return;
  unlink(temporary_.c_str());
  release_slot(slot_);
}

void AtomicFile::commit() {
  stream_.flush();
  const bool renames = slot_ >= 0;
  if (direct_ || renames) buffer_.close();
  if (direct_ && buffer_.error() == EPIPE) return;
  if (!stream_ || buffer_.error() != 0) throw write_error(path_, buffer_.error());
  if (direct_) return;
  if (renames) {
    if (std::rename(temporary_.c_str(), target_.c_str()) == 0) {
      release_slot(std::exchange(slot_, -1));
      return;
    }
    const int reason = errno;
    if (!only_renaming_fails(reason) || access(target_.c_str(), F_OK) != 0) throw write_error(path_, reason);
    buffer_.attach(open(temporary_.c_str(), O_RDONLY | O_CLOEXEC));
  }
  overwrite();
}

void AtomicFile::overwrite() {
  const Overwriting signals_wait;
  const int from = buffer_.descriptor();
  FileBuffer to;
  to.attach(open(target_.c_str(), O_WRONLY | O_CLOEXEC));
  if (from < 0 || to.descriptor() < 0) throw write_error(path_);
  const off_t size = lseek(from, 0, SEEK_END), older = lseek(to.descriptor(), 0, SEEK_END);
  if (const int full = size > older ? posix_fallocate(to.descriptor(), older, size - older) : 0; full != 0) {
    [[maybe_unused]] const int shrunk = ftruncate(to.descriptor(), older);
    throw write_error(path_, full);
  }
  lseek(to.descriptor(), 0, SEEK_SET);
  for (off_t done = 0; done < size;) {
    const ssize_t sent = sendfile(to.descriptor(), from, &done, static_cast<std::size_t>(size - done));
    if (sent <= 0) throw write_error(path_, sent < 0 ? errno : 0);
  }
  if (ftruncate(to.descriptor(), size) != 0 || !to.close()) throw write_error(path_);
}

}  // namespace edgewise
