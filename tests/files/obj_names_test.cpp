// What OBJ files name: materials, libraries, objects and groups; and floating-point modes while they are
// read.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "edgewise/obj_file.h"
#include "edgewise/visible.h"
#include "float_modes.h"
#include "obj_text.h"

namespace edgewise {
namespace {

using Colours = std::vector<std::uint32_t>;

// `usemtl` and `newmtl` agree on names, and on which ones differ.
TEST(ObjFile, MaterialNamesAreTheRestOfTheLine) {
  const std::vector<std::string> names = {"Paint #1",   "Paint #2", "Paint",     "a#b",
                                          "#",          "# x",      "two words", "two  words",
                                          "two\twords", "a\vb",     "a \\ b",    "\xC3\xA4 \xFF"};
  std::string library, text = "mtllib a.mtl\n" + kCorners;
  Colours expected;
  for (const std::string& name : names) {
    library +=
        "newmtl \t" + name + " \v\t\r\n\fKd\v1 0." + std::to_string(expected.size() + 10) + " 0 # x\r\n";
    text += "usemtl\f" + name + "\t\nf 1 2 3\n";
    expected.push_back(rgb(
        255, static_cast<std::uint32_t>(std::lround(2.55 * static_cast<double>(expected.size() + 10))), 0));
  }
  const TempDir dir;
  dir.write("a.mtl", library + "newmtl three \\\n\twords \\\n#3\nKd 0 0 1\n");
  const ReadObj read = read_with_report(dir, text + "usemtl three words #3\nf 1 2 3\n");
  expected.push_back(rgb(0, 0, 255));
  EXPECT_EQ(read.mesh().colours, expected);
  EXPECT_EQ(read.report.warnings, std::vector<std::string>{});
  EXPECT_EQ(read_with_report(dir, "mtllib a.mtl\n" + kCorners + "usemtl Paint #3\nf 1 2 3\n").report.warnings,
            std::vector<std::string>{"line 5: no .mtl file defines material 'Paint #3'"});
}

TEST(ObjFile, ALibraryIsFoundByItsWholeNameOrItsWords) {
  const TempDir dir;
  std::filesystem::create_directory(dir.path() / "sub");
  for (const std::string name : {"a", "a #1", "sub/a", "sub/two words", "sub\\a", "a b"})
    dir.write(name + ".mtl", "newmtl " + name + "\nKd 1 0 0\n");
  const auto warnings = [&](const std::string& library, const std::string& material) {
    return read_with_report(dir, "mtllib " + library + "\n" + kCorners + "usemtl " + material + "\nf 1 2 3\n")
        .report.warnings;
  };
  for (const auto& [library, material] :
       std::vector<std::pair<std::string, std::string>>{{"a #1.mtl", "a #1"},
                                                        {"a.mtl # a b.mtl", "a"},
                                                        {"a.mtl a b.mtl", "a"},
                                                        {".\\a.mtl", "a"},
                                                        {"a b.mtl", "a b"},
                                                        {"sub\\two words.mtl", "sub/two words"},
                                                        {"sub/..\\a.mtl", "a"},
                                                        {"sub/a.mtl", "sub/a"},
                                                        {"sub\\a.mtl", "sub\\a"},
                                                        {"a.mtl \\\n sub/a.mtl", "sub/a"}}) {
    const auto found = warnings(library, material);
    EXPECT_TRUE(found.empty() || library == "a.mtl a b.mtl") << library << ": " << found[0];
  }
  const auto missing = warnings("sub\\none.mtl", "a");
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_TRUE(missing[0].starts_with("line 1: " + (dir.path() / "sub/none.mtl: ").string())) << missing[0];
}

using Objects = std::map<std::string, std::vector<std::uint32_t>>;

TEST(ObjFile, ObjectsAndGroupsHaveTheirTriangles) {
  const TempDir dir;
  const auto objects_in = [&](const std::string& text) {
    return objects(read_with_report(dir, kCorners + "v 0 0 0\n" + text).scene);
  };
  EXPECT_EQ(objects_in("o a\nf 1 2 3\no b\nf 1 2 3\n"), (Objects{{"a", {0}}, {"b", {1}}}));
  EXPECT_EQ(objects_in("f 1 2 3\ng x y\nf 1 2 3 4\nf 1 2\ng\nf 1 2 3\ng y\nf 1 2 3\n"),
            (Objects{{"x", {1, 2}}, {"y", {1, 2, 4}}}));
  EXPECT_EQ(objects_in("o a\ng x\nf 1 2 3\no b\nf 1 2 3\ng y\nf 1 2 3\no\nf 1 2 3\no a\nf 1 2 3\n"),
            (Objects{{"a", {0, 4}}, {"b", {1, 2}}, {"x", {0, 1}}, {"y", {2, 3, 4}}}));
  EXPECT_EQ(objects_in("o Part #1 \t\ng a #1 a # b\nf 1 2 3\no Part #2\no Part \\\n#3\nf 1 2 3\ng none\n"),
            (Objects{{"Part #1", {0}}, {"Part #3", {1}}, {"a", {0, 1}}, {"#1", {0, 1}}}));
  EXPECT_TRUE(read_with_report(dir, kCorners + "o\ng\nf 1 2 3\no a\n").mesh().parts.empty());
}

TEST(FloatMode, ChangesNoMeshOfAFile) {
  const TempDir dir;
  const auto obj = dir.write("a.obj",
                             "v 1000000.1 0.3 0.7 .11 .57 .93\nv 1000001.3 0 .1 .3 .7 .9\n"
                             "v 1000000.9 1.7 .3 .1 .7 .3\nv 1000000.2 1.9 1e-42 1 .3 .1\nf 1 2 3 4\n");
  testing::expect_same_in_every_float_mode([&](int) {
    const Scene scene = read_obj(obj);
    const Mesh& mesh = scene.meshes[0];
    return std::tuple(mesh.positions, mesh.normals, mesh.colours, mesh.origin, scene.camera.position);
  });
}

}  // namespace
}  // namespace edgewise
