// External text on the terminal and in JSON.
#include "support/printable.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "support/json_text.h"

namespace edgewise::tools {
namespace {

TEST(Printable, KeepsValidText) {
  for (const std::string text : {"", "plain ~", "\u00e9\u03c9\u4e2d\U0001F600", "\U0010FFFF"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ReplacesControlCharacters) {
  EXPECT_EQ(printable("a\x1b[31mb\n\r\t\x7f"), "a?[31mb????");
  EXPECT_EQ(printable("a\u009b31m", ' '), "a 31m");  // a control sequence in one character
  EXPECT_EQ(printable("a\u202eb\u2066"), "a?b?");    // writing direction
}

TEST(Printable, ReplacesEachByteThatIsNotUtf8) {
  EXPECT_EQ(printable("\xff\x80z"), "??z");
  EXPECT_EQ(printable("\xc3"), "?");                   // incomplete
  EXPECT_EQ(printable("\xc0\xaf"), "??");              // overlong encoding of '/'
  EXPECT_EQ(printable("\xe0\x80\xaf"), "???");         // the same
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");         // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");    // beyond Unicode
  EXPECT_EQ(printable("\xe4\xb8z\xe4\xb8"), "??z??");  // incomplete in the middle
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable_within("abcdef", 6), "abcdef");
  EXPECT_EQ(printable_within("abcdefg", 6), "abcd..");
  EXPECT_EQ(printable_within("\u00e9\u00e9\u00e9\u00e9", 4), "\u00e9\u00e9\u00e9\u00e9");
  EXPECT_EQ(printable_within("\u00e9\u00e9\u00e9\u00e9\u00e9", 4), "\u00e9\u00e9..");
  EXPECT_EQ(printable_within("\u4e2d\u4e2d\u4e2d", 5), "\u4e2d..");  // two columns each
  EXPECT_EQ(printable_within("abc", 2), "..");
  EXPECT_EQ(printable_within("abc", 1), ".");
  EXPECT_EQ(printable_within("abc", 0), "");
}

TEST(JsonText, AcceptsAnyBytes) {
  const nlohmann::json json{{"name", "a\xff"}};
  EXPECT_EQ(nlohmann::json::parse(json_text(json)).at("name"), "a\xef\xbf\xbd");
  EXPECT_EQ(json_text(nlohmann::json{{"a", 1}}, 2), "{\n  \"a\": 1\n}");
}

}  // namespace
}  // namespace edgewise::tools
