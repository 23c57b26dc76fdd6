#include "base/Options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/bits_math.h>

#include "base/Errors.h"
#include "testing/CommaLocale.h"

namespace hybrid_slam {
namespace {

enum class Colour { red, blue };

struct Sample : Options {
  double length = 0.5, angle = 0.1;
  int count = 3;
  bool on = false;
  std::string label = "LASER";
  Colour colour = Colour::red;
  void describe(OptionTable& t) override {
    t.add("length", length, 0, 10, "m", "a length");
    t.addAngle("angle_deg", angle, 0, 90, "an angle");
    t.add("count", count, 1, 100, "a count");
    t.add("on", on, "a switch");
    t.add("label", label, "a name");
    t.add("colour", colour, {{Colour::red, "red"}, {Colour::blue, "blue"}}, "a choice");
  }
};

void load(Sample& sample, const std::string& text) {
  const mrpt::config::CConfigFileMemory file("[s]\n" + text);
  sample.loadFromConfigFile(file, "s");
}

std::string errorOf(const std::string& text) {
  Sample sample;
  try {
    load(sample, text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Options, LoadsEveryType) {
  Sample s;
  load(s, "length = 2.25\nangle_deg = 45 // half a right angle\ncount=7\non=true\nlabel=A B\ncolour=blue\n");
  EXPECT_EQ(s.length, 2.25);
  EXPECT_NEAR(s.angle, M_PI / 4, 1e-15);
  EXPECT_EQ(s.count, 7);
  EXPECT_TRUE(s.on);
  EXPECT_EQ(s.label, "A B");
  EXPECT_EQ(s.colour, Colour::blue);
}

TEST(Options, KeepsKeysThatTheSectionLacks) {
  Sample s;
  s.count = 42;
  load(s, "length = 1\n");
  EXPECT_EQ(s.count, 42);
}

TEST(Options, UnknownKeyNamesTheNearest) {
  EXPECT_EQ(errorOf("lenght = 1\n"),
            "unknown key: section [s], key `lenght`; the nearest known key is `length`");
}

TEST(Options, WrongTypeAndRangeSayWhatWasExpected) {
  using testing::HasSubstr;
  EXPECT_THAT(errorOf("length = long\n"), HasSubstr("expected a number in 0..10 m"));
  EXPECT_THAT(errorOf("length = 1x\n"), HasSubstr("wrong value `1x`"));
  EXPECT_THAT(errorOf("length = nan\n"), HasSubstr("expected a number in 0..10 m"));
  EXPECT_THAT(errorOf("length = -1\n"), HasSubstr("key `length`"));
  EXPECT_THAT(errorOf("angle_deg = 91\n"), HasSubstr("0..90 deg"));
  EXPECT_THAT(errorOf("count = 2.5\n"), HasSubstr("whole number in 1..100"));
  EXPECT_THAT(errorOf("count = 0\n"), HasSubstr("whole number"));
  EXPECT_THAT(errorOf("on = maybe\n"), HasSubstr("true or false"));
  EXPECT_THAT(errorOf("colour = green\n"), HasSubstr("red | blue"));
  EXPECT_THAT(errorOf("length =\n"), HasSubstr("wrong value ``"));
}

TEST(Options, SaveAndLoadRoundTrip) {
  Sample s;
  s.length = 1.0 / 3;
  s.angle = mrpt::DEG2RAD(0.5);
  s.colour = Colour::blue;
  mrpt::config::CConfigFileMemory file;
  s.saveToConfigFile(file, "s");
  EXPECT_EQ(file.read_string("s", "angle_deg", ""), "0.5");
  Sample t;
  t.loadFromConfigFile(file, "s");
  EXPECT_EQ(t.length, s.length);
  EXPECT_NEAR(t.angle, s.angle, 1e-12);
  EXPECT_EQ(t.colour, s.colour);
}

TEST(Options, AreTheSameInEveryLocale) {
  const test::CommaLocale german;
  Sample s;
  load(s, "length = 2.25\nangle_deg = 0.5\n");
  EXPECT_EQ(s.length, 2.25);
  EXPECT_NEAR(s.angle, mrpt::DEG2RAD(0.5), 1e-15);
  mrpt::config::CConfigFileMemory file;
  s.saveToConfigFile(file, "s");
  EXPECT_EQ(file.read_string("s", "length", ""), "2.25");
  EXPECT_EQ(file.read_string("s", "angle_deg", ""), "0.5");
  EXPECT_EQ(s.table().front().range, "0..10");
}

TEST(EditDistance, CountsInsertionsDeletionsSubstitutions) {
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(editDistance("gird", "grid"), 1u);
  EXPECT_EQ(editDistance("rnu", "run"), 1u);
  EXPECT_EQ(editDistance("same", "same"), 0u);
}

}  // namespace
}  // namespace hybrid_slam
