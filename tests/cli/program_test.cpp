// The program's commands on valid input; invalid_inputs.h has the invalid ones.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/builtin.h"
#include "edgewise/hash.h"
#include "edgewise/image.h"
#include "lab/sweeps/sweeps.h"
#include "run_program.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

using testing::Outcome;

Outcome edgewise_with(const std::string& arguments) {
  return testing::run_program(EDGEWISE_PROGRAM, arguments);
}

TEST(Program, HelpOnEveryCommandFits100Columns) {
  for (const char* command : {"", "list", "render", "hash", "verify", "accuracy", "stability", "diff",
                              "portable", "needs", "capture", "view", "demo", "machine"}) {
    const Outcome outcome = edgewise_with(std::string(command) + " --help");
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_NE(outcome.out.find("edgewise"), std::string::npos) << command;
    EXPECT_EQ(outcome.err, "") << command;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(Program, ListsEveryRegistry) {
  const auto json = nlohmann::json::parse(edgewise_with("list --all --json").out);
  EXPECT_EQ(json.at("scenes").size(), builtin_scenes().size());
  EXPECT_EQ(json.at("backends").size(), backends().size() + compositions().size());
  EXPECT_EQ(json.at("simd_targets").size(), supported_targets().size());
  EXPECT_EQ(json.at("simd_best"), name_of(supported_targets().back()));
  const std::string text = edgewise_with("list").out, sweeps = edgewise_with("stability --list").out;
  for (const lab::Sweep& sweep : lab::sweeps()) EXPECT_NE(sweeps.find(sweep.name), std::string::npos);
  for (const SceneInfo& scene : builtin_scenes())
    EXPECT_NE(text.find(scene.name), std::string::npos) << scene.name;
}

TEST(Program, HashesAreThoseOfEveryBackendAndAddUp) {
  const std::string arguments = "hash cube medium --size 90x51 --frames 3 --json --backend ";
  const Outcome tiled = edgewise_with(arguments + "tiled --threads 3 --tile 16");
  ASSERT_EQ(tiled.status, 0) << tiled.err;
  EXPECT_EQ(edgewise_with(arguments + "naive --threads 1 --target scalar").out, tiled.out);
  const auto json = nlohmann::json::parse(tiled.out);
  const auto number = [](const std::string& hash) { return std::stoull(hash, nullptr, 16); };
  std::vector<std::uint64_t> scenes;
  for (const auto& scene : json.at("scenes")) {
    std::vector<std::uint64_t> frames;
    for (const auto& frame : scene.at("frames")) frames.push_back(number(frame));
    EXPECT_EQ(frames.front() == frames.back(), scene.at("scene") == "medium") << "the cube moves";
    scenes.push_back(hash_of_all(frames));
    EXPECT_EQ(number(scene.at("hash")), scenes.back());
  }
  EXPECT_EQ(number(json.at("hash")), hash_of_all(scenes));
}

// The sleep lets the reader exit first.
TEST(Program, EndsQuietlyWhenItsPipeIsClosed) {
  for (const std::string command :
       {EDGEWISE_PROGRAM " demo --json", EDGEWISE_PROGRAM " render --help",
        EDGEWISE_PROGRAM " render cube --size 600x400 -o - --format ppm 2>/dev/null",
        EDGEWISE_BENCH " --help", EDGEWISE_BENCH " --benchmark_list_tests"}) {
    const Outcome outcome =
        testing::run_program("/bin/bash", "-c '{ sleep 0.2; " + command + "; echo status $? >&2; } | true'");
    EXPECT_EQ(outcome.err, "status 0\n") << command;
  }
}

// Runs the program on a terminal made by script(1); `out` holds both streams.
Outcome on_terminal(const std::string& term, const std::string& arguments) {
  return testing::run_program(
      "/usr/bin/env", "TERM=" + term + " script -qec \"" EDGEWISE_PROGRAM " " + arguments + "\" /dev/null");
}

TEST(Program, SendsNoCursorControlsToADumbTerminal) {
  const std::string work = "verify cube --size 65x33";
  EXPECT_NE(on_terminal("xterm", work).out.find("\x1b[K"), std::string::npos);
  const Outcome dumb = on_terminal("dumb", work);
  EXPECT_EQ(dumb.status, 0);
  EXPECT_NE(dumb.out.find("cube"), std::string::npos);
  EXPECT_EQ(dumb.out.find('\x1b'), std::string::npos) << dumb.out;

  for (const std::string viewer : {"view --terminal", "demo outlaw-triad --terminal"}) {
    const Outcome refused = on_terminal("dumb", viewer);
    EXPECT_EQ(refused.status, 2) << viewer;
    EXPECT_EQ(refused.out.find('\x1b'), std::string::npos) << refused.out;
    EXPECT_NE(refused.out.find("cursor control"), std::string::npos) << refused.out;
  }
}

class ProgramRenders : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  // Runs bash in the folder until a command fails. `edgewise` runs the program.
  Outcome script(const std::string& text) const {
    const std::string file = folder_.write("script", "set -e; cd '" + folder_.path().string() + "'\n" +
                                                         "edgewise() { '" EDGEWISE_PROGRAM "' \"$@\"; }\n" +
                                                         "differ() { ! cmp -s \"$1\" \"$2\"; }\n" + text);
    return testing::run_program("/bin/bash", "'" + file + "'");
  }
  void expect_success(const std::string& text) const {
    const Outcome outcome = script(text);
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  }
  TempDir folder_;
};

// Files are read twice if there are several.
TEST_F(ProgramRenders, FilesWithWarningsAndPrintsEachOnce) {
  const std::string a = folder_.write("a.obj",
                                      "mtllib none.mtl\nv 5572094.001 0 0\nv 5572094.002 0 0\n"
                                      "v 5572094.001 0.001 0\nf 1 2 3\nf 1 2\n");
  const Outcome outcome = edgewise_with("render " + a + " cube --size 8x8 --no-shade -o " + path(""));
  EXPECT_EQ(outcome.err, "warning: " + a + ": line 1: " + path("none.mtl") +
                             ": No such file or directory\nwarning: " + a +
                             ": line 6: 1 face of fewer than three corners skipped\n");
  const Outcome recentred =
      edgewise_with("render " + a + " --recentre --cull none --size 8x8 --no-shade -o " + path("b.ppm"));
  EXPECT_NE(recentred.err.find("recentred by 5572094.001953125,0.0009765625,0,"), std::string::npos)
      << recentred.err;
  EXPECT_NE(file_content(path("b.ppm")).find('\xC8'), std::string::npos) << "the triangle is seen";
}

TEST_F(ProgramRenders, AStreamCroppedNotScaled) {
  ASSERT_EQ(edgewise_with("capture grid4 --size 64x64 -o " + path("a.tri")).status, 0);
  ASSERT_EQ(edgewise_with("render " + path("a.tri") + " -o " + path("whole.png")).status, 0);
  ASSERT_EQ(edgewise_with("render " + path("a.tri") + " --size 32x100 -o " + path("part.png")).status, 0);
  const Image whole = read_image(path("whole.png")), part = read_image(path("part.png"));
  ASSERT_EQ(part.width, 32);
  ASSERT_EQ(part.height, 100);
  EXPECT_EQ(part.pixels[31 + 63 * 32], whole.pixels[31 + 63 * 64]);
  EXPECT_EQ(part.pixels[31 + 64 * 32] & 0xFFFFFFu, 0u);
}

TEST_F(ProgramRenders, FilesOfAnyNameAndPrintsNoControlCharacters) {
  const std::string name = path("x\x1b[31m\xff\xc3\xa9.tri");
  ASSERT_EQ(edgewise_with("capture grid4 --size 40x30 -o " + path("a.tri")).status, 0);
  std::filesystem::rename(path("a.tri"), name);
  for (const std::string& command : {"render -o " + path("") + " ", std::string("verify ")}) {
    const Outcome outcome = edgewise_with(command + "'" + name + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("x?[31m?\xc3\xa9"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos);
  }
  const auto json = nlohmann::json::parse(edgewise_with("verify --json - '" + name + "'").out);
  EXPECT_EQ(json.at("scenes")[0].at("scene"), "x\x1b[31m\xef\xbf\xbd\xc3\xa9");
}

TEST_F(ProgramRenders, TheSamePictureInEveryFormatAndByEveryBackend) {
  std::string names;
  for (const BackendInfo& backend : backends()) names += " " + std::string(backend.name);
  expect_success("names='" + names + "'\n" + R"(
edgewise render cube --size 97x61 -o a.png --depth a.pfm
for name in $names; do
  edgewise render cube --size 97x61 --threads 3 --backend $name -o b.ppm --depth b.pfm
  edgewise diff a.png b.ppm
  edgewise diff a.pfm b.pfm
done
edgewise render cube --size 97x61 --time 1 --depth c.pfm
differ a.pfm c.pfm
edgewise render grid4 --size 101x67 --payload hits --json -o hits.png | grep -E '"1": ?6767[,}]'
)");
}

TEST_F(ProgramRenders, NumberedFramesOfAnAnimation) {
  expect_success(R"(
edgewise render cube --size 32x32 --frames 3 --fps 2 -o {scene}.png
edgewise render cube --size 32x32 --time 1 -o one.png
[[ $(echo cube*) == 'cube-0001.png cube-0002.png cube-0003.png' ]]
cmp cube-0003.png one.png
differ cube-0001.png one.png
)");
}

// Positions of a mesh with 15 subpixel bits do not fit floats beyond 512 px. Those of a stream of floats do.
TEST_F(ProgramRenders, ACaptureOfAnySubpixelBitsAsTheSceneItCameFrom) {
  expect_success(R"(
while read -r bits format scene; do
  options="--cull none --subpixel-bits $bits"
  edgewise capture $scene --size 640x360 $options -o a.tri
  [[ $(head -c 4 a.tri) == $format ]]
  for drawn in a.tri - "$scene --size 640x360"; do
    edgewise hash $drawn $options <a.tri >hash
    head -c 16 hash && echo
  done | sort -u >>hashes
  edgewise verify a.tri --subpixel-bits $bits
done <<END
4 TRI1 medium --scale 0.01
8 TRI1 medium --scale 0.01
12 TRI1 medium --scale 0.01
15 TRI2 cubes
END
[[ $(wc -l <hashes) == 4 && $(sort -u hashes | wc -l) == 4 ]]
edgewise verify --size 65x33
edgewise view cubes --size 90x50 --subpixel-bits 4 -o b.png
edgewise view cubes --size 90x50 -o c.png
differ b.png c.png
)");
}

TEST_F(ProgramRenders, ToStandardOutputWithMessagesOnStandardError) {
  expect_success(R"(
same() {  # FILE COMMAND...: what the command writes to a pipe, and to a file that holds something
  edgewise "${@:2}" 2>err | cmp - $1
  echo before >out
  edgewise "${@:2}" >>out 2>>err || true
  echo after >>out
  cmp out <(echo before; cat $1; echo after)
  if grep -e '-> /dev/stdout' err; then exit 1; fi
}
scene='cube --size 60x40'; seen='cubes --size 960x540 --keys ve'
edgewise render $scene -o a.png --depth a.pfm
edgewise portable $scene -o mask.png
edgewise capture $scene -o a.tri
edgewise view $seen -o view.png
edgewise demo outlaw-triad -o demo.png
edgewise diff a.png mask.png -o difference.png || true
same a.png render $scene -o -
same a.png render $scene -o - --format png --json
same a.png render $scene -o /dev/stdout
same a.pfm render $scene -o - --format pfm
same a.pfm render $scene --depth -
same mask.png portable $scene -o -
same a.tri capture $scene -o -
same difference.png diff a.png mask.png -o -
same view.png view $seen -o -
same demo.png demo outlaw-triad -o -
)");
}

TEST_F(ProgramRenders, FormatsOfStandardOutputAndOfFolders) {
  expect_success(R"(
edgewise render cube --size 60x40 -o a.ppm
edgewise render cube sphere --size 60x40 -o new/ --format ppm
cmp a.ppm new/cube.ppm
[[ -e new/sphere.ppm ]]
edgewise render cube --size 60x40 -o - --format ppm | cmp - a.ppm
edgewise render cube --size 60x40 --frames 2 -o - --format ppm >film
cmp -n $(stat -c %s a.ppm) film a.ppm
[[ $(stat -c %s film) == $((2 * $(stat -c %s a.ppm))) ]]
)");
}

// Some commands load a scene more than once, or ask for its kind first.
TEST_F(ProgramRenders, FilesFromStandardInput) {
  expect_success(R"(
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >stdin.obj
edgewise render stdin.obj --size 60x40 -o obj.png --depth obj.pfm
edgewise render stdin.obj --size 60x40 -o obj.ppm
edgewise capture stdin.obj --size 60x40 -o stdin.tri
edgewise render stdin.tri -o tri.png
for kind in obj tri; do
  file=stdin.$kind
  for read in 'cat $file | edgewise render -' 'edgewise render - <$file' \
      'edgewise render /dev/stdin <$file' 'edgewise render <(cat $file)'; do
    eval "$read --size 60x40 -o a.png"
    edgewise diff a.png $kind.png
  done
  for command in 'verify - --size 65x33' 'verify -' 'needs - --size 65x33' 'portable - --size 65x33' \
      'capture - -o a.tri' 'accuracy - --quick --family coverage' 'view - -o a.png'; do
    cat $file | edgewise $command
  done
done
cat obj.png | edgewise diff - obj.ppm
cat obj.ppm | edgewise diff obj.png /dev/stdin
cat obj.pfm | edgewise diff - obj.pfm
edgewise diff - obj.png <obj.png
edgewise diff <(cat obj.ppm) <(cat obj.png)
cat tri.png | edgewise diff tri.png obj.png --mask -
)");
}

TEST_F(ProgramRenders, FilesWhoseSamplesAreEqualOrDiffer) {
  using namespace std::string_literals;
  folder_.write("a.ppm", "P6\n2 1\n255\n\1\2\3\xff\0\x80"s);
  folder_.write("b.ppm", "P6 2# width\n1 65535\r\n\1\1\2\2\3\3\xff\xff\0\0\x80\x80"s);
  folder_.write("c.ppm", "P6 2 1 65535\n\1\1\2\2\3\3\xff\xff\0\0\x80\x81"s);
  EXPECT_EQ(script("edgewise diff a.ppm b.ppm").out, "equal: 2 pixels\n");
  EXPECT_EQ(script("edgewise diff a.ppm c.ppm").out,
            "1 of 2 pixels differ, by up to 1 of 65535; the first at x 1, y 0\n");
  EXPECT_EQ(script("edgewise diff --json a.ppm c.ppm").out,
            "{\"differing\":1,\"first\":[1,0],\"largest\":1.0,\"pixels\":2,\"scale\":65535}\n");
  // A mask of 16 bits counts by its samples, which 8 bits would round to black.
  folder_.write("mask.ppm", "P6 2 1 65535\n\0\0\0\0\0\0\0\0\0\0\0\1"s);
  EXPECT_EQ(script("edgewise diff a.ppm c.ppm --mask mask.ppm").status, 0);
}

TEST_F(ProgramRenders, AGoldenPictureWithTheBitsOfTheMask) {
  expect_success(R"(
while read -r bits drawn; do
  edgewise portable torus-knot --size 200x120 --ids --bits $bits --picture golden.png -o mask.png
  edgewise render torus-knot --size 200x120 --payload id --subpixel-bits $drawn -o ids.png
  edgewise diff golden.png ids.png
  edgewise diff golden.png ids.png --mask mask.png
done <<END
4 8
9 9
15 15
END
)");
}

TEST(Program, NeedsFits80Columns) {
  const Outcome outcome = edgewise_with("needs cube cubes --size 96x54 --tolerance 5");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_NE(outcome.out.find("proven: the nearest vertex is at "), std::string::npos);
}

TEST(Program, NeedsFollowsMotionAndOrbit) {
  const auto judged = [](const std::string& options) {
    return nlohmann::json::parse(edgewise_with("needs cube --size 96x54 --json " + options).out);
  };
  EXPECT_EQ(judged("").at("frames"), 1);
  EXPECT_EQ(judged("--frames 4").at("frames"), 4);
  // Straight above and below, where an orbit needs another axis.
  for (const std::string eye : {"0,6,0", "-0,-6,0"})
    EXPECT_EQ(judged("--orbit 3 --eye " + eye).at("frames"), 3);
  const auto orbit = judged("--orbit 5");
  EXPECT_EQ(orbit.at("frames"), 5);
  EXPECT_EQ(orbit.at("minima").empty(), orbit.contains("closest"));
}

TEST_F(ProgramRenders, AnEmptyPictureAndSaysWhy) {
  const std::pair<const char*, const char*> reasons[] = {
      {"--eye 0,0,9 --yaw 180", "12 triangles outside the view"},
      {"--cull both", "12 triangles culled by facing"},
      {"--eye 90,0,0 --far 100 --at 0,0,0 --size 1x2 --fov 45", "that cover no pixel centre"}};
  for (const auto& [options, reason] : reasons) {
    const Outcome outcome = edgewise_with("render cube " + std::string(options) + " -o " + path("a.ppm"));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(edgewise_with("render cube -o " + path("a.ppm")).err, "");
  EXPECT_EQ(edgewise_with("render cube --wireframe -o " + path("a.ppm")).err, "");
}

}  // namespace
}  // namespace edgewise
