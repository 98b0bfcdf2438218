// A file that appears under its final name only when it is complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>

namespace edgewise {

// Keeps errno of the first failure, which streams do not report.
class FileBuffer final : public std::filebuf {
 public:
  int error() const { return error_; }  // 0 if no failure is known

 private:
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int_type overflow(int_type c) override;
  int sync() override;
  void note(bool failed);

  int error_ = 0;
};

// Writes to a temporary file beside `path` and renames it on commit(). Without commit(), and on SIGINT,
// SIGTERM, SIGHUP or SIGQUIT, the temporary file is removed and an older file under the final name stays
// unchanged. Devices and pipes are written directly.
class AtomicFile {
 public:
  // Throws std::runtime_error, naming the file and the reason, if the folder cannot be written.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  // Throws std::runtime_error if anything could not be written (a full disk, say).
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  FileBuffer buffer_;
  std::ostream stream_{&buffer_};
  int slot_ = -1;  // in the signal handler's table; -1: none
};

// Removes the temporary files of all AtomicFiles. A thread that begins another one afterwards blocks for
// ever, so call this right before the process ends. Async-signal-safe, for programs with their own signal
// handlers.
void remove_unfinished_files();

}  // namespace edgewise
