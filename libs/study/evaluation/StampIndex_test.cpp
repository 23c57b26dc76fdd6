#include "study/evaluation/StampIndex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/RandomStream.h"

namespace hybrid_slam::evaluation {
namespace {

files::Trajectory withStamps(const std::vector<double>& stamps) {
  files::Trajectory t;
  for (const double stamp : stamps) t.push_back({stamp, {}});
  return t;
}

TEST(StampIndex, GivesTheRowNotTheRankInTime) {
  const StampIndex index(withStamps({10, 30, 20}));
  EXPECT_EQ(index.nearest(19, 5), 2u);
  EXPECT_EQ(index.nearest(29, 5), 1u);
  EXPECT_EQ(index.nearest(-100, 1000), 0u);
  EXPECT_EQ(index.nearest(100, 1000), 1u);
}

TEST(StampIndex, ToleranceIsInclusive) {
  const StampIndex index(withStamps({10}));
  EXPECT_EQ(index.nearest(10.5, 0.5), 0u);
  EXPECT_EQ(index.nearest(9.5, 0.5), 0u);
  EXPECT_EQ(index.nearest(10.5, 0.49), std::nullopt);
  EXPECT_EQ(index.nearest(10, 0), 0u);
  EXPECT_EQ(index.nearest(10, std::numeric_limits<double>::quiet_NaN()), std::nullopt);
}

TEST(StampIndex, TiesAsDocumented) {
  const StampIndex index(withStamps({2, 1, 1, 2}));
  EXPECT_EQ(index.nearest(1.5, 1), 2u) << "equally far: the earlier stamp, last of its rows";
  EXPECT_EQ(index.nearest(1, 1), 2u);
  EXPECT_EQ(index.nearest(1.75, 1), 0u) << "a stamp ahead: first of its rows";
  EXPECT_EQ(index.nearest(2, 1), 3u);
}

TEST(StampSequence, RowsOfATimestampFollowInOrder) {
  StampSequence rows(withStamps({1, 2, 2, 3}), 0.5);
  EXPECT_EQ(rows.next(2), 1u);
  EXPECT_EQ(rows.next(1), 0u);
  EXPECT_EQ(rows.next(2), 2u);
  EXPECT_EQ(rows.next(2), 2u) << "no third one";
  EXPECT_EQ(rows.next(2.1), 1u) << "another timestamp";
  EXPECT_EQ(rows.next(5), std::nullopt);
}

TEST(StampIndex, AnEmptyIndexFindsNothing) {
  EXPECT_EQ(StampIndex(files::Trajectory()).nearest(0, 1e9), std::nullopt);
}

TEST(StampIndex, AgreesWithALinearSearch) {
  RandomStream random(2, 0, 0);
  files::Trajectory t;
  for (int i = 0; i < 300; ++i) t.push_back({100 * random.uniform(), {}});
  const StampIndex index(t);
  for (int i = 0; i < 2000; ++i) {
    const double at = 110 * random.uniform() - 5, tolerance = random.uniform();
    double least = std::numeric_limits<double>::infinity();
    for (const files::StampedPose& p : t) least = std::min(least, std::abs(p.timestamp - at));
    const auto row = index.nearest(at, tolerance);
    ASSERT_EQ(row.has_value(), least <= tolerance);
    if (row) {
      EXPECT_EQ(std::abs(t[*row].timestamp - at), least);
    }
  }
}

}  // namespace
}  // namespace hybrid_slam::evaluation
