// Text over a picture. A session says what stands where in pixels; a window paints it with the font of
// font.h, a terminal prints characters.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "edgewise/image.h"

namespace edgewise::viewer {

// The room a character takes, in pixels of the picture.
struct Cell {
  int width, height;
};

struct Text {
  int x, y;           // px, upper left corner
  std::string words;  // one line of ASCII
  std::uint32_t colour;
};

// A picture and what is written over it.
struct Screen {
  Image picture;
  std::vector<Text> texts;
};

// What text stands on: the picture, darkened so that the text can be read whatever lies behind.
constexpr std::uint32_t darkened(std::uint32_t colour) {
  return 0xFF000000u | (colour >> 2 & 0x3F3F3Fu);
}

// The font's pixels enlarged by a whole factor that suits the picture's height.
int font_scale(int height_px);
Cell font_cell(int scale);

// Paints the texts into the picture.
void paint(Screen& screen, int scale);

}  // namespace edgewise::viewer
