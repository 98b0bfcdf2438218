// Files that are written completely or not at all, and files that are read.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <iterator>
#include <vector>

#include "core/input_file.h"
#include "files/atomic_file.h"
#include "message_of.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

namespace fs = std::filesystem;

using Reasons = std::vector<std::pair<fs::path, std::string>>;

void write_file(const fs::path& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

// The unfinished file has no name where the file system allows that, and another process cannot remove it.
TEST(AtomicFile, AppearsOnCommitOnly) {
  const TempDir dir;
  const fs::path path = dir.path() / std::string(255, 'x');  // the longest name
  const int unnamed = open(dir.path().c_str(), O_TMPFILE | O_WRONLY, 0600);
  {
    AtomicFile file(path), next(path), lost(path);
    file.stream() << "new" << std::flush, next.stream() << "next", lost.stream() << "lost" << std::flush;
    EXPECT_EQ(dir.count(), unnamed < 0 ? 3u : 0u);
    EXPECT_FALSE(fs::exists(path));
    file.commit();
    EXPECT_EQ(file_content(path), "new");
    next.commit();
  }
  EXPECT_EQ(file_content(path), "next");
  EXPECT_EQ(dir.count(), 1u);
  close(unnamed);
}

// A link may also dangle, or lead to another one.
TEST(AtomicFile, ReplacesALinksTargetAndKeepsItsMode) {
  const TempDir dir;
  const fs::path path = dir.path() / "target", first = dir.path() / "first";
  fs::create_directory(dir.path() / "folder");
  fs::create_symlink("folder/second", first);
  fs::create_symlink("../target", dir.path() / "folder" / "second");
  AtomicFile(first).stream() << "lost";
  EXPECT_FALSE(fs::exists(path));
  for (const std::string text : {"new", "newer"}) {
    write_file(first, text);
    EXPECT_EQ(file_content(path), text);
    EXPECT_EQ(fs::read_symlink(first), "folder/second");
    EXPECT_EQ(fs::read_symlink(dir.path() / "folder" / "second"), "../target");
    EXPECT_EQ(dir.count(), 3u);
    fs::permissions(path, fs::perms(0600));
  }
  EXPECT_EQ(fs::status(path).permissions(), fs::perms(0600));
}

// Also through a link, and another process's; the file keeps its place, and what follows is appended.
TEST(AtomicFile, WritesToOpenDescriptorsWhereTheyStand) {
  const TempDir dir;
  const fs::path path = dir.write("a", "older "), link = dir.path() / "link";
  const int descriptor = open(path.c_str(), O_WRONLY | O_APPEND);
  const std::string name = "/dev/fd/" + std::to_string(descriptor);
  fs::create_symlink(name, link);
  for (const fs::path& output : {fs::path(name), link}) write_file(output, "new ");
  EXPECT_EQ(file_content(path), "older new new ");
  fs::remove(link), fs::create_hard_link(path, dir.path() / "same");
  fs::create_symlink("/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor), link);
  write_file(link, "newer");
  close(descriptor);
  EXPECT_EQ(file_content(path), "newer");
  EXPECT_EQ(fs::hard_link_count(path), 2u) << "the same file";
  EXPECT_TRUE(fs::is_symlink(link));
}

TEST(AtomicFile, ImpossibleTargetsAreRefusedAtOnce) {
  const TempDir dir;
  const fs::path file = dir.write("a", ""), link = dir.path() / "link", loop = dir.path() / "loop";
  fs::create_symlink("none/target", link), fs::create_symlink("loop", loop);
  EXPECT_EQ(message_of([&] { AtomicFile{dir.path()}; }), dir.path().string() + ": is a directory");
  const std::string no_folder = "there is no folder " + (dir.path() / "none").string();
  for (const auto& [path, reason] : Reasons{{dir.path() / "none" / "a", no_folder},
                                            {link, no_folder},
                                            {loop, "Too many levels of symbolic links"},
                                            {file / "b", "Not a directory"},
                                            {dir.path() / std::string(256, 'x'), "File name too long"}})
    EXPECT_EQ(message_of([&] { AtomicFile{path}; }), path.string() + ": cannot be written: " + reason);
  EXPECT_EQ(dir.count(), 3u);
}

// The current folder may change before the commit, and the mask of modes.
TEST(AtomicFile, HasTheModeAndTheFolderOfItsStart) {
  const TempDir dir, other;
  const fs::path before = fs::current_path();
  fs::current_path(dir.path());
  const mode_t mask = umask(027);
  AtomicFile file("a");
  umask(mask);
  fs::current_path(other.path());
  file.commit();
  fs::current_path(before);
  EXPECT_EQ(fs::status(dir.path() / "a").permissions(), fs::perms(0640));
  EXPECT_EQ(other.count(), 0u);
}

TEST(AtomicFile, AFileThatCannotBeReplacedStays) {
  const TempDir dir;
  const fs::path path = dir.path() / "a";
  AtomicFile file(path);
  file.stream() << "new";
  fs::create_directory(path);  // as a mount point, which needs privileges: no file can be renamed over it
  EXPECT_EQ(message_of([&] { file.commit(); }), path.string() + ": cannot be replaced: Is a directory");
  EXPECT_TRUE(fs::is_directory(path));
}

// Opening a named pipe would wait for a writer, and closing it would break one.
TEST(InputFile, PipesDevicesFoldersAndMissingFilesAreRefusedWithoutOpeningThem) {
  const TempDir dir;
  const fs::path pipe = dir.path() / "pipe", none = dir.path() / "none";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& [path, why] : Reasons{{pipe, "is not a regular file"},
                                         {"/dev/zero", "is not a regular file"},
                                         {dir.path(), "is a directory"},
                                         {none, "No such file or directory"}})
    EXPECT_EQ(message_of([&] { open_input(path); }), path.string() + ": " + why);
}

// The same number may stand for another pipe later.
TEST(InputFile, DescriptorsAreReadWhenTheyAreNamed) {
  for (const std::string content : {"first", "second"}) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const int number = dup2(ends[0], 99);
    ASSERT_EQ(write(ends[1], content.data(), content.size()), static_cast<ssize_t>(content.size()));
    close(ends[0]), close(ends[1]);
    const InputFile file = open_input("/dev/fd/99");
    EXPECT_TRUE(starts_with(file, content.substr(0, 2)));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(*file.stream), {}), content);
    EXPECT_EQ(file.size, content.size());
    close(number);
  }
}

}  // namespace
}  // namespace edgewise
