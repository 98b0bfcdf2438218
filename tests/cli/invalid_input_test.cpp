// Runs the rows of invalid_inputs.h: each must print a clear message, return the documented exit status, and
// leave no incomplete file under its final name. No row may crash.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "cli/invalid_inputs.h"
#include "edgewise/image.h"
#include "edgewise/tri_file.h"
#include "run_program.h"
#include "temp_dir.h"

namespace edgewise::testing {

void PrintTo(const InvalidInputRow& row, std::ostream* out) {
  *out << row.script;
}

namespace {

constexpr int kSkipped = 77;

// `stopped SIGNAL COMMAND…` sends the signal to a command after a second, and returns its status.
// `unprivileged COMMAND…` runs a command as a user without root's permissions, or skips the row. Each call
// uses another user, because process limits count per user. `isolated SCRIPT` runs a script whose mounts end
// with it, or skips the row.
constexpr const char* kWords = R"(
set -m
for descriptor in {3..20}; do eval "exec $descriptor>&-"; done  # descriptors that ctest leaves open
edgewise() { "$EDGEWISE" "$@"; }
bench() { "$BENCH" "$@"; }
SHORT='--no-peers --scene cube --size 32x32 --quick --benchmark_min_time=0.001'
program() { case $1 in edgewise) shift; exec "$EDGEWISE" "$@" ;; bench) shift; exec "$BENCH" "$@" ;; esac; }
stopped() {
  local signal=$1; shift
  exec 3>&2 2>/dev/null
  program "$@" >/dev/null 2>&3 &
  sleep 1
  kill -s "$signal" $!
  wait $!
}
isolated() {
  unshare -m true 2>/dev/null || exit 77
  unshare -m bash -c "$1"
}
unprivileged() {
  local somebody="--reuid=$((100000 + $$)) --regid=65534 --clear-groups"
  chmod 755 "$IN"
  if (($(id -u) != 0)); then
    program "$@"
  elif setpriv $somebody test -x "$EDGEWISE" -a -x "$IN"; then
    [[ $1 == bench ]] && set -- "$BENCH" "${@:2}" || set -- "$EDGEWISE" "${@:2}"
    setpriv $somebody "$@"
  else
    exit 77
  fi
}
)";

void write_inputs(const TempDir& folder) {
  using namespace std::string_literals;
  const auto le = [](std::uint32_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
    return bytes;
  };
  const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  folder.write("good.obj", kCorners + "f 1 2 3\n");
  folder.write("index.obj", kCorners + "f 1 2 9\n");
  folder.write("tiny.obj", "v 0 0 0\nv 1e-40 0 0\nv 0 1e-40 0\nf 1 2 3\n");
  folder.write("mesh.stl", "solid");
  folder.write("cut.tri", "TRI1\1");
  std::string floats;  // a triangle with infinity, one with NaN, a valid one
  for (const std::uint32_t first : {0x7F800000u, 0x7FC00000u, 0x3F800000u})
    floats +=
        le(first) + le(0) + le(0) + le(0x41000000) + le(0) + le(0) + le(0) + le(0x41000000) + le(0) + le(7);
  folder.write("nan.tri", "TRI1" + le(8) + le(8) + le(3) + floats);
  folder.write("large.tri", "TRI1" + le(4) + le(4) + le((1 << 30) + 1));
  folder.write("wide.png",
               "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\x0f\x42\x40\0\x0f\x42\x40\x08\x02\0\0\0\xd3\x0f\xaf\x2a"s);
  folder.write("small.ppm", "P6\n1 1\n255\nabc");
  folder.write("other.ppm", "P6\n1 1\n255\nxyz");
  folder.write("large.ppm", "P6\n2 1\n255\nabcdef");
  folder.write("depth.pfm", "Pf\n1 1\n-1.0\n\0\0\0\0"s);
}

void expect_whole(const std::filesystem::path& file) {
  const std::string name = file.filename();
  if (std::filesystem::is_directory(file)) {
    for (const auto& entry : std::filesystem::directory_iterator(file)) expect_whole(entry.path());
  } else if (name.starts_with("older")) {
    EXPECT_EQ(file_content(file), "older");
  } else if (file.extension() == ".json") {
    EXPECT_FALSE(nlohmann::json::parse(file_content(file), nullptr, false).is_discarded());
  } else if (is_image_path(file)) {
    EXPECT_NO_THROW(read_image(file));
  } else if (file.extension() == ".pfm") {
    EXPECT_NO_THROW(read_pfm(file));
  } else if (file.extension() == ".tri") {
    EXPECT_NO_THROW(read_tri(file));
  }
}

// Sanitizers reserve more memory than the limits allow, and need files and a thread of their own.
bool starves_sanitizers([[maybe_unused]] const std::string& script) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  for (const auto limit : {"ulimit -v", "ulimit -u"})
    if (script.find(limit) != std::string::npos) return true;
  return false;
#else
  return false;
#endif
}

// Resets signals to their defaults, because a shell keeps ignored ones ignored, and kills a script that
// hangs.
Outcome run_script(const std::string& script, const TempDir& folder, const TempDir& input) {
  const auto file = input.write("script", kWords + script);
  return run_program("/usr/bin/env", "--default-signal=HUP,INT,QUIT,TERM DIR='" + folder.path().string() +
                                         "' IN='" + input.path().string() +
                                         "' EDGEWISE='" EDGEWISE_PROGRAM "' BENCH='" EDGEWISE_BENCH
                                         "' timeout -s KILL 60 bash '" +
                                         file.string() + "'");
}

class InvalidInput : public ::testing::TestWithParam<InvalidInputRow> {};

TEST_P(InvalidInput, HasTheOutcomeInTheTable) {
  const InvalidInputRow& row = GetParam();
  const std::string script = row.script;
  if (starves_sanitizers(script)) GTEST_SKIP() << "sanitizers need more than the limit";
  const TempDir folder, input;
  write_inputs(input);
  const Outcome outcome = run_script(script, folder, input);
  if (outcome.status == kSkipped) GTEST_SKIP() << "no unprivileged user can run the program here";
  EXPECT_EQ(outcome.status, row.status) << outcome.err;
  EXPECT_NE(outcome.err.find(row.said), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos) << "no control characters";
  if (outcome.status == 2 && *row.said != '\0' && script.find("bench ") == std::string::npos) {
    EXPECT_TRUE(outcome.err.starts_with("edgewise: ")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << "one line: " << outcome.err;
  }

  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const std::string name = entry.path().filename();
    // What a stopped process leaves where the file system has no unnamed files.
    if (script.find("stopped ") != script.npos && name.starts_with(".edgewise.")) continue;
    left.push_back(name);
    expect_whole(entry.path());
  }
  std::sort(left.begin(), left.end());
  std::string listing;
  for (const std::string& name : left) listing += (listing.empty() ? "" : " ") + name;
  EXPECT_EQ(listing, row.left);
}

INSTANTIATE_TEST_SUITE_P(Table, InvalidInput, ::testing::ValuesIn(kInvalidInputs));

// Memory may run out anywhere. On one thread, because oneTBB may hang. Below some limit, the system's loader
// cannot load the program, and prints its own message.
TEST(LimitedMemory, WritesAFileOrOneLineOfErrorAtEveryLimit) {
  if (starves_sanitizers("ulimit -v")) GTEST_SKIP() << "sanitizers need more than the limit";
  int done = 0, refused = 0;
  for (const std::string command : {"edgewise render torus-knot --size 1900x1900 --threads 1 -o $DIR/a.png",
                                    "edgewise capture terrain -o $DIR/a.tri",
                                    "edgewise stability cycle --quick --threads 1 --json $DIR/a.json"})
    for (const int kib : {16'000, 20'000, 30'000, 40'000, 50'000, 60'000, 80'000, 150'000, 300'000}) {
      const TempDir folder, input;
      const std::string limit = "ulimit -v " + std::to_string(kib) + "; ", script = limit + command;
      if (run_script(limit + "edgewise --version", folder, input).status == 127) continue;
      const Outcome outcome = run_script(script, folder, input);
      const bool wrote = outcome.status == 0;
      EXPECT_TRUE(wrote || outcome.status == 2) << script << ": " << outcome.status << outcome.err;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), wrote ? 0 : 1) << script;
      for (const auto& entry : std::filesystem::directory_iterator(folder.path())) expect_whole(entry.path());
      EXPECT_EQ(folder.count(), wrote ? 1u : 0u) << script;
      ++(wrote ? done : refused);
    }
  EXPECT_GT(done, 3);
  EXPECT_GT(refused, 3);
}

}  // namespace
}  // namespace edgewise::testing
