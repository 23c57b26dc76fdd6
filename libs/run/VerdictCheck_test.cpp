#include "run/VerdictCheck.h"

#include <gtest/gtest.h>

#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPose2D;

constexpr double kMaxRange = 20;  // m

/// The evidence of three laps on a path: collected along it, and collected along another path of the same
/// length but judged by this one.
struct Both {
  Evidence final, soFar;
};
Both evidenceOn(const std::function<TPose2D(const TPose2D&)>& moved) {
  VerdictCheck check(kMaxRange);
  ComparedScans scans(kMaxRange);
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

OccupancyGrid mapOfALap(double cell) {
  GridOptions options;
  options.resolution = cell;
  OccupancyGrid map(cell);
  for (size_t i = 0; i < 80; ++i)
    map.insert(ScanBeams(toLaserScans({test::scan(0, test::poseOnLap(i, 80))}, kMaxRange)),
               test::poseOnLap(i, 80), options);
  return map;
}

TEST(VerdictCheck, AnEarlierMapIsComparedIfItsCellsAreSmallEnough) {
  for (const double cell : {0.03, 0.05, 0.1, 0.2}) {
    const OccupancyGrid map = mapOfALap(cell);
    VerdictCheck here(kMaxRange, &map), turned(kMaxRange, &map);
    for (size_t i = 0; i < 80; ++i) {
      here.add(test::poseOnLap(i, 80), {test::scan(0, test::poseOnLap(i, 80))});
      turned.add(TPose2D(0, 0, 1) + test::poseOnLap(i, 80), {test::scan(0, test::poseOnLap(i, 80))});
    }
    const std::vector<Revisit> right = here.evidence().earlier, wrong = turned.evidence().earlier;
    EXPECT_EQ(right.size() > 10, cell <= 0.1) << cell;
    EXPECT_EQ(contradictedOf(right), 0u) << cell;
    EXPECT_EQ(contradictedOf(wrong) > 5, cell <= 0.1) << cell;
  }
}

/// The room, 6 times as large; the path is right, or its mirror image.
Evidence inALargeHall(double maxRange, double mirror) {
  VerdictCheck check(maxRange);
  for (size_t i = 0; i < 240; ++i) {
    const TPose2D pose = test::poseOnLap(i, 80);
    const auto scan = test::scan(0, pose);
    for (size_t beam = 0; beam < scan->getScanSize(); ++beam)
      scan->setScanRange(beam, 6 * scan->getScanRange(beam));
    check.add({6 * pose.x, mirror * 6 * pose.y, mirror * pose.phi}, {scan});
  }
  return check.evidence();
}

TEST(VerdictCheck, LongerBeamsAreComparedWhereTheMapUsesThem) {
  EXPECT_LT(inALargeHall(20, 1).beams, 30) << "of up to 8 m";
  const Evidence right = inALargeHall(80, 1);
  EXPECT_GT(right.beams, 45) << "of up to 32 m";
  EXPECT_GT(right.returning.size(), 100u);
  EXPECT_EQ(verdictOf(right).level, Verdict::Level::consistent) << verdictOf(right).line();
  EXPECT_EQ(verdictOf(inALargeHall(80, -1)).level, Verdict::Level::lost);
}

/// A filter whose robot drives a lap, in the map of an earlier run.
struct Lap : FilterView {
  TPose2D frame;  ///< of the lap in that map
  OccupancyGrid earlier = mapOfALap(0.05);
  std::vector<TPose2D> path;
  FilterStep step;

  size_t updates() const override { return path.size(); }
  const FilterStep& lastStep() const override { return step; }
  std::vector<TPose2D> bestPath() const override { return path; }
  mrpt::maps::COccupancyGridMap2D bestGrid() const override { return {}; }
  std::vector<DatabaseLine> bestLines() const override { return {}; }
  std::vector<WeightedPose> particlePoses() const override { return {{path.back(), 0}}; }
  const OccupancyGrid* earlierMap() const override { return path.size() < 10 ? nullptr : &earlier; }
};

TEST(RunningVerdict, ComparesTheScansWithTheMapThatTheRunContinues) {
  for (const bool isRight : {true, false}) {
    Lap lap;
    if (!isRight) lap.frame = TPose2D(0, 0, 1);
    RunningVerdict running(kMaxRange);
    for (size_t i = 0; i < 80; ++i) {
      lap.path.push_back(lap.frame + test::poseOnLap(i, 80));
      running.add(lap, {test::scan(0, test::poseOnLap(i, 80))});
    }
    const Verdict verdict = running.judge(lap)();
    EXPECT_EQ(verdict.level, isRight ? Verdict::Level::consistent : Verdict::Level::lost) << verdict.line();
  }
}

/// Of a laser that logs 3 m for no return; their ends would contradict the map.
TEST(VerdictCheck, BeamsThatTheMapDoesNotUseAreNotCompared) {
  VerdictCheck check(2.99), withAllBeams(kMaxRange);
  std::vector<TPose2D> path;
  std::vector<Scans> scans;
  for (size_t i = 0; i < 400; ++i) {
    path.push_back(test::poseOnLap(i, 80));
    const auto seen = test::scan(0, path.back());
    for (size_t beam = 0; beam < seen->getScanSize(); ++beam)
      seen->setScanRange(beam, std::min(seen->getScanRange(beam), 3.0f));
    scans.push_back({seen});
    check.add(path.back(), scans.back());
    withAllBeams.add(path.back(), scans.back());
  }
  ASSERT_GT(check.evidence().returning.size(), 20u);
  EXPECT_EQ(verdictOf(check.evidence()).level, Verdict::Level::consistent);
  EXPECT_EQ(verdictOf(withAllBeams.evidence()).level, Verdict::Level::lost);
  EXPECT_LT(contradictionOf(path, scans, 2.99), 0.02);
  EXPECT_GT(contradictionOf(path, scans, kMaxRange), 0.2);
}

TEST(VerdictCheck, TheLongestWayWithoutScansIsTheGap) {
  VerdictCheck check(kMaxRange);
  const auto drive = [&check](const TPose2D& pose) {
    check.addWay(0.1, true);
    check.add(pose, {test::scan(0, pose)});
  };
  drive({0, 0, 0});
  check.addWay(2, true);  // a scan that causes no update ends the gap
  drive({1, 0, 0});
  EXPECT_EQ(check.evidence().gap.length, 2);
  check.addWay(2, false);
  check.addWay(3, false);
  drive({0, 1, 0});
  EXPECT_NEAR(check.evidence().gap.length, 5.1, 1e-9);
  EXPECT_EQ(check.evidence().gap.start, mrpt::math::TPoint2D(1, 0));
  check.addWay(7, false);
  EXPECT_EQ(check.evidence().gap.length, 7) << "to the end of the log";
}

}  // namespace
}  // namespace hybrid_slam::run
