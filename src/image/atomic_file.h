// A file that appears under its final name only when it is whole.
#pragma once

#include <filesystem>
#include <fstream>

namespace edgewise {

// Writes to a temporary file beside `path` and renames it on commit(). Without commit(), and on SIGINT,
// SIGTERM or SIGHUP, the temporary file is removed and an older file under the final name stays as it was.
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
  std::ofstream stream_;
  int slot_ = -1;  // in the list that the signal handler reads
};

// Removes the temporary files of all AtomicFiles. Async-signal-safe, for a program with signal handlers of
// its own.
void remove_unfinished_files();

}  // namespace edgewise
