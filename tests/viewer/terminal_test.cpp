// Parsing of terminal input, and output of pictures to a terminal.
#include <gtest/gtest.h>

#include "edgewise/scene.h"
#include "viewer/terminal_io.h"

namespace edgewise::viewer {
namespace {

TEST(TerminalInput, GivesKeysOnceTheirSequencesAreComplete) {
  struct Row {
    std::string bytes;
    bool paused;
    std::vector<Key> keys;
  };
  const Key b = key_of('b'), q = key_of('q');
  std::string pending;
  for (const auto& [bytes, paused, keys] : std::vector<Row>{
           {"wB\r\t\x7f \x1b[A\x1bOD",
            false,
            {key_of('w'), b, Key::enter, Key::tab, Key::backspace, Key::space, Key::up, Key::left}},
           {"\x1b", false, {}},
           {"[", false, {}},
           {"Cq", false, {Key::right, q}},
           {"\x1b", false, {}},
           {"", true, {Key::escape}},
           {"\x1bq", false, {Key::escape, q}},
           {"\x1b[15~\x1b[1;5Zb", false, {b}},
           {"\x1b[" + std::string(1000, '1'), false, {}},
           {"", true, {}},
           {"b", false, {b}},
           {"", true, {}}}) {
    pending += bytes;
    EXPECT_EQ(take_keys(pending, paused), keys) << bytes;
  }
}

TEST(TerminalPicture, ShowsTwoPixelsInEachCharacterLabelsOverThemAndAStatusBelow) {
  TerminalPicture picture;
  Screen screen{{2, 4, {rgb(1, 2, 3), rgb(4, 5, 6), rgb(7, 8, 9), rgb(4, 5, 6), 0, 0, 0, 0}}, {}};
  screen.labels = {{2, 2, "Q?", rgb(250, 251, 252)}, {0, 2, "?P", rgb(250, 251, 252)}};
  const std::string bytes = picture.show(screen, "status");
  EXPECT_NE(bytes.find("\x1b[38;2;1;2;3m\x1b[48;2;7;8;9m\xe2\x96\x80"), std::string::npos) << bytes;
  EXPECT_NE(bytes.find("\x1b[48;2;4;5;6m "), std::string::npos) << bytes;
  EXPECT_NE(bytes.find("PQ"), std::string::npos);
  EXPECT_EQ(bytes.find("?"), std::string::npos);  // beyond the borders
  EXPECT_NE(bytes.find("\x1b[3;1H"), std::string::npos);
  EXPECT_TRUE(bytes.ends_with("st")) << bytes;
}

TEST(TerminalPicture, SendsOnlyChangedRows) {
  TerminalPicture picture;
  Screen screen{{3, 20, std::vector<std::uint32_t>(60, rgb(9, 9, 9))}, {}};
  EXPECT_NE(picture.show(screen, "").find("\x1b[2J"), std::string::npos);
  EXPECT_EQ(picture.show(screen, ""), "");
  screen.picture.pixels[7] = rgb(200, 9, 9);
  EXPECT_EQ(picture.show(screen, ""), "\x1b[2;1H\x1b[48;2;9;9;9m \x1b[38;2;200;9;9m\xe2\x96\x80 ");
  screen.picture = {20, 3, std::vector<std::uint32_t>(60, rgb(9, 9, 9))};
  EXPECT_NE(picture.show(screen, "").find("\x1b[2J"), std::string::npos);
}

}  // namespace
}  // namespace edgewise::viewer
