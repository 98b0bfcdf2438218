// Mesh and stream files: valid files are read exactly, and invalid ones give a one-line error message.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <sstream>
#include <tuple>

#include "core/random.h"
#include "edgewise/frontend.h"
#include "edgewise/obj_file.h"
#include "edgewise/tri_file.h"
#include "edgewise/visible.h"
#include "frontend/shade.h"
#include "message_of.h"
#include "obj_text.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

std::string le32(std::uint32_t value) {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::string tri_text(const TriangleStream& stream) {
  std::ostringstream out;
  write_tri(out, stream);
  return out.str();
}

Mesh read_mesh(const std::string& text) {
  const TempDir dir;
  return read_obj(dir.write("mesh.obj", text)).meshes.at(0);
}

// ---- .tri

TEST(TriFile, DoublesAreWrittenAsDocumentedAndKeepEveryBit) {
  const TempDir dir;
  TriangleStream stream{3, 2, {}, {{{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}, rgb(1, 2, 3)}}};
  const double values[] = {10 + 0x1p-40, 1e300, -0.0, 0x1p-1074, std::nan("7"), -1.0 / 3, 16, 17, 18};
  ExactStreamTriangle& exact = stream.exact.emplace_back(ExactStreamTriangle{{}, 0x80FF1234u});
  std::copy_n(values, 9, &exact.vertex[0].x);
  std::string expected = "TRI2" + le32(3) + le32(2) + le32(2);
  const auto append = [&](double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    expected += le32(static_cast<std::uint32_t>(bits)) + le32(static_cast<std::uint32_t>(bits >> 32));
  };
  for (int i = 1; i <= 9; ++i) append(i);
  expected += "\x01\x02\x03\xFF";
  for (const double value : values) append(value);
  expected += le32(exact.colour);
  EXPECT_EQ(tri_text(stream), expected);

  const TriangleStream back = read_tri(dir.write("a.tri", expected));
  ASSERT_EQ(std::tuple(back.width, back.height, back.triangles.size(), back.exact.size()),
            std::tuple(3, 2, 0u, 2u));
  EXPECT_EQ(std::memcmp(back.exact[1].vertex, values, sizeof values), 0);
  EXPECT_EQ(back.at(1).colour, exact.colour);
  EXPECT_EQ(tri_text(back), expected);
  stream.triangles.emplace_back();
  EXPECT_EQ(message_of([&] { tri_text(stream); }),
            "a .tri file holds triangles in float or in double, not both");
}

// ---- OBJ

// All notations of the triangle (1,2,3) (4,5,6) (7,8,10).
TEST(ObjFile, EveryNotationOfATriangleIsReadTheSame) {
  for (const std::string& text :
       std::vector<std::string>{kCorners + "f 1 2 3",
                                kCorners + "f -3 -2 -1\n",
                                kCorners + "f -3 -2 -1\nv 9 9 9\n",
                                "f 1 2 3\n" + kCorners,
                                kCorners + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n",
                                kCorners + "f 1//1 2//1 3//1\n",
                                kCorners + "f 1/1 2/1 3/1\n",
                                "v 1 2 3\r\nv 4 5 6\r\nv 7 8 10\r\nf 1 2 3\r\n",
                                "v 1 2 3\rv 4 5 6\rv 7 8 10\rf 1 2 3\r",
                                "\xEF\xBB\xBF" + kCorners + "f 1 2 3\n",
                                "v +1 2. .3e1\nv 4e0 5.0 60E-1\nv 7 8 1.e1\nf +1 2 3\n",
                                "# x\n\n  v\t1  2 3 # y\nv 4 5 6\nv 7 8 10\n\tf 1\t2 3  # z\n",
                                "v 1 \\\n2 3\nv 4 5 6\r\nv 7 8 \\\r\n 10\nf 1 2 \\\n\\\n3",
                                "v 1 \\ \n2 3\nv 4 5 6\nv 7 8 \\\t \r\n 10\nf 1 2 \\ \n 3",
                                kCorners + "f 1 2 3\r\n\x1A",
                                kCorners + "f 1 2 3\x1A\x1A",
                                kCorners + "f 1 2\nf 1 2 3\nf 3\nf -1 4\n",
                                kCorners + "f 1 2 3 #\nusemtl a#b\ng #\n\t#f 1 2\n",
                                "v 1 2 3 # C:\\\n# D:\\\nv 4 5 6\nv 7 8 10\nf 1 2 3\n",
                                "usemtl a # C:\\\n" + kCorners + "g a # C:\\\nf 1 2 3\n",
                                "\f\nv\v1 2\f3\v\n\v\f\n\fv 4 5 6\nv 7 8 \\\f\n\v10\f# x\nf 1\v2\f3\n",
                                "v 1 2 3 1\nv 4 5 6 0.5\nv 7 8 10 1 0 0\nf 1 2 3\n",
                                "mtllib none.mtl\no a\ng b c\nusemtl d\ns off\nvp 1\nl 1 2\np 1\nt x "
                                "99999999999/99999999999/9\n" +
                                    kCorners + "f 1 2 3\ncurv 0 1\n"}) {
    const Mesh mesh = read_mesh(text);
    ASSERT_EQ(mesh.triangles.size(), 1u) << text;
    const glm::uvec3 t = mesh.triangles[0];
    EXPECT_EQ(mesh.positions.at(t.x), glm::vec3(1, 2, 3)) << text;
    EXPECT_EQ(mesh.positions.at(t.y), glm::vec3(7, 8, 10)) << text;
    EXPECT_EQ(mesh.positions.at(t.z), glm::vec3(4, 5, 6)) << text;
  }
}

TEST(ObjFile, ExtremeNumbersBecomeTheNearestFloat) {
  const std::string zeros(400, '0');
  const Mesh mesh = read_mesh("v 1e-400 -1e-99999 0e400\nv 1" + zeros + "e-400 0." + zeros +
                              "1 1e-45\nv 0.1 16777217 -3.4028235e38\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions.at(0), glm::vec3(0, 0, 0));
  EXPECT_EQ(mesh.positions.at(1), glm::vec3(1, 0, 1e-45f));
  EXPECT_EQ(mesh.positions.at(2), glm::vec3(0.1f, 16777216, -3.4028235e38f));
}

TEST(ObjFile, MalformedOnesAreRefusedWithTheReason) {
  using Rows = std::vector<std::pair<std::string, std::string>>;  // content and message
  const TempDir dir;
  for (const auto& [content, message] :
       Rows{{std::string("\xFF\xFEv\0 \0"
                         "1\0",
                         8),
             "is not a text file"},
            {kCorners + "f 1 2 -4\n", "line 4: a face names vertex -4 of the 3 before it"},
            {"v 1 2 3\nf -2147483648 1 1\n" + kCorners,
             "line 2: a face names vertex -2147483648 of the 1 before it"},
            {kCorners + "f 1 2 0\n", "line 4: vertex index 0 (indices start at 1)"},
            {kCorners + "f 1 2 99999999999\n", "line 4: '99999999999' is not a vertex index"},
            {kCorners + "f 1 2 3/1/1/1\n", "line 4: '3/1/1/1' is not a vertex index"},
            {kCorners + "f 1 2 3/\x1B[31m\n", "line 4: '3/?[31m' is not a vertex index"},
            {kCorners + "f\n", "line 4: a face without corners"},
            {"v 1 2 1.#INF\n", "line 1: '1.#INF' is not a finite coordinate"},
            {"v 1 2 3 1 0 red\n", "line 1: 'red' is not a finite number"},
            {kCorners + "\x1A\nf 1 2 3\n", "line 4: # or control character in '?'"},
            {"v 1 2\n", "line 1: a vertex needs three coordinates"},
            {"v 1 1e39 2\n", "line 1: '1e39' is not a finite coordinate"},
            {"v 1 2 3\r\n\r\nv 1 2 \\\r\n x\r\n", "line 3: 'x' is not a finite coordinate"}}) {
    const auto path = dir.write("bad.obj", content);
    EXPECT_EQ(message_of([&] { read_obj(path); }), path.string() + ": " + message);
  }
}

// ---- OBJ: what files say of colours, normals and places

using Colours = std::vector<std::uint32_t>;
const std::uint32_t kLightGrey = rgb(200, 200, 200);

TEST(ObjFile, MaterialsGiveColours) {
  const TempDir dir;
  dir.write("a.mtl", "# x\nKd 1 1 1\nnewmtl red\nKa 1 1 1\nKd 1.0 0.2 0\nnewmtl two words \n\tKd 0.5\n");
  dir.write("a name.mtl",
            "newmtl none\r\nnewmtl odd\r\nKd spectral a.rfl\r\nnewmtl out\r\nKd 7 -1 0 # y\r\n\x1A");
  // A library may follow the use of its materials.
  const ReadObj read = read_with_report(
      dir, kCorners +
               "mtllib a.mtl\nf 1 2 3\nusemtl red\nf 1 2 3\nf 1 2 3 1\nusemtl two words\nf 1 2 3\n"
               "usemtl none\nf 1 2 3\nusemtl odd\nf 1 2 3\nusemtl out\nf 1 2 3\nmtllib a name.mtl\n");
  const std::uint32_t red = rgb(255, 51, 0);
  EXPECT_EQ(read.mesh().colours,
            (Colours{kLightGrey, red, red, red, rgb(128, 128, 128), kLightGrey, kLightGrey, rgb(255, 0, 0)}));
  EXPECT_EQ(read.report.warnings, std::vector<std::string>{});
  EXPECT_EQ(read_with_report(dir, "mtllib a.mtl a.mtl\n" + kCorners + "usemtl red\nf 1 2 3\n").mesh().colours,
            Colours{red});
}

// A library is read once.
TEST(ObjFile, MissingMaterialsAreWarnings) {
  const TempDir dir;
  const std::string face = kCorners + "usemtl b\nf 1 2 3\nusemtl a\nusemtl b\nf 1 2 3\n";
  const auto warnings = [&](const std::string& text) {
    const ReadObj read = read_with_report(dir, text);
    EXPECT_EQ(read.mesh().colours, (Colours{kLightGrey, kLightGrey}));
    return read.report.warnings;
  };
  const std::string none = (dir.path() / "none.mtl").string(), bad = (dir.path() / "bad.mtl").string();
  const auto missing = warnings("\nmtllib none.mtl none.mtl\nmtllib ./none.mtl\n" + face);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_TRUE(missing[0].starts_with("line 2: " + none + ": ")) << missing[0];
  EXPECT_EQ(warnings(face),
            std::vector<std::string>{"line 4: no .mtl file defines material 'b', nor 1 more"});
  dir.write("bad.mtl", "newmtl c\nKd 1 x 1\n");
  EXPECT_EQ(warnings("mtllib bad.mtl\n" + face),
            std::vector<std::string>{"line 1: " + bad + ": line 2: 'x' is not a finite number"});
  EXPECT_EQ(read_with_report(dir, kCorners + "f 1 2\nf 1 2 3\nf 3\n").report.warnings,
            std::vector<std::string>{"line 4: 2 faces, from here on, of fewer than three corners skipped"});
}

TEST(ObjFile, ALibraryIsNoDescriptor) {
  const TempDir dir;
  for (const std::string name : {"/dev/stdin", "/dev/fd/0", "/dev/../proc/self/fd/0"})
    EXPECT_EQ(read_with_report(dir, "mtllib " + name + "\n" + kCorners + "f 1 2 3\n").report.warnings,
              std::vector<std::string>{"line 1: " + name + ": is not a regular file"});
}

TEST(ObjFile, FromADescriptorHasItsLibrariesInTheCurrentFolder) {
  const TempDir dir;
  std::FILE* const file =
      std::fopen(dir.write("a.obj", "mtllib no.mtl\n" + kCorners + "f 1 2 3\n").c_str(), "r");
  ASSERT_NE(file, nullptr);
  const std::string path = "/dev/fd/" + std::to_string(fileno(file));
  ObjReport report;
  read_obj(path, {}, &report);
  std::fclose(file);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_TRUE(report.warnings[0].starts_with(path + ": line 1: no.mtl: ")) << report.warnings[0];
}

TEST(ObjFile, ColoursMayBeBytesAndFollowAWeight) {
  const TempDir dir;
  const char* const bytes = "line 2: vertex colours are whole numbers of 0 to 255: they are divided by 255";
  const char* const clamped = "line 2: vertex colours outside 0 to 1 are clamped";
  const std::string unused = " numbers: those after the third are not used";
  for (const auto& [numbers, colour, warning] :  // numbers: those after x y z
       std::vector<std::tuple<const char*, std::uint32_t, const char*>>{
           {"1 0 0", rgb(255, 0, 0), nullptr},
           {"0.5 1.0 0.2", rgb(128, 255, 51), nullptr},
           {"200 30 40", rgb(200, 30, 40), bytes},
           {"255.0 0 1e0", rgb(255, 0, 1), bytes},
           {"1.5 1 0", rgb(255, 255, 0), clamped},
           {"200 30 40.5", rgb(255, 255, 255), clamped},
           {"256 0 0", rgb(255, 0, 0), clamped},
           {"-1 0 1", rgb(0, 0, 255), clamped},
           {"1 1 0 0", rgb(255, 0, 0), nullptr},
           {"0.5 0 0.2 1", rgb(0, 51, 255), nullptr},
           {"1 200 30 40", rgb(200, 30, 40), bytes},
           {"255 1 0 0", rgb(255, 0, 0), nullptr},
           {"0.5", kLightGrey, nullptr},
           {"1 0", kLightGrey, "line 2: a vertex of 5"},
           {"1 0 0 1 1", kLightGrey, "line 2: a vertex of 8"}}) {
    std::string text = "\n";
    for (const char* const at : {"0 0 0 ", "1 0 0 ", "0 1 0 "})
      text += std::string("v ") + at + numbers + '\n';
    const ReadObj read = read_with_report(dir, text + "f 1 2 3\n");
    EXPECT_EQ(read.mesh().colours, Colours{colour}) << numbers;
    std::vector<std::string> expected;
    if (warning != nullptr) expected.push_back(warning + (colour == kLightGrey ? unused : ""));
    EXPECT_EQ(read.report.warnings, expected) << numbers;
  }
}

// A hub of 60,000 holes without area: its corners are at three places, so no search can leave any out.
TEST(ObjFile, AFaceOfExcessiveCostIsSkipped) {
  std::string face;
  for (int i = 0; i < 40000; ++i) face += i % 2 == 0 ? " 1 2 3" : i % 4 == 1 ? " 1 2 3 3 2 1" : " 3 2 1";
  const TempDir dir;
  const ReadObj read =
      read_with_report(dir, kCorners + "o a\nf 1 2 3\nf" + face + "\no b\nf" + face + "\nf 3 2 1\n");
  EXPECT_EQ(read.mesh().triangles, (std::vector<glm::uvec3>{{0, 2, 1}, {2, 0, 1}}));
  EXPECT_EQ(objects(read.scene), (std::map<std::string, std::vector<std::uint32_t>>{{"a", {0}}, {"b", {1}}}));
  ASSERT_EQ(read.report.warnings.size(), 2u);
  EXPECT_EQ(read.report.warnings[0],
            "line 6: a face is skipped: filling its 150000 corners takes too many steps; a file's faces may "
            "take 200000000");
}

// If all vertices of a face have one. They come before the material's.
TEST(ObjFile, VerticesGiveColours) {
  const TempDir dir;
  dir.write("a.mtl", "newmtl blue\nKd 0 0 1\n");
  const ReadObj read = read_with_report(
      dir,
      "mtllib a.mtl\nv 0 0 0 0.5\nv 0 0 0 1 0 0\nv 1 0 0 1 0.6 0\nv 0 1 0 1 0 3\nv 1 1 0\nf 2 3 4\n"
      "f 1 3 4\nf 2 3 5\nusemtl blue\nf 2 3 4 4\nf 2 3 5\n");
  const std::uint32_t mean = rgb(255, 51, 85), four = rgb(255, 38, 128), blue = rgb(0, 0, 255);
  EXPECT_EQ(read.mesh().colours, (Colours{mean, kLightGrey, kLightGrey, four, four, blue}));
}

// The quads have a straight corner, the polygons any, and no triangle is larger than a sliver at first.
TEST(ObjFile, FacesAreLitByTheirPlane) {
  Random random(3);
  const auto number = [&] { return double{random.uniform(-1, 1)}; };
  const auto vector = [&] { return glm::dvec3{number(), number(), number()}; };
  const TempDir dir;
  for (int trial = 0; trial < 200; ++trial) {
    const glm::dvec3 u = glm::normalize(vector()), v = glm::normalize(glm::cross(u, vector()));
    const glm::dvec3 at = 100.0 * vector();
    std::vector<glm::dvec2> outline;
    if (trial % 2 == 0) {
      outline = {{-1, -1}, {number(), -1}, {1, -1}, {0, 1}};
    } else {
      for (int k = 0; k < 9; ++k)
        for (int twice = 0; twice < 1 + k % 2; ++twice)
          outline.emplace_back((1 + 0.5 * (k % 3)) * std::cos(0.7 * k),
                               (1 + 0.5 * (k % 3)) * std::sin(0.7 * k));
    }
    std::ostringstream text;
    text.precision(17);
    std::string face = "f";
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const glm::dvec3 p = at + outline[k].x * u + outline[k].y * v;
      text << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
      face += ' ' + std::to_string(k + 1);
    }
    const Scene scene = read_obj(dir.write("face.obj", text.str() + face + '\n'));
    EXPECT_EQ(scene.meshes[0].triangles.size(), outline.size() - 2);
    const double cosine = glm::dot(glm::cross(u, v), glm::normalize(glm::dvec3(scene.to_light)));
    for (const std::uint32_t lit : lit_colours(scene))
      EXPECT_NEAR(lit & 255, 200.0 * std::max(cosine, 0.15), 1) << trial;
  }
}

TEST(ObjFile, OnlyPolygonsNeedNormalsAndFlags) {
  const Mesh plain = read_mesh(kCorners + "f 1 2 3\nf 1 3 2\n");
  EXPECT_TRUE(plain.normals.empty() && plain.flags.empty());
  const Mesh mixed =
      read_mesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 3 2 1\nf 1 2 3 4\nf 1 2 3\nf 1 1 2 3 4\nf 2 1 3\n");
  const glm::vec3 front(0, 0, 1);
  EXPECT_EQ(mixed.normals,
            (std::vector<glm::vec3>{-front, front, front, front, front, front, front, -front}));
  EXPECT_EQ(mixed.flags, (std::vector<std::uint8_t>{0, 0, kSameFace, 0, 0, kSameFace, kSameFace, 0}));
}

// A square of 3 mm, 5,572 km from the origin, where floats are 0.5 m apart.
TEST(ObjFile, FarFromTheOriginMillimetresAreKept) {
  const std::string text =
      "v 412345.251 0.17 -5572094.503\nv 412345.254 0.17 -5572094.503\nv 412345.254 0.173 -5572094.503\n"
      "v 412345.251 0.173 -5572094.503\nv 0 0 0\nv 3e38 0 0\nf 1 2 3 4\n";
  const TempDir dir;
  const glm::dvec3 expected[] = {{412345.251, 0.17, -5572094.503},
                                 {412345.254, 0.17, -5572094.503},
                                 {412345.254, 0.173, -5572094.503},
                                 {412345.251, 0.173, -5572094.503}};
  for (const bool recentre : {false, true}) {
    const ReadObj read = read_with_report(dir, text, recentre);
    const glm::dvec3 offset = read.report.offset;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LT(glm::distance(glm::dvec3(read.mesh().positions[i]) + offset, expected[i]), 1e-8);
      EXPECT_LT(glm::length(read.mesh().positions[i]), 0.004f);
    }
    EXPECT_TRUE(std::isfinite(read.mesh().positions[5].x)) << "not the face's";
    EXPECT_EQ(read.mesh().origin, recentre ? glm::dvec3(0.0) : offset);
  }
}

// The offset is a multiple of a power of two below the box's size.
TEST(ObjFile, TheOffsetIsRoundAndOnlyForMeshesFarAway) {
  const auto offset = [dir = TempDir()](const std::string& vertices, bool recentre) {
    const std::string text = vertices + "f 1 2 3\n";
    return read_with_report(dir, text, recentre).report.offset;
  };
  const std::string near = "v 30 0 0\nv 40 0 0\nv 30 10 0\n", far = "v 31 0 0\nv 41 0 0\nv 31 10 0\n";
  EXPECT_EQ(offset(near, false), glm::dvec3(0.0));
  EXPECT_EQ(offset(near, true), glm::dvec3(32, 8, 0));
  EXPECT_EQ(offset(far, false), glm::dvec3(40, 8, 0));
  EXPECT_EQ(offset("v 5 5 5\nv 5 5 5\nv 5 5 5\n", false), glm::dvec3(5, 5, 5));
  EXPECT_EQ(offset("v 0 0 0\nv 0 0 0\nv 0 0 0\n", true), glm::dvec3(0, 0, 0));
  EXPECT_EQ(offset("v 3.4e38 0 0\nv -3.4e38 0 0\nv 0 0 0\n", true), glm::dvec3(0, 0, 0));
}

}  // namespace
}  // namespace edgewise
