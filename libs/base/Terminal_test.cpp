#include "base/Terminal.h"

#include <gtest/gtest.h>

namespace hybrid_slam {
namespace {

TEST(OnOneLine, ControlCharactersCannotReachTheTerminal) {
  using namespace std::string_literals;
  EXPECT_EQ(onOneLine("\x1b]0;title\x07 \x1b[2J"), R"(\x1b]0;title\x07 \x1b[2J)");
  EXPECT_EQ(onOneLine("a\0b\rc\x7f"s), R"(a\x00b\x0dc\x7f)");
  EXPECT_EQ(onOneLine("one\ntwo\tthree"), "one two three");
  EXPECT_EQ(onOneLine("C1 \xc2\x9b\x33m"), R"(C1 \xc2\x9b3m)") << "CSI in UTF-8";
  EXPECT_EQ(onOneLine("\x9b\x33m"), R"(\x9b3m)") << "CSI in Latin-1";
}

TEST(OnOneLine, OtherTextIsUnchanged) {
  const std::string text = "`caf\xc3\xa9`, \xc2\xb0, \xe2\x82\xac, \xf0\x9f\x98\x80 \\ ~";
  EXPECT_EQ(onOneLine(text), text);
  EXPECT_EQ(onOneLine(""), "");
  EXPECT_EQ(onOneLine("cut \xe2\x82"), R"(cut \xe2\x82)");
  EXPECT_EQ(onOneLine("\xe2(\xf5\xc0\x80"), R"(\xe2(\xf5\xc0\x80)");
}

TEST(OnOneLine, ALongTextIsCut) {
  EXPECT_EQ(onOneLine(std::string(10000, 'a')), std::string(10000, 'a'));
  EXPECT_EQ(onOneLine(std::string(5'000'000, 'a')), std::string(10001, 'a') + "... and 4989999 bytes more");
}

TEST(Wrapped, LinesEndBetweenWords) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(wrapped("one two\nthree  four", 9), (Lines{"one two", "three", "four"}));
  EXPECT_EQ(wrapped("one two", 7), Lines{"one two"});
  EXPECT_EQ(wrapped("a longer-than-that b", 5), (Lines{"a", "longer-than-that", "b"}));
  EXPECT_EQ(wrapped(" ", 5), Lines{});
}

}  // namespace
}  // namespace hybrid_slam
