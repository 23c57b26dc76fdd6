#include "study/comparison/ReportText.h"

#include <gtest/gtest.h>

#include "testing/CommaLocale.h"

namespace hybrid_slam::comparison {
namespace {

TEST(ReportText, IsEscapedForXml) {
  EXPECT_EQ(escapeXml("a < b > c & \"d\"\x01\n"), "a &lt; b &gt; c &amp; &quot;d&quot;?\n");
}

TEST(ReportText, NumbersAreShortAndTheSameInEveryLocale) {
  const test::CommaLocale german;
  EXPECT_EQ(shortNumber(1.25), "1.25");
  EXPECT_EQ(shortNumber(1234.56), "1235");
  EXPECT_EQ(shortNumber(0.123456, 2), "0.12");
  EXPECT_EQ(shortNumber(-0.0), "0");
}

}  // namespace
}  // namespace hybrid_slam::comparison
