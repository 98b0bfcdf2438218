// Parsing of terminal input, and output of pictures to a terminal.
#include <gtest/gtest.h>

#include "edgewise/scene.h"
#include "viewer/terminal_io.h"

namespace edgewise::viewer {
namespace {

std::vector<Key> keys_in(const std::vector<TerminalEvent>& events) {
  std::vector<Key> keys;
  for (const auto& event : events)
    if (const Key* const key = std::get_if<Key>(&event)) keys.push_back(*key);
  return keys;
}

TEST(TerminalInput, ReadsKeys) {
  TerminalInput input;
  EXPECT_EQ(keys_in(input.feed("wB\r\t\x7f \x1b[A\x1bOD")),
            (std::vector<Key>{key_of('w'), key_of('b'), Key::enter, Key::tab, Key::backspace, Key::space,
                              Key::up, Key::left}));
  EXPECT_FALSE(input.waits());
}

TEST(TerminalInput, JoinsSequencesThatArriveInPieces) {
  TerminalInput input;
  EXPECT_TRUE(input.feed("\x1b").empty());
  EXPECT_TRUE(input.waits());
  EXPECT_TRUE(input.feed("[").empty());
  EXPECT_EQ(keys_in(input.feed("Cq")), (std::vector<Key>{Key::right, key_of('q')}));
}

TEST(TerminalInput, ReadsALoneEscapeAsTheKey) {
  TerminalInput input;
  EXPECT_TRUE(input.feed("\x1b").empty());
  EXPECT_EQ(keys_in(input.settle()), std::vector<Key>{Key::escape});
  EXPECT_FALSE(input.waits());
  EXPECT_EQ(keys_in(input.feed("\x1bq")), (std::vector<Key>{Key::escape, key_of('q')}));
  EXPECT_TRUE(input.settle().empty());
}

TEST(TerminalInput, IgnoresUnknownSequences) {
  TerminalInput input;
  EXPECT_EQ(keys_in(input.feed("\x1b[15~\x1b[1;5Zb\x1b[<0;1M")), std::vector<Key>{key_of('b')});
  EXPECT_TRUE(input.feed("\x1b[" + std::string(1000, '1')).empty());
  EXPECT_FALSE(input.waits());
}

TEST(TerminalInput, ReadsMouseEvents) {
  TerminalInput input;
  const auto events = input.feed("\x1b[<0;5;7M\x1b[<32;6;7M\x1b[<0;6;7m\x1b[<65;1;1M");
  ASSERT_EQ(events.size(), 4u);
  const auto at = [&](std::size_t i) { return std::get<Pointed>(events[i]); };
  EXPECT_EQ(at(0).column, 4);
  EXPECT_EQ(at(0).row, 6);
  EXPECT_TRUE(at(0).held);
  EXPECT_TRUE(at(1).held);
  EXPECT_EQ(at(1).column, 5);
  EXPECT_FALSE(at(2).held);
  EXPECT_FALSE(at(3).held);  // the mouse wheel
}

TEST(TerminalPicture, ShowsTwoPixelsInEachCharacterLabelsOverThemAndAStatusBelow) {
  TerminalPicture picture;
  Screen screen{{2, 4, {rgb(1, 2, 3), rgb(4, 5, 6), rgb(7, 8, 9), rgb(4, 5, 6), 0, 0, 0, 0}}, {}};
  screen.labels.push_back({2, 2, "Q?", rgb(250, 251, 252)});
  const std::string bytes = picture.show(screen, "status");
  EXPECT_NE(bytes.find("\x1b[38;2;1;2;3m\x1b[48;2;7;8;9m\xe2\x96\x80"), std::string::npos) << bytes;
  EXPECT_NE(bytes.find("\x1b[48;2;4;5;6m "), std::string::npos) << bytes;
  EXPECT_NE(bytes.find("Q"), std::string::npos);
  EXPECT_EQ(bytes.find("?"), std::string::npos);  // beyond the right border
  EXPECT_NE(bytes.find("\x1b[3;1H"), std::string::npos);
  EXPECT_TRUE(bytes.ends_with("st")) << bytes;
}

TEST(TerminalPicture, SendsOnlyChangedCells) {
  TerminalPicture picture;
  Screen screen{{40, 20, std::vector<std::uint32_t>(800, rgb(9, 9, 9))}, {}};
  EXPECT_NE(picture.show(screen, "").find("\x1b[2J"), std::string::npos);
  EXPECT_EQ(picture.show(screen, ""), "");
  screen.picture.pixels[45] = rgb(200, 9, 9);
  EXPECT_EQ(picture.show(screen, ""), "\x1b[1;6H\x1b[38;2;9;9;9m\x1b[48;2;200;9;9m\xe2\x96\x80");
  screen.picture = {20, 40, std::vector<std::uint32_t>(800, rgb(9, 9, 9))};
  EXPECT_NE(picture.show(screen, "").find("\x1b[2J"), std::string::npos);
}

}  // namespace
}  // namespace edgewise::viewer
