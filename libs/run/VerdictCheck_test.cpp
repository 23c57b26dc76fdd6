#include "run/VerdictCheck.h"

#include <gtest/gtest.h>

#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPose2D;

/// The evidence of three laps on a path: collected along it, and collected along another path of the same
/// length but judged by this one.
struct Both {
  Evidence final, soFar;
};
Both evidenceOn(const std::function<TPose2D(const TPose2D&)>& moved) {
  VerdictCheck check;
  ComparedScans scans;
  std::vector<TPose2D> path;
  for (size_t i = 0; i < 240; ++i) {
    const TPose2D truth = test::poseOnLap(i, 80);
    const Scans seen{test::scan(0, truth)};
    path.push_back(moved(truth));
    check.add(path.back(), seen);
    scans.add(truth, i, seen);
  }
  return {check.evidence(), scans.evidence(path)};
}

void expectEqual(const std::vector<Revisit>& a, const std::vector<Revisit>& b) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 5u);
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].update, b[i].update);
    EXPECT_NEAR(a[i].distance, b[i].distance, 1e-9);
    EXPECT_NEAR(static_cast<double>(a[i].compared), static_cast<double>(b[i].compared), 1);
    EXPECT_NEAR(static_cast<double>(a[i].contradicted), static_cast<double>(b[i].contradicted), 1);
  }
}

TEST(ComparedScans, GiveTheEvidenceOfTheFinalPath) {
  const Both both = evidenceOn([](const TPose2D& pose) { return TPose2D(3, -2, 0.7) + pose; });
  expectEqual(both.final.returning, both.soFar.returning);
  expectEqual(both.final.recent, both.soFar.recent);
  EXPECT_EQ(verdictOf(both.soFar).level, Verdict::Level::consistent);
}

TEST(ComparedScans, AreJudgedByThePathAsItIsNow) {
  const Both both = evidenceOn(
      [](const TPose2D& pose) { return TPose2D(3, -2, 0.7) + TPose2D(pose.x, -pose.y, -pose.phi); });
  expectEqual(both.final.returning, both.soFar.returning);
  EXPECT_EQ(verdictOf(both.soFar).level, Verdict::Level::lost);
}

}  // namespace
}  // namespace hybrid_slam::run
