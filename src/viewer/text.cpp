#include "viewer/text.h"

#include <algorithm>

#include "viewer/font.h"

namespace edgewise::viewer {

namespace {

class Painter {
 public:
  Painter(Image& image, int scale) : image_(image), scale_(scale) {}

  void paint(const Text& text) {
    int x = text.x;
    for (const char letter : text.words) {
      paint_letter(x, text.y, letter, text.colour);
      x += kGlyphWidth * scale_;
    }
  }

 private:
  void paint_letter(int left, int top, char letter, std::uint32_t colour) {
    const bool known = letter >= kFirstGlyph && letter <= kLastGlyph;
    const auto& glyph = kGlyphs[(known ? letter : '?') - kFirstGlyph];
    const int x0 = std::max(left, 0), x1 = std::min(left + kGlyphWidth * scale_, image_.width);
    const int y0 = std::max(top, 0), y1 = std::min(top + kGlyphHeight * scale_, image_.height);
    for (int y = y0; y < y1; ++y) {
      std::uint32_t* row = image_.pixels.data() + std::ptrdiff_t{y} * image_.width;
      const int bits = glyph[(y - top) / scale_];
      for (int x = x0; x < x1; ++x)
        row[x] = (bits >> (kGlyphWidth - 1 - (x - left) / scale_) & 1) != 0 ? colour : darkened(row[x]);
    }
  }

  Image& image_;
  int scale_;
};

}  // namespace

int font_scale(int height_px) {
  return std::clamp((height_px + 180) / 450, 1, 8);
}

Cell font_cell(int scale) {
  return {kGlyphWidth * scale, kGlyphHeight * scale};
}

void paint(Screen& screen, int scale) {
  Painter painter(screen.picture, scale);
  for (const Text& text : screen.texts) painter.paint(text);
}

}  // namespace edgewise::viewer
