// Files that are written completely or not at all. tests/cli/invalid_inputs.h tests those that cannot be.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <utility>

#include "files/atomic_file.h"
#include "message_of.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

// Also if the current folder changes before.
TEST(AtomicFile, AppearsOnCommitOnly) {
  const TempDir dir, other;
  const fs::path before = fs::current_path(), name = std::string(255, 'x');  // the longest name
  fs::current_path(dir.path());
  AtomicFile file(name), next(name), lost(name);
  fs::current_path(other.path());
  file.stream() << "new" << std::flush, next.stream() << "next", lost.stream() << "lost" << std::flush;
  EXPECT_EQ(dir.count(), 0u);
  file.commit();
  EXPECT_EQ(file_content(dir.path() / name), "new");
  next.commit();
  fs::current_path(before);
  EXPECT_EQ(file_content(dir.path() / name), "next");
  EXPECT_EQ(dir.count(), 1u);
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
  const fs::path link = dir.path() / "link", loop = dir.path() / "loop";
  fs::create_symlink("none/target", link), fs::create_symlink("loop", loop);
  EXPECT_EQ(message_of([&] { AtomicFile{dir.path()}; }), dir.path().string() + ": is a directory");
  for (const auto& [path, reason] : {std::pair(link, "there is no folder " + (dir.path() / "none").string()),
                                     {loop, "Too many levels of symbolic links"}})
    EXPECT_EQ(message_of([&] { AtomicFile{path}; }), path.string() + ": cannot be written: " + reason);
  EXPECT_EQ(dir.count(), 2u);
}

}  // namespace
}  // namespace edgewise
