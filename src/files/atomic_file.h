// A file that appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <ostream>
#include <sstream>

namespace edgewise {

// Collects a file's content in memory. commit() writes it to ".edgewise.*.partial" in the folder of `path`,
// then renames that. An older file under the name stays as it is until then, and its permissions are kept. A
// symbolic link is kept: its target is written, even if that does not exist yet. Devices, pipes and names of
// open descriptors (/dev/stdout) are written directly.
class AtomicFile {
 public:
  // Throws FileError if the file could not be written: before long work whose result it is for. Descriptors
  // are not checked.
  explicit AtomicFile(const std::filesystem::path& path);

  std::ostream& stream() { return stream_; }
  // Throws FileError if anything could not be written (a full disk, say), or if the older file cannot be
  // replaced (a mount point, say). A pipe that its reader has closed counts as written.
  void commit();

 private:
  std::filesystem::path path_, target_;  // as given; without links, and absolute
  bool exists_ = false, direct_ = false;
  std::ostringstream stream_;
};

// The file that a path names after its symbolic links, which need not exist. Stops at names of
// descriptors, of any process.
std::filesystem::path after_links(std::filesystem::path path);

}  // namespace edgewise
