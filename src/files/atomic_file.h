// A file that appears under its final name only when it is complete.
#pragma once

#include <array>
#include <filesystem>
#include <ostream>
#include <streambuf>
#include <string>

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

// Writes to a file without a name in the folder of `path`. commit() names it ".edgewise.*.partial", then
// renames it. If the file system has no unnamed files, or /proc is missing, the unfinished file has that name
// from the start. The destructor removes it unless commit() was called; a killed process leaves it. If the
// system lets no process name unnamed files, commit() fails. An older file under the final name stays as it
// is until commit() replaces it, and keeps its permissions. A symbolic link is kept: its target is written,
// even if that does not exist yet. Devices, pipes and names of open descriptors (/dev/stdout) are written
// directly.
class AtomicFile {
 public:
  // Throws FileError if the folder cannot be written.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  // Throws FileError if anything could not be written (a full disk, say), or if the older file cannot be
  // replaced (a mount point, say). A pipe that its reader has closed counts as written.
  void commit();

 private:
  struct Folder {
    int descriptor = -1;  // none: the file is written directly
    ~Folder();
  };
  // Calls make(name) for names in the folder until one is free. False if it fails; errno says why.
  template <typename Make>
  bool make_temporary(const Make& make);
  std::string link() const;  // to the open file

  std::filesystem::path path_;
  Folder folder_;                 // stays the same if the process changes its current folder
  std::string name_, temporary_;  // in the folder; temporary_ is empty while there is none
  FileBuffer buffer_;
  std::ostream stream_{&buffer_};
};

// The file that a path names after its symbolic links, which need not exist. Stops at names of
// descriptors, of any process.
std::filesystem::path after_links(std::filesystem::path path);

}  // namespace edgewise
