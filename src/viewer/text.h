// Text over a picture. A session gives positions in pixels; a window paints the text with the font of font.h,
// a terminal prints characters.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "edgewise/image.h"

namespace edgewise::viewer {

// The size of a character in pixels of the picture.
struct Cell {
  int width, height;
};

struct Text {
  int x, y;           // px, upper left corner
  std::string words;  // one line of ASCII
  std::uint32_t colour;
};

// A picture and the text over it.
struct Screen {
  Image picture;
  std::vector<Text> texts;
};

// The background of text: the picture's colour, darkened so that the text stays readable.
constexpr std::uint32_t darkened(std::uint32_t colour) {
  return 0xFF000000u | (colour >> 2 & 0x3F3F3Fu);
}

// The integer factor by which the font is enlarged for a picture of this height.
int font_scale(int height_px);
Cell font_cell(int scale);

// Paints the texts into the picture.
void paint(Screen& screen, int scale);

}  // namespace edgewise::viewer
