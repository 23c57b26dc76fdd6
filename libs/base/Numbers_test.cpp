#include "base/Numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "base/RandomStream.h"
#include "testing/CommaLocale.h"

namespace hybrid_slam {
namespace {

TEST(Numbers, AreParsedCompletely) {
  for (const char* text : {"0.5", "+0.5", "5e-1", ".5"}) EXPECT_EQ(parseFinite(text), 0.5) << text;
  EXPECT_EQ(parseFinite("-2"), -2);
  EXPECT_EQ(parseNumber("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(parseNumber("nan").value()));
  for (const char* text : {"", " ", "+", "-", "+-1", "0,5", "0.5 ", " 0.5", "0.5x", "x", "1e999"})
    EXPECT_FALSE(parseNumber(text)) << text;
  for (const char* text : {"nan", "inf", "-inf"}) EXPECT_FALSE(parseFinite(text)) << text;
}

TEST(Numbers, AreFormattedLikePrintf) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::pow(10, 20 * random.uniform() - 10) * random.gaussian();
    char expected[64];
    std::snprintf(expected, sizeof expected, "%.6f %.2e %.6g", value, value, value);
    EXPECT_EQ(fixedText(value, 6) + " " + numberText(value, std::chars_format::scientific, 2) + " " +
                  numberText(value, std::chars_format::general, 6),
              expected);
    EXPECT_EQ(parseNumber(numberText(value)), value);
  }
  EXPECT_EQ(numberText(0.5), "0.5");
  EXPECT_EQ(numberText(1000000), "1e+06");
  EXPECT_EQ(numberText(250000), "250000");
  EXPECT_EQ(numberText(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(fixedText(-1e300, 1).size(), 304u);
}

TEST(Numbers, AreTheSameInEveryLocale) {
  const test::CommaLocale german;
  std::ostringstream separated;
  separated << 1234.5;
  ASSERT_EQ(separated.str(), "1.234,5");
  ASSERT_EQ(std::strtod("0,5", nullptr), 0.5);
  EXPECT_EQ(parseNumber("0.5"), 0.5);
  EXPECT_FALSE(parseNumber("0,5"));
  EXPECT_EQ(numberText(1234.5), "1234.5");
  EXPECT_EQ(fixedText(1234.5, 2), "1234.50");
}

TEST(Numbers, Counted) {
  EXPECT_EQ(counted(0, "scan(s) skipped"), "0 scans skipped");
  EXPECT_EQ(counted(1, "scan(s) skipped"), "1 scan skipped");
  EXPECT_EQ(counted(2, "scan(s), or turn(s)"), "2 scans, or turns");
}

}  // namespace
}  // namespace hybrid_slam
