// PNGs of every kind are read as their samples, whatever colour space they name.
#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "edgewise/image.h"
#include "edgewise/scene.h"
#include "image/format.h"
#include "message_of.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

using namespace std::string_literals;

std::string be32(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

const Bytef* bytes_of(const std::string& text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

std::string chunk(const std::string& name, const std::string& data) {
  const auto size = static_cast<std::uint32_t>(data.size());
  const uLong crc = crc32(0, bytes_of(name + data), size + 4);
  return be32(size) + name + data + be32(static_cast<std::uint32_t>(crc));
}

std::string compressed(const std::string& data) {
  std::string bytes(compressBound(data.size()), '\0');
  uLongf size = bytes.size();
  compress(reinterpret_cast<Bytef*>(bytes.data()), &size, bytes_of(data), data.size());
  return bytes.substr(0, size);
}

constexpr char kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgba = 6;

struct Png {
  std::uint32_t width, height;
  char bits, colour;
  std::string rows;    // each with its filter byte before it
  std::string chunks;  // before the pixels
  char interlaced = 0;

  std::string file() const {
    const std::string header =
        be32(width) + be32(height) + std::string({bits, colour, '\0', '\0', interlaced});
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunks + chunk("IDAT", compressed(rows)) +
           chunk("IEND", "");
  }
};

Samples samples_of(const Png& png) {
  const TempDir dir;
  return std::get<Samples>(read_picture(dir.write("a.png", png.file())));
}

using Colours = std::vector<std::uint32_t>;

Colours pixels_of(const Png& png) {
  const TempDir dir;
  return read_image(dir.write("a.png", png.file())).pixels;
}

Colours greys(std::initializer_list<std::uint32_t> values) {
  Colours all;
  for (const std::uint32_t v : values) all.push_back(rgb(v, v, v));
  return all;
}

const std::string kEight = "\0\x0a\x14\x1e\xc8\x64\x01\xff\x80\x7f"s;  // three pixels of RGB
const Colours kEightPixels{rgb(10, 20, 30), rgb(200, 100, 1), rgb(255, 128, 127)};

TEST(PngSamples, AreNotConvertedByAnyColourSpace) {
  const std::string white = be32(31270) + be32(32900);
  const std::string primaries =
      be32(70000) + be32(30000) + be32(20000) + be32(70000) + be32(15000) + be32(6000);
  for (const std::string& colour_space :
       {""s, chunk("gAMA", be32(100000)), chunk("gAMA", be32(45455)), chunk("gAMA", be32(220000)),
        chunk("sRGB", "\0"s), chunk("cHRM", white + primaries), chunk("sBIT", "\5\6\5"),
        chunk("gAMA", be32(100000)) + chunk("cHRM", white + primaries), chunk("bKGD", "\0\1\0\2\0\3"s),
        chunk("iCCP", "profile\0\0"s + compressed(std::string(200, 'x')))}) {
    EXPECT_EQ(pixels_of({3, 1, 8, kRgb, kEight, colour_space}), kEightPixels) << colour_space.substr(4, 4);
    const Samples deep = samples_of({1, 1, 16, kRgb, "\0\1\2\3\4\xff\xfe"s, colour_space});
    EXPECT_EQ(deep.pixels.at(0), (Samples::Pixel{0x0102, 0x0304, 0xFFFE, 0xFFFF}));
    EXPECT_TRUE(deep.deep);
  }
}

TEST(PngSamples, IgnoreAlphaAndTransparentColours) {
  EXPECT_EQ(pixels_of({3, 1, 8, kRgba, "\0\x0a\x14\x1e\0\xc8\x64\x01\x80\xff\x80\x7f\xff"s, ""}),
            kEightPixels);
  EXPECT_EQ(pixels_of({3, 1, 8, kRgb, kEight, chunk("tRNS", "\0\x0a\0\x14\0\x1e"s)}), kEightPixels);
  EXPECT_EQ(pixels_of({2, 1, 8, kGreyAlpha, "\0\x0a\0\xc8\x80"s, ""}), greys({10, 200}));
  EXPECT_EQ(samples_of({1, 1, 16, kGreyAlpha, "\0\x12\x34\0\0"s, ""}).pixels.at(0),
            (Samples::Pixel{0x1234, 0x1234, 0x1234, 0}));
  EXPECT_EQ(samples_of({1, 1, 16, kRgba, "\0\x12\x34\x56\x78\x9a\xbc\0\0"s, ""}).pixels.at(0),
            (Samples::Pixel{0x1234, 0x5678, 0x9ABC, 0}));
}

TEST(PngSamples, OfGreyHaveTheirWholeRange) {
  EXPECT_EQ(pixels_of({4, 1, 1, kGrey, "\0\x50"s, ""}), greys({0, 255, 0, 255}));
  EXPECT_EQ(pixels_of({4, 1, 2, kGrey, "\0\x1b"s, ""}), greys({0, 85, 170, 255}));
  EXPECT_EQ(pixels_of({2, 1, 4, kGrey, "\0\x1e"s, ""}), greys({17, 238}));
  EXPECT_EQ(pixels_of({2, 1, 8, kGrey, "\0\x7b\xff"s, chunk("tRNS", "\0\x7b"s)}), greys({123, 255}));
}

TEST(PngSamples, OfPalettesAreItsColours) {
  const std::string palette = chunk("PLTE", "\x0a\x14\x1e\xc8\x64\x01"s);
  for (const std::string& transparent : {""s, chunk("tRNS", "\0\x80"s)})
    for (const auto& [bits, row] : std::vector<std::pair<char, std::string>>{
             {'\1', "\0\x40"s}, {'\2', "\0\x10"s}, {'\4', "\0\1"s}, {'\10', "\0\0\1"s}})
      EXPECT_EQ(pixels_of({2, 1, bits, kPalette, row, palette + transparent}),
                (Colours{rgb(10, 20, 30), rgb(200, 100, 1)}));
}

TEST(PngSamples, OfInterlacedFilesAreInTheirPlaces) {
  constexpr int kWidth = 11, kHeight = 9;
  std::string rows;
  for (int pass = 0; pass < PNG_INTERLACE_ADAM7_PASSES; ++pass)
    for (int y = PNG_PASS_START_ROW(pass); y < kHeight; y += PNG_PASS_ROW_OFFSET(pass)) {
      rows += '\0';
      for (int x = PNG_PASS_START_COL(pass); x < kWidth; x += PNG_PASS_COL_OFFSET(pass))
        rows += static_cast<char>(16 * y + x);
    }
  const Samples image = samples_of({kWidth, kHeight, 8, kGrey, rows, "", 1});
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      EXPECT_EQ(image.pixels.at(y * kWidth + x).at(0), 257 * (16 * y + x)) << x << ", " << y;
}

TEST(Png, AlphaIsComparedApart) {
  const TempDir dir;
  const auto file = [&](const char* name, const Png& png) { return dir.write(name, png.file()); };
  const auto opaque = file("a.png", {3, 1, 8, kRgb, kEight, ""});
  const auto half = file("b.png", {3, 1, 8, kRgba, "\0\x0a\x14\x1e\0\xc8\x64\x01\x80\xff\x80\x7f\xff"s, ""});
  const auto keyed = file("c.png", {3, 1, 8, kRgb, kEight, chunk("tRNS", "\0\x0a\0\x14\0\x1e"s)});
  EXPECT_EQ(difference(opaque, half).count, 0u);
  EXPECT_EQ(difference(opaque, half).alpha_count, 2u);
  EXPECT_EQ(difference(half, keyed).alpha_count, 1u);
  EXPECT_EQ(difference(opaque, half, opaque).alpha_count, 0u) << "masked";
  EXPECT_EQ(difference(opaque, half, opaque).masked, 3u);
}

TEST(Png, DamageAndAbsurdSizesAreRefusedWithTheReason) {
  const std::string whole = Png{3, 1, 8, kRgb, kEight, ""}.file();
  const TempDir dir;
  const auto huge = dir.write("huge.png", Png{983040, 983040, 8, kRgb, kEight, ""}.file());
  EXPECT_EQ(message_of([&] { read_image(huge); }),
            huge.string() + ": image size 983040x983040 is outside 1 to 16384");
  for (std::size_t i = 8; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] ^= 0x20;
    const auto path = dir.write("a.png", damaged);
    std::vector<std::string> said;  // a warning if the last chunk is longer than the file
    const std::string error = message_of([&] { read_image(path, &said); });
    if (!error.empty()) said.push_back(error);
    ASSERT_EQ(said.size(), 1u) << i;
    EXPECT_TRUE(said[0].starts_with(path.string() + ": ")) << i << said[0];
    EXPECT_TRUE(!error.empty() || i >= whole.size() - 12) << i;
  }
}

}  // namespace
}  // namespace edgewise
