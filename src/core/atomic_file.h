// A file that appears under its final name only when it is complete.
#pragma once

#include <array>
#include <filesystem>
#include <ostream>
#include <streambuf>

namespace edgewise {

// Writes to an open file, and keeps errno of the first failure, which streams do not report.
class FileBuffer final : public std::streambuf {
 public:
  ~FileBuffer() override { close(); }

  void attach(int descriptor);  // closes it at the end
  int descriptor() const { return descriptor_; }
  bool close();                         // writes what is buffered; false if anything could not be written
  int error() const { return error_; }  // 0 if nothing failed

 private:
  int_type overflow(int_type c) override;
  int sync() override;

  std::array<char, 1 << 14> buffer_;
  int descriptor_ = -1, error_ = 0;
};

// Writes to a temporary file beside `path` and renames it on commit(). Without commit(), and on SIGINT,
// SIGTERM, SIGHUP or SIGQUIT, the temporary file is removed and an older file under the final name stays
// unchanged. A symbolic link is kept: its target is written, even if that does not exist yet. Devices, pipes
// and names of open descriptors (/dev/stdout) are written directly.
//
// An older file that cannot be replaced by renaming (a mount point, a file in an unwritable folder) is
// overwritten on commit(), after its space was reserved. Signals wait for that. If the device fails or
// SIGKILL arrives meanwhile, the file is left partly overwritten.
class AtomicFile {
 public:
  // Throws std::runtime_error, naming the file and the reason, if the folder cannot be written.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  // Throws std::runtime_error if anything could not be written (a full disk, say). A pipe that its reader has
  // closed counts as written.
  void commit();

 private:
  bool open_directly(const std::filesystem::file_status& status);
  bool make_temporary();
  void overwrite();

  std::filesystem::path path_, target_, temporary_;  // target_: path_ after its symbolic links
  bool direct_ = false;
  FileBuffer buffer_;
  std::ostream stream_{&buffer_};
  int slot_ = -1;  // in the signal handler's table; -1: none
};

// The file that a path names after its symbolic links, which need not exist. Stops at names of descriptors.
std::filesystem::path after_links(std::filesystem::path path);

// Removes the temporary files of all AtomicFiles. A thread that begins another one afterwards blocks for
// ever, so call this right before the process ends. Async-signal-safe, for programs with their own signal
// handlers.
void remove_unfinished_files();

}  // namespace edgewise
