#include "study/evaluation/ErrorStatistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace hybrid_slam::evaluation {
namespace {

TEST(ErrorStatistics, ByHand) {
  const ErrorStatistics s = errorStatistics({4, 1, 1, 2});
  EXPECT_DOUBLE_EQ(s.mean, 2);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(22.0 / 4));
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(6.0 / 4));
  EXPECT_EQ(s.median, 2) << "the upper of the two in the middle";
  EXPECT_EQ(s.max, 4);
}

TEST(ErrorStatistics, OddNumberAndSingle) {
  EXPECT_EQ(errorStatistics({5, 3, 9}).median, 5);
  const ErrorStatistics s = errorStatistics({0.25});
  EXPECT_EQ(s.mean, 0.25);
  EXPECT_EQ(s.rmse, 0.25);
  EXPECT_EQ(s.median, 0.25);
  EXPECT_EQ(s.std, 0);
  EXPECT_EQ(s.max, 0.25);
}

TEST(ErrorStatistics, AnEmptySetIsAnError) { EXPECT_THROW(errorStatistics({}), std::invalid_argument); }

}  // namespace
}  // namespace hybrid_slam::evaluation
