// The program as a user meets it: exit statuses, one line for each failure, whole files or none.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "image/image.h"
#include "raster/backend.h"
#include "run_program.h"
#include "scene/builtin.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

using testing::Outcome;

Outcome edgewise_with(const std::string& arguments) {
  return testing::run_program(EDGEWISE_PROGRAM, arguments);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
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

struct BadInput {
  const char* arguments;  // DIR stands for a folder of the test's own
  const char* said;       // a part of the line on stderr
};
void PrintTo(const BadInput& bad, std::ostream* out) {
  *out << "edgewise " << bad.arguments;
}

class ProgramRejects : public ::testing::TestWithParam<BadInput> {};

TEST_P(ProgramRejects, WithOneLineAndStatus2AndLeavesNothing) {
  const TempDir folder;
  const TempDir input;
  input.write("empty.obj", "");
  input.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  input.write("cut.tri", "TRI1\1");
  input.write("other.tri", "NOPE............");
  input.write("text.png", "not a picture");
  input.write("small.ppm", "P6\n1 1\n255\nabc");
  input.write("large.ppm", "P6\n2 1\n255\nabcdef");
  input.write("depth.pfm", std::string("Pf\n1 1\n-1.0\n\0\0\0\0", 16));
  input.write("mesh.stl", "solid");
  const std::string arguments =
      replaced(replaced(GetParam().arguments, "DIR", folder.path().string()), "IN", input.path().string());
  const Outcome outcome = edgewise_with(arguments);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("edgewise: ")) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().said), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.count(), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Table, ProgramRejects,
    ::testing::Values(BadInput{"", "no command given"},                                                  //
                      BadInput{"rendr cube", "did you mean 'render'"},                                   //
                      BadInput{"render", "SCENE is required"},                                           //
                      BadInput{"render cube", "nothing to write"},                                       //
                      BadInput{"render cube -o DIR/a.png --colour", "--colour"},                         //
                      BadInput{"render cub -o DIR/a.png", "did you mean 'cube'"},                        //
                      BadInput{"render cube cub -o DIR/", "did you mean 'cube'"},                        //
                      BadInput{"render '' -o DIR/a.png", "unknown scene"},                               //
                      BadInput{"render cube --backend tile -o DIR/a.png", "did you mean 'tiled'"},       //
                      BadInput{"render cube --target avx9 -o DIR/a.png", "unknown SIMD target 'avx9'"},  //
                      BadInput{"render cube --cull bak -o DIR/a.png", "did you mean 'back'"},            //
                      BadInput{"render cube --payload color -o DIR/a.png", "did you mean 'colour'"},     //
                      BadInput{"render cube --size 0x5 -o DIR/a.png", "'0x5'"},                          //
                      BadInput{"render cube --size -4x5 -o DIR/a.png", "'-4x5'"},                        //
                      BadInput{"render cube --size 16385x5 -o DIR/a.png", "1 to 16384"},                 //
                      BadInput{"render cube --size 99999999999x5 -o DIR/a.png", "1 to 16384"},           //
                      BadInput{"render cube --size 5 -o DIR/a.png", "WIDTHxHEIGHT"},                     //
                      BadInput{"render cube --size 5x5x5 -o DIR/a.png", "WIDTHxHEIGHT"},                 //
                      BadInput{"render cube --threads 0 -o DIR/a.png", "1 to 256"},                      //
                      BadInput{"render cube --threads 257 -o DIR/a.png", "1 to 256"},                    //
                      BadInput{"render cube --threads two -o DIR/a.png", "'two'"},                       //
                      BadInput{"render cube --tile 48 -o DIR/a.png", "16, 32 or 64"},                    //
                      BadInput{"render cube --frames 0 -o DIR/a.png", "1 to 100000"},                    //
                      BadInput{"render cube --time nan -o DIR/a.png", "'nan'"},                          //
                      BadInput{"render cube --fov 180 -o DIR/a.png", "'180'"},                           //
                      BadInput{"render cube --near 0 -o DIR/a.png", "--near"},                           //
                      BadInput{"render cube --near 5 --far 4 -o DIR/a.png", "near"},                     //
                      BadInput{"render cube --eye 1,2 -o DIR/a.png", "X,Y,Z"},                           //
                      BadInput{"render cube --eye 1,2,inf -o DIR/a.png", "X,Y,Z"},                       //
                      BadInput{"render cube --at 0,0,0 --yaw 5 -o DIR/a.png", "exclude"},                //
                      BadInput{"render cube --scale 2 -o DIR/a.png", "--scale"},                         //
                      BadInput{"render large --scale 0 -o DIR/a.png", "--scale"},                        //
                      BadInput{"render large --scale nan -o DIR/a.png", "--scale"},                      //
                      BadInput{"render micro --scale 900 -o DIR/a.png", "10^8"},                         //
                      BadInput{"render large --fov 50 -o DIR/a.png", "no camera"},                       //
                      BadInput{"render cube sphere -o DIR/a.png", "{scene}"},                            //
                      BadInput{"render cube ./cube.obj -o DIR/", "no such file"},                        //
                      BadInput{"render grid4 cube --scale 2 -o DIR/", "--scale"},                        //
                      BadInput{"render cube IN/index.obj -o DIR/", "index.obj"},                         //
                      BadInput{"render cube cube -o DIR/", "two scenes"},                                //
                      BadInput{"render cube -o DIR/a.jpg", ".png or .ppm"},                              //
                      BadInput{"render cube -o DIR/a.png --depth DIR/a.png", ".pfm"},                    //
                      BadInput{"render cube -o DIR/no/a.png", "/no/a.png: cannot be written"},           //
                      BadInput{"render cube -o /proc/a.png", "/proc/a.png"},                             //
                      BadInput{"render cube --size 64x64 -o /dev/full/a.png", "/dev/full/a.png"},        //
                      BadInput{"render cube -o ''", "nothing to write"},                                 //
                      BadInput{"render IN/none.obj -o DIR/a.png", "no such file"},                       //
                      BadInput{"render IN/mesh.stl -o DIR/a.png", "unknown kind of file"},               //
                      BadInput{"render IN/ -o DIR/a.png", "unknown kind of file"},                       //
                      BadInput{"render IN/empty.obj -o DIR/a.png", "empty.obj"},                         //
                      BadInput{"render IN/index.obj -o DIR/a.png", "index.obj"},                         //
                      BadInput{"render IN/cut.tri -o DIR/a.png", "cut.tri"},                             //
                      BadInput{"render IN/other.tri -o DIR/a.png", "other.tri"},                         //
                      BadInput{"capture cube -o DIR/a.png", ".tri"},                                     //
                      BadInput{"capture cube -o DIR/no/a.tri", "/no/a.tri: cannot be written"},          //
                      BadInput{"verify cub", "did you mean 'cube'"},                                     //
                      BadInput{"verify IN/empty.obj --out DIR/out", "empty.obj"},                        //
                      BadInput{"verify cube --json DIR/no/a.json", "/no/a.json: cannot be written"},     //
                      BadInput{"diff IN/text.png IN/text.png -o DIR/a.png", "text.png"},                 //
                      BadInput{"diff IN/small.ppm IN/large.ppm -o DIR/a.png", "different sizes"},        //
                      BadInput{"diff IN/small.ppm IN/depth.pfm -o DIR/a.png", "cannot be compared"},     //
                      BadInput{"diff IN/small.ppm IN/none.ppm", "none.ppm"},                             //
                      BadInput{"diff IN/small.ppm IN/mesh.stl", "unknown kind of file"},                 //
                      BadInput{"diff IN/small.ppm", "B is required"},                                    //
                      BadInput{"view cub -o DIR/a.png", "did you mean 'cube'"},                          //
                      BadInput{"view --keys b% -o DIR/a.png", "'%'"},                                    //
                      BadInput{"view --coverage tile -o DIR/a.png", "did you mean 'tiled'"},             //
                      BadInput{"view --facing normal -o DIR/a.png", "did you mean 'normal_z'"},          //
                      BadInput{"view --axis 1,2 -o DIR/a.png", "X,Y,Z"},                                 //
                      BadInput{"view -o DIR/a.tri", ".png or .ppm"},                                     //
                      BadInput{"view -o DIR/no/a.png", "/no/a.png: cannot be written"},                  //
                      BadInput{"view --terminal -o DIR/a.png", "neither"},                               //
                      BadInput{"view --terminal </dev/null", "needs a terminal"},                        //
                      BadInput{"list >/dev/full", "standard output"},                                    //
                      BadInput{"render cube --size 9x9 -o DIR/../DIR-none/a.png", "a.png"}));

TEST(Program, SaysWhenMemoryIsShort) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve more address space than the limit";
#endif
  const TempDir folder;
  const std::string program = EDGEWISE_PROGRAM;
  const Outcome outcome = testing::run_program(
      "/bin/sh", "-c 'ulimit -v 400000; \"" + program + "\" render cube --threads 1 --size " +
                     "16384x16384 -o \"" + (folder.path() / "a.png").string() + "\"'");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "edgewise: out of memory\n");
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Program, HelpsOnEveryCommand) {
  for (const char* command :
       {"", "list", "render", "verify", "accuracy", "stability", "diff", "capture", "view", "machine"}) {
    const Outcome outcome = edgewise_with(std::string(command) + " --help");
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_NE(outcome.out.find("edgewise"), std::string::npos) << command;
    EXPECT_EQ(outcome.err, "") << command;
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

  const std::string text = edgewise_with("list").out;
  for (const auto& name : names_of(builtin_scenes())) EXPECT_NE(text.find(name), std::string::npos) << name;
}

TEST(Program, MachineIsDescribedWithoutAHostName) {
  const auto json = nlohmann::json::parse(edgewise_with("machine").out);
  for (const char* key :
       {"cpu_model", "cpu_features", "cores", "caches", "memory_gib", "os", "kernel", "compiler", "flags",
        "build_type", "edgewise_version", "commit", "packages", "simd_targets", "simd_best"})
    EXPECT_TRUE(json.contains(key)) << key;
  const std::string name = edgewise_with("machine --name").out;
  EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-\n"), std::string::npos) << name;
  EXPECT_TRUE(name.ends_with("-core\n") || name.ends_with("-cores\n")) << name;
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
  TempDir folder_;
};

TEST_F(ProgramRenders, TheSamePictureInEveryFormatAndByEveryBackend) {
  ASSERT_EQ(
      edgewise_with("render cube --size 97x61 -o " + path("a.png") + " --depth " + path("a.pfm")).status, 0);
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
    EXPECT_EQ(edgewise_with("diff " + path("a.pfm") + " " + path("b.pfm")).status, 0) << backend.name;
  }
}

TEST_F(ProgramRenders, SeveralScenesIntoAFolderThatItMakes) {
  ASSERT_EQ(edgewise_with("render cube sphere --size 32x32 -o " + path("new/")).status, 0);
  EXPECT_TRUE(std::filesystem::exists(path("new/cube.png")));
  EXPECT_TRUE(std::filesystem::exists(path("new/sphere.png")));
}

TEST_F(ProgramRenders, NumberedFramesOfAnAnimation) {
  ASSERT_EQ(edgewise_with("render cube --size 32x32 --frames 3 --fps 2 -o " + path("{scene}.png")).status, 0);
  EXPECT_EQ(names(), (std::set<std::string>{"cube-0001.png", "cube-0002.png", "cube-0003.png"}));
  ASSERT_EQ(edgewise_with("render cube --size 32x32 --time 1 -o " + path("one.png")).status, 0);
  EXPECT_EQ(read_image(path("cube-0003.png")).pixels, read_image(path("one.png")).pixels);
  EXPECT_NE(read_image(path("cube-0001.png")).pixels, read_image(path("one.png")).pixels);
}

TEST_F(ProgramRenders, HitsOfAGridAsOnceEverywhere) {
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
  std::uint32_t inverse = 1;  // Newton's iteration doubles the number of right bits
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

TEST_F(ProgramRenders, ACaptureExactlyAsTheSceneItCameFrom) {
  const std::string options = " --size 200x120 --fov 70 --cull none ";
  ASSERT_EQ(
      edgewise_with("render terrain" + options + "-o " + path("a.png") + " --depth " + path("a.pfm")).status,
      0);
  ASSERT_EQ(edgewise_with("capture terrain" + options + "-o " + path("a.tri")).status, 0);
  ASSERT_EQ(
      edgewise_with("render " + path("a.tri") + " -o " + path("b.png") + " --depth " + path("b.pfm")).status,
      0);
  EXPECT_EQ(edgewise_with("diff " + path("a.png") + " " + path("b.png")).status, 0);
  EXPECT_EQ(edgewise_with("diff " + path("a.pfm") + " " + path("b.pfm")).status, 0);
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

TEST_F(ProgramRenders, WhateverTheCaseOfItsExtension) {
  ASSERT_EQ(
      edgewise_with("render cube --size 40x30 -o " + path("a.PNG") + " --depth " + path("a.PFM")).status, 0);
  EXPECT_EQ(edgewise_with("diff " + path("a.PNG") + " " + path("a.PNG")).status, 0);
  EXPECT_EQ(edgewise_with("diff " + path("a.PFM") + " " + path("a.PFM")).status, 0);
  ASSERT_EQ(edgewise_with("capture cube --size 40x30 -o " + path("a.TRI")).status, 0);
  const auto json = nlohmann::json::parse(edgewise_with("verify --json - " + path("a.TRI")).out);
  EXPECT_EQ(json.at("scenes")[0].at("width"), 40);
}

TEST_F(ProgramRenders, AFileOfAnyNameAndSaysNothingThatATerminalObeys) {
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

TEST_F(ProgramRenders, WhatDiffTellsApart) {
  ASSERT_EQ(
      edgewise_with("render cube --size 64x64 -o " + path("a.png") + " --depth " + path("a.pfm")).status, 0);
  ASSERT_EQ(
      edgewise_with("render cube --size 64x64 --time 1 -o " + path("b.png") + " --depth " + path("b.pfm"))
          .status,
      0);
  EXPECT_EQ(edgewise_with("diff " + path("a.png") + " " + path("a.png")).status, 0);
  EXPECT_EQ(edgewise_with("diff " + path("a.pfm") + " " + path("b.pfm")).status, 1);
  const Outcome outcome =
      edgewise_with("diff --json " + path("a.png") + " " + path("b.png") + " -o " + path("d.png"));
  EXPECT_EQ(outcome.status, 1);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json.at("pixels"), 64 * 64);
  EXPECT_GT(json.at("differing"), 0);
  EXPECT_EQ(read_image(path("d.png")).width, 64);
}

TEST_F(ProgramRenders, NothingOverAFileThatIsThereWhenItFails) {
  const auto older = folder_.write("a.png", "older");
  EXPECT_EQ(edgewise_with("render cube --near 5 --far 4 -o " + older.string()).status, 2);
  EXPECT_EQ(file_content(older), "older");
}

TEST_F(ProgramRenders, AVerdictAsJson) {
  const Outcome outcome = edgewise_with("verify cube grid64 --size 65x33 --json - --out " + path("out"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json.at("ok"), true);
  EXPECT_TRUE(json.at("machine").contains("cpu_model"));
  ASSERT_EQ(json.at("scenes").size(), 2u);
  for (const auto& [backend, wrong] : json.at("scenes")[1].at("pixels_not_hit_once").items())
    EXPECT_EQ(wrong, 0) << backend;
  EXPECT_EQ(json.at("scenes")[1].at("pixels_not_hit_once").size(), backends().size());
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

}  // namespace
}  // namespace edgewise
