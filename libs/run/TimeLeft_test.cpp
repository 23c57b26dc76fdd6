#include "run/TimeLeft.h"

#include <gtest/gtest.h>

#include <functional>

namespace hybrid_slam::run {
namespace {

/// Ratios of estimated to true times left, writing included, at 5 %, 10 %, ... of 1000 scans.
/// @param timeOf  s, from the number of scans
std::vector<double> ratios(const std::function<double(double)>& timeOf) {
  TimeLeft left(1000);
  std::vector<double> ratios;
  for (size_t done = 1; done < 1000; ++done) {
    const double elapsed = timeOf(static_cast<double>(done));
    const auto said = left.after(done, elapsed);
    if (done % 50 == 0) ratios.push_back(said.value_or(0) / (1.25 * timeOf(1000) - elapsed));
  }
  return ratios;
}

TEST(TimeLeft, OfSteadyAndOfSlowingRuns) {
  for (const double ratio : ratios([](double d) { return 0.05 * d; })) EXPECT_NEAR(ratio, 1, 0.01);
  for (const double ratio : ratios([](double d) { return 0.05 * d + 1e-4 * d * d; }))
    EXPECT_NEAR(ratio, 1, 0.05);
}

TEST(TimeLeft, ARunThatGetsFasterIsNotExtrapolatedToZero) {
  for (const double ratio : ratios([](double d) { return 0.2 * d - 1e-4 * d * d; })) {
    EXPECT_GT(ratio, 0.95);
    EXPECT_LT(ratio, 2.5);
  }
}

TEST(TimeLeft, IsUnknownAtFirst) {
  TimeLeft left(1000);
  EXPECT_FALSE(left.after(100, 1.9));
  EXPECT_TRUE(left.after(101, 2));
  TimeLeft slow(1000);
  EXPECT_FALSE(slow.after(19, 50));
  EXPECT_TRUE(slow.after(20, 50));
}

TEST(TimeLeft, AtTheEndOnlyTheResultsAreLeft) {
  EXPECT_EQ(TimeLeft(1000).after(1000, 80), 20);
  EXPECT_EQ(TimeLeft(1).after(1, 0), 0);
}

}  // namespace
}  // namespace hybrid_slam::run
