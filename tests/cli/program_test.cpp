// The program's commands on valid input; invalid_inputs.h has the invalid ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/builtin.h"
#include "edgewise/hash.h"
#include "edgewise/image.h"
#include "run_program.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

using testing::Outcome;

Outcome edgewise_with(const std::string& arguments) {
  return testing::run_program(EDGEWISE_PROGRAM, arguments);
}

std::vector<std::string> names_in(const nlohmann::json& list) {
  std::vector<std::string> names;
  for (const auto& entry : list) names.push_back(entry.is_string() ? entry : entry.at("name"));
  return names;
}

template <typename Registry>
std::vector<std::string> names_of(const Registry& registry) {
  std::vector<std::string> names;
  for (const auto& entry : registry) names.emplace_back(entry.name);
  return names;
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

TEST(Program, ListNamesAllRegistries) {
  const Outcome outcome = edgewise_with("list --json");
  ASSERT_EQ(outcome.status, 0);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(names_in(json.at("scenes")), names_of(builtin_scenes()));
  EXPECT_EQ(names_in(json.at("backends")), names_of(backends()));
  std::vector<std::string> targets;
  for (const SimdTarget target : supported_targets()) targets.emplace_back(name_of(target));
  EXPECT_EQ(names_in(json.at("simd_targets")), targets);
  EXPECT_EQ(json.at("simd_best"), targets.back());
  EXPECT_EQ(names_in(json.at("cull_modes")), (std::vector<std::string>{"none", "back", "front", "both"}));

  const auto all = names_in(nlohmann::json::parse(edgewise_with("list --all --json").out).at("backends"));
  auto expected = names_of(backends());
  for (const auto& name : names_of(compositions())) expected.push_back(name);
  EXPECT_EQ(compositions().size(), 10u);
  EXPECT_EQ(all, expected);

  const std::string text = edgewise_with("list").out;
  for (const auto& name : names_of(builtin_scenes())) EXPECT_NE(text.find(name), std::string::npos) << name;
}

TEST(Program, HashesAreThoseOfEveryBackendAndAddUp) {
  const std::string arguments = "hash cube medium --size 90x51 --frames 3 --json --backend ";
  const Outcome tiled = edgewise_with(arguments + "tiled --threads 3 --tile 16");
  ASSERT_EQ(tiled.status, 0) << tiled.err;
  EXPECT_EQ(edgewise_with(arguments + "naive --threads 1 --target scalar").out, tiled.out);
  const auto json = nlohmann::json::parse(tiled.out);
  const auto number = [](const nlohmann::json& hash) {
    return std::stoull(hash.get<std::string>(), nullptr, 16);
  };
  std::vector<std::uint64_t> scenes;
  for (const auto& scene : json.at("scenes")) {
    std::vector<std::uint64_t> frames;
    for (const auto& frame : scene.at("frames")) frames.push_back(number(frame));
    EXPECT_EQ(frames.size(), 3u);
    EXPECT_EQ(frames.front() == frames.back(), scene.at("scene") == "medium") << "the cube moves";
    scenes.push_back(hash_of_all(frames));
    EXPECT_EQ(number(scene.at("hash")), scenes.back());
  }
  EXPECT_EQ(number(json.at("hash")), hash_of_all(scenes));
}

TEST(Program, HashesOfFilesAreThoseOfTheirPictures) {
  const TempDir folder;
  const std::string file = (folder.path() / "cube.tri").string();
  ASSERT_EQ(edgewise_with("capture cube --size 64x48 -o " + file).status, 0);
  const Outcome outcome = edgewise_with("hash " + file);
  EXPECT_NE(outcome.out.find("  cube (64x48)\n"), std::string::npos) << outcome.out << outcome.err;
  EXPECT_EQ(edgewise_with("hash - <" + file).out.substr(0, 16), outcome.out.substr(0, 16));
}

TEST(Program, MachineIsDescribedWithoutAHostName) {
  const auto json = nlohmann::json::parse(edgewise_with("machine").out);
  for (const char* key : {"cpu_model", "cpu_features", "cores", "usable_cores", "caches", "memory_gib", "os",
                          "kernel", "compiler", "flags", "build_type", "edgewise_version", "commit",
                          "packages", "simd_targets", "simd_best"})
    EXPECT_TRUE(json.contains(key)) << key;
  const std::string name = edgewise_with("machine --name").out;
  EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-\n"), std::string::npos) << name;
  EXPECT_TRUE(name.ends_with("-core\n") || name.ends_with("-cores\n")) << name;
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
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      all.insert(entry.path().filename().string());
    return all;
  }
  // Writes NAME.png and NAME.pfm.
  void draw(const std::string& scene, const std::string& name) const {
    const Outcome outcome =
        edgewise_with("render " + scene + " -o " + path(name + ".png") + " --depth " + path(name + ".pfm"));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  int diff(const std::string& a, const std::string& b) const {
    return edgewise_with("diff " + path(a) + " " + path(b)).status;
  }
  TempDir folder_;
};

// Files are read twice if there are several.
TEST_F(ProgramRenders, FilesWithWarningsAndPrintsEachOnce) {
  const std::string a = folder_
                            .write("a.obj",
                                   "mtllib none.mtl\nv 5572094.001 0 0\nv 5572094.002 0 0\n"
                                   "v 5572094.001 0.001 0\nf 1 2 3\nf 1 2\n")
                            .string();
  const std::string common = "render " + a + " cube --size 8x8 --no-shade -o " + path("");
  const Outcome outcome = edgewise_with(common);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "warning: " + a + ": line 1: " + path("none.mtl") +
                             ": No such file or directory\nwarning: " + a +
                             ": line 6: 1 face of fewer than three corners skipped\n");
  const Outcome recentred =
      edgewise_with("render " + a + " --recentre --cull none --size 8x8 --no-shade -o " + path("b.ppm"));
  EXPECT_EQ(recentred.status, 0);
  EXPECT_TRUE(recentred.err.ends_with(
      "\n" + a + ": recentred by 5572094.001953125,0.0009765625,0, which is subtracted from all positions\n"))
      << recentred.err;
  EXPECT_NE(file_content(path("b.ppm")).find('\xC8'), std::string::npos) << "the triangle is seen";
}

TEST_F(ProgramRenders, TheSamePictureInEveryFormatAndByEveryBackend) {
  draw("cube --size 97x61", "a");
  const Image png = read_image(path("a.png"));
  EXPECT_EQ(png.width, 97);
  EXPECT_EQ(png.height, 61);
  EXPECT_GT(std::set<std::uint32_t>(png.pixels.begin(), png.pixels.end()).size(), 3u);
  for (const BackendInfo& backend : backends()) {
    const Outcome outcome =
        edgewise_with("render cube --size 97x61 --threads 3 --backend " + std::string(backend.name) + " -o " +
                      path("b.ppm") + " --depth " + path("b.pfm"));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(read_image(path("b.ppm")).pixels, png.pixels) << backend.name;
    EXPECT_EQ(diff("a.pfm", "b.pfm"), 0) << backend.name;
  }
  ASSERT_EQ(edgewise_with("render cube --size 97x61 --time 1 --depth " + path("b.pfm")).status, 0);
  EXPECT_EQ(diff("a.pfm", "b.pfm"), 1);
}

TEST_F(ProgramRenders, NumberedFramesOfAnAnimation) {
  ASSERT_EQ(edgewise_with("render cube --size 32x32 --frames 3 --fps 2 -o " + path("{scene}.png")).status, 0);
  EXPECT_EQ(names(), (std::set<std::string>{"cube-0001.png", "cube-0002.png", "cube-0003.png"}));
  ASSERT_EQ(edgewise_with("render cube --size 32x32 --time 1 -o " + path("one.png")).status, 0);
  EXPECT_EQ(read_image(path("cube-0003.png")).pixels, read_image(path("one.png")).pixels);
  EXPECT_NE(read_image(path("cube-0001.png")).pixels, read_image(path("one.png")).pixels);
}

TEST_F(ProgramRenders, OneHitPerPixelOfAGrid) {
  const Outcome outcome =
      edgewise_with("render grid4 --size 101x67 --payload hits --json -o " + path("hits.png"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json.at("scene"), "grid4");
  EXPECT_EQ(json.at("hits").at("1"), 101 * 67);
  const Image picture = read_image(path("hits.png"));
  EXPECT_EQ(std::set<std::uint32_t>(picture.pixels.begin(), picture.pixels.end()).size(), 1u);
}

TEST_F(ProgramRenders, IdsThatCanBeReadBack) {
  ASSERT_EQ(edgewise_with("render grid64 --size 128x64 --payload id -o " + path("id.png")).status, 0);
  constexpr std::uint32_t kSpread = 0x9E3779;
  std::uint32_t inverse = 1;  // Newton's iteration doubles the number of correct bits
  for (int i = 0; i < 5; ++i) inverse *= 2 - kSpread * inverse;
  const TriangleStream stream = std::get<TriangleStream>(find_scene("grid64").make({128, 64, 0.0f, 1.0}));
  std::set<std::uint32_t> ids;
  for (const std::uint32_t pixel : read_image(path("id.png")).pixels) {
    const std::uint32_t id = ((pixel * inverse) & 0xFFFFFFu) - 1;
    ASSERT_LT(id, stream.triangles.size());
    ids.insert(id);
  }
  EXPECT_EQ(ids.size(), stream.triangles.size());
}

TEST_F(ProgramRenders, ACaptureAsTheSceneItCameFrom) {
  const std::string options = " --size 200x120 --fov 70 --cull none ";
  draw("terrain" + options, "a");
  ASSERT_EQ(edgewise_with("capture terrain" + options + "-o " + path("a.tri")).status, 0);
  draw(path("a.tri"), "b");
  EXPECT_EQ(diff("a.png", "b.png"), 0);
  // A capture rounds depths to floats, which a capture of the capture keeps.
  ASSERT_EQ(edgewise_with("capture " + path("a.tri") + " -o " + path("b.tri")).status, 0);
  draw(path("b.tri"), "c");
  EXPECT_EQ(diff("b.pfm", "c.pfm"), 0);
}

// Positions of a mesh with 15 subpixel bits do not fit floats beyond 512 px. Those of a stream of floats do.
TEST_F(ProgramRenders, ACaptureOfAnySubpixelBitsAsTheSceneItCameFrom) {
  std::set<std::string> hashes;
  for (const auto& [bits, format] : {std::pair{"4", "TRI1"}, {"8", "TRI1"}, {"12", "TRI1"}, {"15", "TRI2"}}) {
    const std::string scene =
        bits == std::string("15") ? "cubes --size 640x360" : "medium --size 640x360 --scale 0.01";
    const std::string options = std::string(" --cull none --subpixel-bits ") + bits;
    ASSERT_EQ(edgewise_with("capture " + scene + options + " -o " + path("a.tri")).status, 0);
    std::string magic(4, ' ');
    std::ifstream(path("a.tri")).read(magic.data(), 4);
    EXPECT_EQ(magic, format) << bits;
    const auto hash = [&](const std::string& drawn) {
      return edgewise_with("hash " + drawn + options).out.substr(0, 16);
    };
    EXPECT_EQ(hash(path("a.tri")), hash(scene)) << bits;
    EXPECT_EQ(edgewise_with("hash - " + options + " <" + path("a.tri")).out.substr(0, 16),
              hash(path("a.tri")));
    EXPECT_TRUE(hashes.insert(hash(path("a.tri"))).second) << bits;
    const Outcome verified =
        edgewise_with("verify " + path("a.tri") + " --subpixel-bits " + bits + " --json -");
    EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
    EXPECT_EQ(nlohmann::json::parse(verified.out).at("subpixel_bits"), std::stoi(bits));
  }
  const auto json = nlohmann::json::parse(
      edgewise_with("render cube --size 9x9 --json --subpixel-bits 13 -o " + path("a.png")).out);
  EXPECT_EQ(json.at("subpixel_bits"), 13);
  ASSERT_EQ(edgewise_with("view cubes --size 90x50 --subpixel-bits 4 -o " + path("b.png")).status, 0);
  ASSERT_EQ(edgewise_with("view cubes --size 90x50 -o " + path("c.png")).status, 0);
  EXPECT_EQ(diff("b.png", "c.png"), 1);
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
  const auto json = nlohmann::json::parse(edgewise_with("render --json '" + name + "' -o " + path("")).out);
  EXPECT_EQ(json.at("scene"), "x\x1b[31m\xef\xbf\xbd\xc3\xa9");
  EXPECT_EQ(
      nlohmann::json::parse(edgewise_with("verify --json - '" + name + "'").out).at("scenes")[0].at("scene"),
      json.at("scene"));
  for (const std::string& command : {"render -o " + path("") + " ", std::string("verify ")}) {
    const Outcome outcome = edgewise_with(command + "'" + name + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("x?[31m?\xc3\xa9"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos);
  }
  EXPECT_EQ(edgewise_with("diff '" + name + "' a").err.find('\x1b'), std::string::npos);
}

// Bash in the test's folder; `edgewise` runs the program.
Outcome script_in(const TempDir& folder, const std::string& script) {
  const auto file = folder.write("script", "cd '" + folder.path().string() +
                                               "'; edgewise() { '" EDGEWISE_PROGRAM "' \"$@\"; }\n" + script);
  return testing::run_program("/bin/bash", "'" + file.string() + "'");
}

TEST_F(ProgramRenders, ToStandardOutputWithMessagesOnStandardError) {
  const std::string scene = "scene='cube --size 60x40'; seen='cubes --size 960x540 --keys ve'\n";
  ASSERT_EQ(script_in(folder_, scene + "edgewise render $scene -o a.png --depth a.pfm\n"
                                       "edgewise portable $scene -o mask.png\n"
                                       "edgewise capture $scene -o a.tri\n"
                                       "edgewise diff a.png mask.png -o difference.png\n"
                                       "edgewise view $seen -o view.png\n"
                                       "edgewise demo outlaw-triad -o demo.png\n")
                .status,
            0);
  const std::pair<std::string, std::string> rows[] = {
      {"render $scene -o -", "a.png"},           {"render $scene -o - --format png --json", "a.png"},
      {"render $scene -o /dev/stdout", "a.png"}, {"render $scene -o - --format pfm", "a.pfm"},
      {"render $scene --depth -", "a.pfm"},      {"portable $scene -o -", "mask.png"},
      {"capture $scene -o -", "a.tri"},          {"diff a.png mask.png -o -", "difference.png"},
      {"view $seen -o -", "view.png"},           {"demo outlaw-triad -o -", "demo.png"}};
  for (const auto& [command, file] : rows) {
    const Outcome piped = script_in(folder_, scene + "edgewise " + command + " | cat");
    EXPECT_EQ(piped.out, file_content(path(file))) << command;
    EXPECT_EQ(piped.err.empty(), command.starts_with("view")) << command << piped.err;
    EXPECT_EQ(piped.err.find("-> /dev/stdout"), std::string::npos) << piped.err;
    const Outcome appended =
        script_in(folder_, scene + "echo before >out; edgewise " + command + " >>out; echo after >>out");
    EXPECT_EQ(file_content(path("out")), "before\n" + file_content(path(file)) + "after\n") << command;
  }
}

TEST_F(ProgramRenders, FormatsOfStandardOutputAndOfFolders) {
  ASSERT_EQ(script_in(folder_,
                      "edgewise render cube --size 60x40 -o a.ppm\n"
                      "edgewise render cube sphere --size 60x40 -o new/ --format ppm\n"
                      "edgewise render cube --size 60x40 -o - --format ppm >b.ppm\n"
                      "edgewise render cube --size 60x40 --frames 2 -o - --format ppm >film\n")
                .status,
            0);
  const std::string picture = file_content(path("a.ppm"));
  EXPECT_EQ(file_content(path("new/cube.ppm")), picture);
  EXPECT_TRUE(std::filesystem::exists(path("new/sphere.ppm")));
  EXPECT_EQ(file_content(path("b.ppm")), picture);
  EXPECT_EQ(file_content(path("film")).size(), 2 * picture.size());
  EXPECT_TRUE(file_content(path("film")).starts_with(picture));
}

TEST_F(ProgramRenders, FilesFromStandardInput) {
  ASSERT_EQ(script_in(folder_,
                      "printf 'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n' >stdin.obj\n"
                      "edgewise render stdin.obj --size 60x40 -o obj.png --depth obj.pfm\n"
                      "edgewise render stdin.obj --size 60x40 -o obj.ppm\n"
                      "edgewise capture stdin.obj --size 60x40 -o stdin.tri\n"
                      "edgewise render stdin.tri -o tri.png\n")
                .status,
            0);
  for (const std::string read : {"cat $file | edgewise render -", "edgewise render - <$file",
                                 "edgewise render /dev/stdin <$file", "edgewise render <(cat $file)"})
    for (const std::string kind : {"obj", "tri"}) {
      const Outcome outcome =
          script_in(folder_, "file=stdin." + kind + "; " + read +
                                 " --size 60x40 -o a.png && edgewise diff a.png " + kind + ".png");
      EXPECT_EQ(outcome.status, 0) << read << outcome.err;
    }
  for (const std::string compared :
       {"cat obj.png | edgewise diff - obj.ppm", "cat obj.ppm | edgewise diff obj.png /dev/stdin",
        "cat obj.pfm | edgewise diff - obj.pfm", "edgewise diff - obj.png <obj.png",
        "edgewise diff <(cat obj.ppm) <(cat obj.png)",
        "cat tri.png | edgewise diff tri.png obj.png --mask -"})
    EXPECT_EQ(script_in(folder_, compared).status, 0) << compared;
  // Commands that load a scene more than once, or ask for its kind first.
  for (const std::string command :
       {"verify - --size 65x33", "verify -", "needs - --size 65x33", "portable - --size 65x33",
        "capture - -o a.tri", "accuracy - --quick --family coverage", "view - -o a.png"})
    for (const std::string kind : {"obj", "tri"}) {
      const Outcome outcome = script_in(folder_, "cat stdin." + kind + " | edgewise " + command);
      EXPECT_EQ(outcome.status, 0) << command << outcome.err;
    }
}

TEST_F(ProgramRenders, FilesWhoseSamplesAreEqualOrDiffer) {
  using namespace std::string_literals;
  folder_.write("a.ppm", "P6\n2 1\n255\n\1\2\3\xff\0\x80"s);
  folder_.write("b.ppm", "P6 2# width\n1 65535\r\n\1\1\2\2\3\3\xff\xff\0\0\x80\x80"s);
  folder_.write("c.ppm", "P6 2 1 65535\n\1\1\2\2\3\3\xff\xff\0\0\x80\x81"s);
  EXPECT_EQ(script_in(folder_, "edgewise diff a.ppm b.ppm").out, "equal: 2 pixels\n");
  EXPECT_EQ(script_in(folder_, "edgewise diff a.ppm c.ppm").out,
            "1 of 2 pixels differ, by up to 1 of 65535; the first at x 1, y 0\n");
  EXPECT_EQ(script_in(folder_, "edgewise diff --json a.ppm c.ppm").out,
            "{\"differing\":1,\"first\":[1,0],\"largest\":1.0,\"pixels\":2,\"scale\":65535}\n");
  folder_.write("zero.pfm", "Pf 1 1 -1\n\0\0\0\0"s);
  folder_.write("nan.pfm", "Pf 1 1 -1\n\0\0\300\177"s);
  EXPECT_EQ(script_in(folder_, "edgewise diff --json zero.pfm nan.pfm").out,
            "{\"differing\":1,\"first\":[0,0],\"infinite\":true,\"largest\":null,\"pixels\":1}\n");
  // A mask of 16 bits counts by its samples, which 8 bits would round to black.
  folder_.write("mask.ppm", "P6 2 1 65535\n\0\0\0\0\0\0\0\0\0\0\0\1"s);
  EXPECT_EQ(script_in(folder_, "edgewise diff a.ppm c.ppm --mask mask.ppm").status, 0);
}

TEST_F(ProgramRenders, PicturesThatDiffComparesOutsideTheMask) {
  const std::string golden = path("golden.png"), mask = path("mask.png");
  const Outcome found =
      edgewise_with("portable cube --size 64x64 --bits 1 --ids --json -o " + mask + " --picture " + golden);
  ASSERT_EQ(found.status, 0) << found.err;
  const auto portable = nlohmann::json::parse(found.out);
  EXPECT_EQ(portable.at("pixels"), 64 * 64);
  EXPECT_GT(portable.at("unstable"), 0);
  EXPECT_EQ(portable.at("reasons").at("edge"), portable.at("unstable"));

  ASSERT_EQ(edgewise_with("render cube --size 64x64 --payload id -o " + path("ids.png")).status, 0);
  EXPECT_EQ(edgewise_with("diff " + golden + " " + path("ids.png")).status, 0);
  // A change of one pixel in the mask, and of one outside.
  Image ids = read_image(path("ids.png"));
  const Image marked = read_image(mask);
  const auto masked = [](std::uint32_t pixel) { return (pixel & 0xFFFFFF) != 0; };
  const auto inside = std::ranges::find_if(marked.pixels, masked) - marked.pixels.begin();
  const auto outside = std::ranges::find_if_not(marked.pixels, masked) - marked.pixels.begin();
  ids.pixels[static_cast<std::size_t>(inside)] ^= 1;
  write_image(path("ids.png"), ids);
  const std::string compared = "diff " + golden + " " + path("ids.png");
  EXPECT_EQ(edgewise_with(compared).status, 1);
  EXPECT_EQ(edgewise_with(compared + " --mask " + mask).status, 0);
  const auto in_mask = nlohmann::json::parse(edgewise_with(compared + " --json --mask " + mask).out);
  EXPECT_EQ(in_mask.at("masked"), portable.at("unstable"));
  EXPECT_EQ(in_mask.at("differing_in_mask"), 1);
  ids.pixels[static_cast<std::size_t>(outside)] ^= 1;
  write_image(path("ids.png"), ids);
  const Outcome both = edgewise_with(compared + " --mask " + mask);
  EXPECT_EQ(both.status, 1);
  EXPECT_NE(both.out.find("1 of "), std::string::npos) << both.out;
  EXPECT_NE(both.out.find(" pixels outside the mask differ, by up to 1 of 255"), std::string::npos)
      << both.out;
}

TEST_F(ProgramRenders, AGoldenPictureWithTheBitsOfTheMask) {
  for (const auto& [bits, drawn] : {std::pair{"4", "8"}, {"9", "9"}, {"15", "15"}}) {
    const std::string golden = path("golden.png"), ids = path("ids.png");
    const Outcome found =
        edgewise_with(std::string("portable torus-knot --size 200x120 --ids --json --bits ") + bits +
                      " --picture " + golden);
    ASSERT_EQ(found.status, 0) << found.err;
    EXPECT_EQ(nlohmann::json::parse(found.out).at("subpixel_bits"), std::stoi(bits));
    ASSERT_EQ(edgewise_with(std::string("render torus-knot --size 200x120 --payload id --subpixel-bits ") +
                            drawn + " -o " + ids)
                  .status,
              0);
    EXPECT_EQ(edgewise_with("diff " + golden + " " + ids).status, 0) << bits;
  }
}

TEST(Program, NeedsFits80Columns) {
  const Outcome outcome = edgewise_with("needs cube cubes --size 160x90 --tolerance 9 --threads 1");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  for (const char* part : {"least precise of 1836 pipelines, at most 9 wrong pixels in each frame",
                           "proven: the nearest vertex is at ", "edge values at 8 "})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  EXPECT_EQ(outcome.out.find("fast"), std::string::npos) << "nothing was timed";
}

TEST(Program, NeedsFollowsMotionAndOrbit) {
  const auto frames = [](const std::string& options) {
    const auto json = nlohmann::json::parse(edgewise_with("needs cube --size 96x54 --json " + options).out);
    return json.at("frames").get<int>();
  };
  EXPECT_EQ(frames(""), 1);
  EXPECT_EQ(frames("--frames 4"), 4);
  const auto orbit = nlohmann::json::parse(edgewise_with("needs cube --size 96x54 --json --orbit 5").out);
  EXPECT_EQ(orbit.at("frames"), 5);
  EXPECT_EQ(orbit.at("minima").empty(), orbit.contains("closest"));
  EXPECT_EQ(orbit.at("curves").size(), 7u);
  for (const auto& question : orbit.at("edges"))
    EXPECT_TRUE(question.at("proven") == true || question.at("trials").at("count") > 0) << question;
}

TEST(Program, NeedsTurnsACameraThatIsStraightAbove) {
  for (const char* eye : {"0,6,0", "-0,-6,0"}) {
    const Outcome outcome =
        edgewise_with("needs cube --size 16x9 --json --orbit 3 --eye " + std::string(eye));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out).at("frames"), 3);
  }
}

TEST_F(ProgramRenders, AnEmptyPictureAndSaysWhy) {
  const std::pair<const char*, const char*> reasons[] = {
      {"--eye 0,0,9 --yaw 180", "12 triangles outside the view"},
      {"--cull both", "12 triangles culled by facing"},
      {"--eye 90,0,0 --far 100 --at 0,0,0 --size 1x2 --fov 45", "that cover no pixel centre"}};
  for (const auto& [options, reason] : reasons) {
    const Outcome outcome = edgewise_with("render cube " + std::string(options) + " -o " + path("a.ppm"));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("edgewise: the picture of 'cube' is empty: ")) << outcome.err;
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  }
  EXPECT_EQ(edgewise_with("render cube -o " + path("a.ppm")).err, "");
  EXPECT_EQ(edgewise_with("render cube --wireframe -o " + path("a.ppm")).err, "");
}

TEST_F(ProgramRenders, ScenesThatVerifyReportsAsJson) {
  const Outcome outcome = edgewise_with("verify cube grid64 --size 65x33 --json - --out " + path("out"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json.at("ok"), true);
  EXPECT_EQ(json.at("simd_targets").size(), supported_targets().size());
  ASSERT_EQ(json.at("scenes").size(), 2u);
  for (const auto& [backend, wrong] : json.at("scenes")[1].at("pixels_not_hit_once").items())
    EXPECT_EQ(wrong, 0) << backend;
  EXPECT_EQ(json.at("scenes")[1].at("pixels_not_hit_once").size(), backends().size());
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

}  // namespace
}  // namespace edgewise
