// Picture and depth map files, and their differences.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <locale>
#include <span>
#include <sstream>
#include <tuple>

#include "core/little_endian.h"
#include "edgewise/image.h"
#include "edgewise/obj_file.h"
#include "edgewise/scene.h"
#include "files/atomic_file.h"
#include "float_modes.h"
#include "image/format.h"
#include "message_of.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

namespace fs = std::filesystem;

Image test_image(int width, int height) {
  Image image{width, height, {}};
  std::uint32_t state = 1;
  for (int i = 0; i < width * height; ++i)
    image.pixels.push_back(0xFF000000u | (state = state * 1664525 + 1013904223));
  return image;
}

using Colours = std::vector<std::uint32_t>;

Colours pixels_of(const std::string& content) {
  const TempDir dir;
  return read_image(dir.write("a", content)).pixels;
}

// A PFM of three channels.
fs::path write_colours(const TempDir& dir, const char* name, const std::string& size,
                       std::initializer_list<float> bottom_up) {
  std::ostringstream text;
  text << "PF\n" << size << "\n-1.0\n";
  write_words(text, std::as_bytes(std::span(bottom_up)));
  return dir.write(name, text.str());
}

// ---- Pictures

class ImageFormat : public ::testing::TestWithParam<const char*> {
 protected:
  const TempDir dir_;
  const fs::path path_ = dir_.path() / (std::string("a") + GetParam());
};

TEST_P(ImageFormat, RoundTripKeepsEveryPixel) {
  for (const auto& [width, height] : {std::pair(1, 1), {3, 5}, {257, 2}, {1, 16384}}) {
    const Image image = test_image(width, height);
    write_image(path_, image);
    const Image back = read_image(path_);
    EXPECT_EQ(std::tie(back.width, back.height, back.pixels), std::tie(width, height, image.pixels));
  }
}

TEST_P(ImageFormat, AlphaIsIgnored) {
  write_image(path_, {2, 1, {0x00030201u, 0x80060504u}});
  EXPECT_EQ(read_image(path_).pixels, (Colours{0xFF030201u, 0xFF060504u}));
}

TEST_P(ImageFormat, EveryTruncationIsRefused) {
  write_image(path_, test_image(5, 4));
  const std::string whole = file_content(path_);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const fs::path cut = dir_.write("cut" + path_.extension().string(), whole.substr(0, size));
    std::vector<std::string> warnings;
    const std::string error = message_of([&] { read_image(cut, &warnings); });
    const bool cut_behind_pixels = whole.starts_with("\x89PNG") && size >= whole.size() - 12;  // 12: IEND
    EXPECT_EQ(error.empty(), cut_behind_pixels) << size << error;
    EXPECT_EQ(warnings.size(), cut_behind_pixels ? 1u : 0u) << size;
    EXPECT_TRUE((error.empty() ? warnings.at(0) : error).starts_with(cut.string() + ": ")) << size;
  }
}

TEST_P(ImageFormat, WrongPixelCountOrSizeIsNotWritten) {
  EXPECT_THROW(write_image(path_, {2, 2, {1, 2, 3}}), std::runtime_error);
  EXPECT_THROW(write_image(path_, {0, 0, {}}), std::runtime_error);
  EXPECT_THROW(write_image(path_, {-1, -1, {1}}), std::runtime_error);
  EXPECT_THROW(write_image(path_, test_image(16385, 1)), std::runtime_error);
  EXPECT_EQ(dir_.count(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Formats, ImageFormat, ::testing::Values(".png", ".ppm", ".PNG"),
                         [](const auto& p) { return "Format" + std::to_string(p.index); });

TEST(Ppm, ACommentMayBeginInsideAWord) {
  for (const char* header :
       {"P6\n1# width\n2# # height\n255\n", "P6#\n1#\n#\n2#\n255#\n", "P6 1 2 255#\r",
        "P6 # one\n#two\n 1\t2 #3\n 255\n", "P6\r\n1 # w\r\n2\r\n255# d\r\n", "P6\r\n1 2\r\n255\r\n"})
    EXPECT_EQ(pixels_of(header + std::string("\n\1\2\r\n#")),
              (Colours{rgb('\n', 1, 2), rgb('\r', '\n', '#')}))
        << header;
}

// Grey and text, of few and of many levels.
TEST(Ppm, EveryKindIsRead) {
  const Colours grey{rgb(7, 7, 7), rgb(0, 0, 0)}, colours{rgb(1, 2, 3), rgb(4, 5, 255)};
  EXPECT_EQ(pixels_of("P5\n2 1\n255\n" + std::string("\7\0", 2)), grey);
  EXPECT_EQ(pixels_of("P5 2 1 65535\n" + std::string("\7\7\0\0", 4)), grey);
  for (const std::string end : {"", "\n", " \r\n", " # end"}) {
    EXPECT_EQ(pixels_of("P2\n# a\n2 1 255\n7# b\n\t0" + end), grey);
    EXPECT_EQ(pixels_of("P3\n2 1\n255\n1 2 3\n  4 5 255" + end), colours);
  }
  EXPECT_EQ(pixels_of("P3 1 1 1023 1023 0 4"), Colours{rgb(255, 0, 1)});
  EXPECT_EQ(pixels_of("P6 1 1 65535\n\x12\x34\x80\x80\xff\xff"), Colours{rgb(18, 128, 255)});
  EXPECT_EQ(pixels_of("P6 1 2 3\n" + std::string("\0\1\2\3\3\3", 6)),
            (Colours{rgb(0, 85, 170), rgb(255, 255, 255)}));
}

TEST(Grey16, IsReadFromFilesOfGreyAndWrittenAsPngOnly) {
  const TempDir dir;
  const fs::path colours = dir.write("c.ppm", "P6 1 1 255\nabc");
  for (const auto& [text, pixel] : std::vector<std::pair<std::string, std::uint16_t>>{
           {"P5 1 1 255\n\2", 2 * 257}, {"P5 1 1 65535\n\x12\x34", 0x1234}, {"P5 1 1 1023\n\3\xff", 65535}})
    EXPECT_EQ(read_grey16(dir.write("b.pgm", text)).pixels, std::vector<std::uint16_t>{pixel}) << text;
  EXPECT_EQ(message_of([&] { read_grey16(colours); }), colours.string() + ": is no picture of grey");
  EXPECT_THROW(write_grey16(dir.path() / "d.ppm", {1, 1, {1}}), std::runtime_error);
  EXPECT_THROW(write_grey16(dir.path() / "d.png", {2, 2, {1, 2, 3}}), std::runtime_error);
  EXPECT_EQ(dir.count(), 2u);
}

TEST(Picture, MalformedFilesAreRefusedWithTheReason) {
  using Rows = std::vector<std::pair<std::string, std::string>>;  // content and message
  const TempDir dir;
  const std::string file = (dir.path() / "bad").string() + ": ";
  const char* const unknown = "is neither a PNG, a PGM or PPM (P2, P3, P5, P6) nor a PFM";
  for (const auto& [content, message] :
       Rows{{"hello, this is no picture", unknown},
            {"P61 1 255\n123", "does not start with P2, P3, P5 or P6"},
            {"P3\n1 1\n255\n1 2\n", "truncated: header promises 3 samples, 4 bytes follow"},
            {"P3\n1 1\n255\n1 2 3\n4", "too long: text follows the last sample"},
            {"P2\n1 1\n255\n-1\n", "malformed: '-1' is not a sample"},
            {"P2\n1 1\n255\n256\n", "has a sample of 256, more than its maximum of 255"},
            {"P6\n-1 1\n255\n", "malformed: '-1' is not a size"},
            {"P6\n0 1\n255\n", "image size 0x1 is outside 1 to 16384"},
            {"P6\n99999999999999999999 1\n255\n", "malformed: '99999999999999999999' is not a size"},
            {"P6\n" + std::string(100, '1'), "malformed or truncated header"},
            {"P6\n1 1\n65536\n123456", "the maximum must be 1 to 65535"},
            {"P6\n1 1\n3\n\1\4\1", "has a sample of 4, more than its maximum of 3"},
            {"P6\n1 1\n255\n1234", "too long: header promises 3 bytes, 4 follow"},
            {"P6\n1 1\n255\n\n123", "too long: header promises 3 bytes, 4 follow"},
            {"Pf\n1 1\n-1.0\n1234", "is a depth map, which read_pfm() reads"}})
    EXPECT_EQ(message_of([&] { read_image(dir.write("bad", content)); }), file + message);
  for (const auto& [content, message] :
       Rows{{"Pf\n1 1\n-1.0\n12345", "too long: header promises 4 bytes, 5 follow"},
            {"P6\n1 1\n255\n123", "does not start with Pf or PF"},
            {"PF\n1 1\n-1.0\n123456789012", "has three channels; a depth map has one"},
            {"Pf\n1 1\n0\n1234", "malformed header: '0' is not a scale"},
            {"Pf\n1 1\nnan\n1234", "malformed header: 'nan' is not a scale"}})
    EXPECT_EQ(message_of([&] { read_pfm(dir.write("bad", content)); }), file + message);
}

// ---- Depth

TEST(Pfm, RowsLieBottomUpAndBothByteOrdersAreRead) {
  const TempDir dir;
  const fs::path path = dir.path() / "a.pfm";
  write_pfm(path, {1, 2, {1.0f, 2.0f}});
  EXPECT_EQ(file_content(path), std::string("Pf\n1 2\n-1.0\n\0\0\0\x40\0\0\x80\x3F", 20));
  const fs::path big = dir.write("b.pfm", std::string("Pf\n1 2\n1.0\n\x40\0\0\0\x3F\x80\0\0", 19));
  EXPECT_EQ(read_pfm(big).depth01, (std::vector<float>{1.0f, 2.0f}));
}

TEST(Pfm, OfThreeChannelsIsAPictureFrom0To1AndComparedAsFloats) {
  const TempDir dir;
  const float nan = std::nanf("");
  const fs::path a = write_colours(dir, "a.pfm", "1 2", {0.0f, 0.5f, 1.0f, -1.0f, 7.0f, nan});
  EXPECT_EQ(read_image(a).pixels, (Colours{rgb(0, 255, 0), rgb(0, 128, 255)}));
  const fs::path b = write_colours(dir, "b.pfm", "1 2", {0.0f, 0.5f, 0.75f, -1.0f, 7.0f, nan});
  const Difference d = difference(a, b);
  EXPECT_EQ(d.scale, 1);
  EXPECT_EQ(d.largest, 0.25);
  EXPECT_EQ(std::tie(d.count, d.first_y), std::tuple(1u, 1));
  EXPECT_THROW(difference(a, dir.write("c.pfm", "Pf\n1 2\n-1.0\n12345678")), std::invalid_argument);
  EXPECT_THROW(difference(a, dir.write("c.ppm", "P5\n1 2\n255\n12")), std::invalid_argument);
}

TEST(Pfm, LinesMayEndInCrLf) {
  const TempDir dir;
  const std::string samples("\n\0\0\x40\n\r\n\r", 8);
  const auto depths_after = [&](const std::string& header) {
    return read_pfm(dir.write("a.pfm", header + samples)).depth01;
  };
  const auto expected = depths_after("Pf\n2 1\n-1.0\n");
  for (const char* header : {"Pf\r\n2 1\r\n-1.0\r\n", "Pf\r2 1\r-1.0\r", "Pf\r\n2 1\n-1.0\n"})
    EXPECT_EQ(depths_after(header), expected) << header;
}

// ---- Differences

TEST(Difference, CountsDifferingPixelsAndFindsTheLargestDifference) {
  const Image a{3, 2, {rgb(9, 9, 9), 0, 0, 0, 0, rgb(255, 255, 255)}};
  Image b = a;
  b.pixels[0] ^= 0xFF000000u;
  b.pixels[2] = rgb(0, 1, 0);
  b.pixels[3] = rgb(3, 100, 7);
  const Difference d = difference(a, b);
  EXPECT_EQ(d.largest, 100.0);
  EXPECT_EQ(std::tie(d.count, d.first_x, d.first_y), std::tuple(2u, 2, 0));
  EXPECT_EQ(d.alpha_count, 3u);  // rgb() is opaque, 0 is not
  EXPECT_EQ(d.picture.pixels[3], rgb(255, 0, 0));
  EXPECT_GE(d.picture.pixels[2] & 255, 128u);
  EXPECT_LT(d.picture.pixels[2] & 255, 255u);
  EXPECT_EQ(d.picture.pixels[2] & 0xFFFF00, 0u);
  EXPECT_EQ(d.picture.pixels[5], rgb(85, 85, 85));
}

TEST(Difference, OfDepthsFindsTheSmallestStepAndNan) {
  const float nan = std::nanf("");
  const DepthMap a{5, 1, {0.5f, 0.25f, nan, nan, 1.0f}};
  const DepthMap b{5, 1, {std::nextafter(0.5f, 1.0f), 0.25f, nan, 0.5f, 1.0f}};
  const Difference d = difference(a, b);
  EXPECT_TRUE(std::isinf(d.largest));
  EXPECT_EQ(std::tie(d.count, d.first_x), std::tuple(2u, 0));
  EXPECT_EQ(d.picture.pixels,
            (Colours{rgb(255, 0, 0), rgb(63, 63, 63), rgb(0, 0, 0), rgb(255, 0, 0), rgb(0, 0, 0)}));
}

TEST(Enlarge, MakesSquares) {
  const Image large = enlarge({2, 1, {5, 6}}, 2);
  EXPECT_EQ(large.width, 4);
  EXPECT_EQ(large.height, 2);
  EXPECT_EQ(large.pixels, (Colours{5, 5, 6, 6, 5, 5, 6, 6}));
  EXPECT_THROW(enlarge({2, 1, {5, 6}}, 0), std::invalid_argument);
  EXPECT_THROW(enlarge({2, 1, {5, 6}}, 8193), std::invalid_argument);
}

// ---- The host's locale, and the caller's floating-point state

struct GroupedNumbers : std::numpunct<char> {
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
  char do_decimal_point() const override { return ','; }
};

// Writes and reads a file of each kind. Paths are joined before, since the standard library does that with
// floats.
struct Files {
  fs::path png, ppm, pfm, colours;

  explicit Files(const TempDir& dir)
      : png(dir.path() / "a.png"),
        ppm(dir.path() / "a.PPM"),
        pfm(dir.path() / "b.pfm"),
        colours(write_colours(dir, "a.pfm", "2 1", {std::nanf(""), 0.1f, 0.3f, 1e-40f, 0.7f, 2.0f})) {}
};
auto written_and_read(const Files& files) {
  const auto& [png, ppm, pfm, source] = files;
  const Image image = read_image(source);
  write_image(png, image);
  const std::string colours = file_content(png);
  write_grey16(png, {2, 1, {7, 65535}});
  write_image(ppm, test_image(1280, 2));
  write_pfm(pfm, {1280, 1, std::vector<float>(1280, 0.1f)});
  const Difference d = difference(image, read_image(png));
  return std::tuple(colours, file_content(png), read_grey16(png).pixels, file_content(ppm), file_content(pfm),
                    read_image(ppm).pixels, read_pfm(pfm).depth01, image.pixels, d.picture.pixels, d.largest,
                    difference(read_pfm(pfm), read_pfm(pfm)).count);
}

TEST(Locale, OfTheHostChangesNoFile) {
  const TempDir dir;
  const fs::path text = dir.path() / "a",
                 obj = dir.write("a.obj", "v 1234.5 0.25 1e-400\nv 12345 1.e1 0\nv 0 1 0\nf 1 2 3\n"),
                 bad = dir.write("b.obj", std::string(2000, '\n') + "v 1,5 0 0\n");
  const Files files(dir);
  const auto expected = written_and_read(files);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new GroupedNumbers));
  const auto found = written_and_read(files);
  AtomicFile file(text);
  file.stream() << 1234.5;
  file.commit();
  const Scene scene = read_obj(obj);
  const std::string message = message_of([&] { read_obj(bad); });
  std::locale::global(before);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(scene.meshes[0].positions,
            (std::vector<glm::vec3>{{1234.5, 0.25, 0}, {12345, 10, 0}, {0, 1, 0}}));
  EXPECT_EQ(message, bad.string() + ": line 2001: '1,5' is not a finite coordinate");
  EXPECT_EQ(file_content(text), "1234.5");
}

TEST(FloatMode, ChangesNoPictureOfAFile) {
  const TempDir dir;
  const Files files(dir);
  testing::expect_same_in_every_float_mode([&](int) { return written_and_read(files); });
}

}  // namespace
}  // namespace edgewise
