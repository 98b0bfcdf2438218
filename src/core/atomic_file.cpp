// A signal handler may only use lock-free atomics and async-signal-safe functions, so the names of the
// temporary files are kept in a fixed table. The handler unlinks them and raises the signal again with its
// default action, so that the exit status still reports it.
#include "core/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <string>

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
std::atomic<bool> ending{false};
static_assert(std::atomic<bool>::is_always_lock_free);

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
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
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

// Devices and pipes are written directly, because a rename over /dev/null would replace it. So are names such
// as /dev/stdout, which may refer to a regular file that another process holds open.
bool is_written_directly(const fs::path& path, const fs::file_status& status) {
  const std::string name = fs::absolute(path).lexically_normal().string();
  return name.starts_with("/dev/std") || name.starts_with("/dev/fd/") || name.starts_with("/proc/") ||
         (fs::exists(status) && !fs::is_regular_file(status));
}

std::runtime_error write_error(const fs::path& path, int error = errno) {
  return file_error(path, error != 0 ? std::string("cannot be written: ") + std::strerror(error)
                                     : std::string("cannot be written"));
}

}  // namespace

void remove_unfinished_files() {
  ending = true;
  for (Slot& slot : slots)
    if (slot.state.load() == SlotState::live) unlink(slot.path);
}

void FileBuffer::note(bool failed) {
  if (failed && error_ == 0) error_ = errno;
}

std::streamsize FileBuffer::xsputn(const char* text, std::streamsize size) {
  errno = 0;
  const std::streamsize written = std::filebuf::xsputn(text, size);
  note(written != size);
  return written;
}

FileBuffer::int_type FileBuffer::overflow(int_type c) {
  errno = 0;
  const int_type result = std::filebuf::overflow(c);
  note(traits_type::eq_int_type(result, traits_type::eof()));
  return result;
}

int FileBuffer::sync() {
  errno = 0;
  const int result = std::filebuf::sync();
  note(result != 0);
  return result;
}

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (status.type() == fs::file_type::none) throw file_error(path, "cannot be written: " + error.message());
  if (fs::is_directory(status)) throw file_error(path, "is a directory");
  if (is_written_directly(path_, status)) {
    errno = 0;
    if (buffer_.open(path_, std::ios::out | std::ios::binary) == nullptr) throw write_error(path_);
    return;
  }

  if (fs::exists(status)) {
    path_ = fs::canonical(path_);  // keep a symbolic link, replace its target
    if (access(path_.c_str(), W_OK) != 0) throw write_error(path_);
  }
  install_handlers();

  // Not derived from the final name, which may already have the maximum length.
  static std::atomic<unsigned> counter = 0;
  int descriptor = -1;
  do {
    release_slot(slot_);
    temporary_ = path_.parent_path() / (".edgewise." + std::to_string(getpid()) + "." +
                                        std::to_string(counter.fetch_add(1)) + ".partial");
    slot_ = claim_slot(temporary_.string());
    if (slot_ < 0)
      throw file_error(path, "cannot be written: the path is too long, or too many files are open");
    wait_if_ending(temporary_);
    descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) {
    const int reason = errno;
    release_slot(slot_);
    const fs::path folder = path_.parent_path();
    if (folder.empty() || fs::exists(folder, error)) throw write_error(path, reason);
    throw file_error(path, "cannot be written: there is no folder " + folder.string());
  }
  close(descriptor);
  if (buffer_.open(temporary_, std::ios::out | std::ios::binary) == nullptr) {
    const int reason = errno;
    unlink(temporary_.c_str());
    release_slot(slot_);
    throw write_error(path, reason);
  }
  wait_if_ending(temporary_);
  if (fs::exists(status)) fs::permissions(temporary_, status.permissions(), error);
}

AtomicFile::~AtomicFile() {
  if (slot_ < 0) return;
  buffer_.close();
  unlink(temporary_.c_str());
  release_slot(slot_);
}

void AtomicFile::commit() {
  errno = 0;
  const bool closed = buffer_.close() != nullptr;
  if (!closed || !stream_) throw write_error(path_, buffer_.error() != 0 ? buffer_.error() : errno);
  if (slot_ < 0) return;
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throw write_error(path_);
  release_slot(slot_);
  slot_ = -1;
}

}  // namespace edgewise
