// A file that appears under its final name only when it is whole.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>

namespace edgewise {

// Streams don't tell why they fail; this keeps the reason.
class FileBuffer final : public std::filebuf {
 public:
  int error() const { return error_; }  // errno of the first failure; 0 if none is known

 private:
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int_type overflow(int_type c) override;
  int sync() override;
  void note(bool failed);

  int error_ = 0;
};

// Writes to a temporary file beside `path` and renames it on commit(). Without commit(), and on SIGINT,
// SIGTERM, SIGHUP or SIGQUIT, the temporary file is removed and an older file under the final name stays as
// it was.
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
  int slot_ = -1;  // in the list that the signal handler reads
};

// Removes the temporary files of all AtomicFiles; whoever begins one from then on waits. To be called right
// before the process ends. Async-signal-safe, for a program with signal handlers of its own.
void remove_unfinished_files();

}  // namespace edgewise
