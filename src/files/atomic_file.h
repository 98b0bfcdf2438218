// A file that appears under its final name only when it is complete.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>

namespace edgewise {

// Writes all bytes to an open file. Returns 0, or errno of the failure.
int write_all(int descriptor, std::string_view bytes);

// Keeps what is written in memory. commit() writes it to ".edgewise.*.partial" in the folder of `path`, and
// renames that. A process that is killed meanwhile leaves it. An older file under the final name stays as it
// is until commit() replaces it, and keeps its permissions. A symbolic link is kept: its target is written,
// even if that does not exist yet. Devices, pipes and names of open descriptors (/dev/stdout) are written
// directly.
class AtomicFile {
 public:
  // Throws FileError if the folder cannot be written.
  explicit AtomicFile(const std::filesystem::path& path);

  std::ostream& stream() { return stream_; }
  // Throws FileError if anything could not be written (a full disk, say), or if the older file cannot be
  // replaced (a mount point, say). A pipe that its reader has closed counts as written.
  void commit();

 private:
  void write_directly() const;

  std::filesystem::path path_, target_;  // target_: absolute, as the current folder may change
  bool exists_ = false, direct_ = false;
  std::ostringstream stream_;
};

// The file that a path names after its symbolic links, which need not exist. Stops at names of
// descriptors, of any process.
std::filesystem::path after_links(std::filesystem::path path);

}  // namespace edgewise
