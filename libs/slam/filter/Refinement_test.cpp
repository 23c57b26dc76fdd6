#include "slam/filter/Refinement.h"

#include <gtest/gtest.h>

#include "testing/MappedRoom.h"
#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// Scans of a drive around the room. All poses except the first are off by about 2 cm and 0.3 deg.
std::vector<PosedScans> driven(std::vector<TPose2D>& truth) {
  std::vector<PosedScans> scans;
  RandomStream random(1, 0, 0);
  for (const test::DriveStep& step : test::drive(8)) {
    truth.push_back(step.truth);
    const TPose2D off = scans.empty() ? TPose2D()
                                      : TPose2D(0.02 * random.gaussian(), 0.02 * random.gaussian(),
                                                0.3 * kDegree * random.gaussian());
    scans.push_back({{std::make_shared<mrpt::obs::CObservation2DRangeScan>(step.scan)},
                     {step.truth.x + off.x, step.truth.y + off.y, step.truth.phi + off.phi},
                     scans.size() % 2 == 0});
  }
  return scans;
}

/// Refines the poses with the settings of the room.
void refineRoom(std::vector<PosedScans>& scans, int passes, int threads = 1,
                const std::vector<MotionDistribution>& odometry = {}) {
  FilterConfiguration c = test::roomConfiguration();
  c.filter.threads = threads;
  refine(scans, passes, c, std::nullopt, odometry);
}

/// The error of the motions from each scan to the next, m: it does not depend on the map frame.
double rmsOfMotions(const std::vector<PosedScans>& scans, const std::vector<TPose2D>& truth) {
  std::vector<TPose2D> motions, trueMotions;
  for (size_t i = 1; i < scans.size(); ++i) {
    motions.push_back(scans[i].pose - scans[i - 1].pose);
    trueMotions.push_back(truth[i] - truth[i - 1]);
  }
  return test::rms(motions, trueMotions);
}

TEST(Refinement, BringsThePosesNearerToTheTruth) {
  std::vector<TPose2D> truth;
  std::vector<PosedScans> scans = driven(truth);
  const double before = rmsOfMotions(scans, truth);
  refineRoom(scans, 2);
  EXPECT_LT(rmsOfMotions(scans, truth), 0.5 * before);
}

// A filter matches the second scan to a map of the first one alone.
TEST(Refinement, MatchesTheFirstScanToo) {
  std::vector<TPose2D> truth;
  std::vector<PosedScans> scans = driven(truth);
  for (size_t i = 0; i < scans.size(); ++i) scans[i].pose = truth[i];
  scans[0].pose.y += 0.03, scans[0].pose.phi += kDegree;
  refineRoom(scans, 2);
  EXPECT_LT((scans[0].pose - truth[0]).norm(), 0.01);
  EXPECT_LT(std::abs(scans[0].pose.phi - truth[0].phi), 0.4 * kDegree);
}

TEST(Refinement, AllScansMoveWithTheFirst) {
  std::vector<PosedScans> scans{{{}, {1, 2, 0.5}}, {{}, {3, 2, 1.5}}, {{}, {0, 0, 0}}};
  const std::vector<PosedScans> before = scans;
  moveFirstTo({}, scans);
  EXPECT_EQ(scans[0].pose, TPose2D());
  for (size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(scans[i].pose, before[i].pose - before[0].pose);
    EXPECT_NE(scans[i].pose, before[i].pose);
  }
}

/// The odometry that says that the robot drove along `path`.
std::vector<MotionDistribution> odometryAlong(const std::vector<TPose2D>& path) {
  std::vector<MotionDistribution> odometry;
  for (size_t i = 1; i < path.size(); ++i)
    odometry.push_back(motionDistribution({}, path[i] - path[i - 1], MotionModelOptions()));
  return odometry;
}

/// A drive of which two scans are half a room off, out of reach of a match from there.
class RefinementFarOff : public testing::TestWithParam<TPose2D> {
 protected:
  RefinementFarOff() {
    for (const size_t i : kFarOff) scans_[i].pose = truth_[i] + GetParam();
  }
  double error(size_t i) const { return (scans_[i].pose - truth_[i]).norm(); }

  static constexpr size_t kFarOff[] = {3, 6};  // between two updates, and in the map at a wrong place
  std::vector<TPose2D> truth_;
  std::vector<PosedScans> scans_ = driven(truth_);
};

TEST_P(RefinementFarOff, AScanGoesWhereItFitsAndTheOdometrySaysItWas) {
  refineRoom(scans_, 1, 1, odometryAlong(truth_));
  for (const size_t i : kFarOff) EXPECT_LT(error(i), 0.03) << i;
}

// The scan may be right, and the walls wrong.
TEST_P(RefinementFarOff, AScanThatTheOdometryPutsThereStays) {
  std::vector<TPose2D> path;
  for (const PosedScans& scan : scans_) path.push_back(scan.pose);
  refineRoom(scans_, 1, 1, odometryAlong(path));
  for (const size_t i : kFarOff) EXPECT_GT(error(i), 0.2) << i;
}

TEST_P(RefinementFarOff, AScanStaysWithoutOdometry) {
  refineRoom(scans_, 1);
  for (const size_t i : kFarOff) EXPECT_GT(error(i), 0.2) << i;
}

INSTANTIATE_TEST_SUITE_P(AheadBehindLeftRight, RefinementFarOff,
                         testing::Values(TPose2D(0.4, 0, 0), TPose2D(-0.3, 0, 0), TPose2D(0, 0.35, 0),
                                         TPose2D(0, -0.3, 0)));

// In a corridor without features, a scan fits other places a little better by chance. At both ends of the
// drive, fewer scans have seen the walls, so that scans fit better further inside.
TEST(Refinement, AScanThatFitsItsPlaceStays) {
  std::vector<TPose2D> truth;
  std::vector<PosedScans> scans;
  for (const DrivenPose& step : driveAlong(kCorridor, {{0, 0}, {6, 0}}, 0)) {
    truth.push_back(step.truth);
    scans.push_back({observed(step.scans[0]), step.truth, true});
  }
  std::vector<MotionDistribution> uncertain = odometryAlong(truth);
  for (MotionDistribution& motion : uncertain) motion.covariance.setIdentity();
  refineRoom(scans, 1, 1, uncertain);
  for (size_t i = 4; i + 4 < scans.size(); ++i) EXPECT_LT((scans[i].pose - truth[i]).norm(), 0.05) << i;
}

TEST(Refinement, IsTheSameForAnyNumberOfThreads) {
  std::vector<TPose2D> truth;
  std::vector<PosedScans> one = driven(truth), three = one;
  refineRoom(one, 1, 1, odometryAlong(truth));
  refineRoom(three, 1, 3, odometryAlong(truth));
  for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].pose, three[i].pose);
}

TEST(Refinement, ZeroPassesChangeNothing) {
  std::vector<TPose2D> truth;
  std::vector<PosedScans> scans = driven(truth);
  const std::vector<PosedScans> before = scans;
  refineRoom(scans, 0);
  for (size_t i = 0; i < scans.size(); ++i) EXPECT_EQ(scans[i].pose, before[i].pose);
}

TEST(Refinement, TheMapIsThatOfTheMappedScans) {
  std::vector<TPose2D> truth;
  std::vector<PosedScans> scans = driven(truth);
  const FilterConfiguration c = test::roomConfiguration();
  OccupancyGrid grid(c.grid.resolution);
  for (const PosedScans& s : scans)
    if (s.isMapped) grid.insert(ScanBeams(toLaserScans(s.scans, c.grid.maxRange)), s.pose, c.grid);
  const ScanMap map = MapMaker(c)(scans);
  size_t cells = 0;
  grid.tiles().forEachTile([&](int tx, int ty, const Tile& tile) {
    ASSERT_TRUE(map.grid.tiles().tileAt(tx, ty));
    EXPECT_EQ(map.grid.tiles().tileAt(tx, ty)->cells(), tile.cells());
    ++cells;
  });
  EXPECT_GT(cells, 20u);
  EXPECT_GE(map.lines.lines().size(), 3u);
  FilterConfiguration general = c;
  general.useLines = false;
  EXPECT_TRUE(MapMaker(general)(scans).lines.lines().empty());
}

/// A drive as the refinement gets it: one pose and one reading for each update.
struct WholeLog {
  std::vector<TPose2D> path, truth;
  std::vector<Scans> scans;
};

WholeLog wholeLog(const std::vector<DrivenPose>& drive) {
  WholeLog log;
  for (const DrivenPose& step : drive) {
    log.path.push_back(log.path.empty() ? step.truth : log.path.back() + step.motion);
    log.truth.push_back(step.truth);
    log.scans.push_back(observed(step.scans[0]));
  }
  return log;
}

FilterConfiguration withLines(bool useLines) {
  FilterConfiguration c;
  c.useLines = useLines;
  return c;
}

TEST(CloseLoops, CorrectsAWholePath) {
  const WholeLog log = wholeLog(ringDrive(0.03 * kDegree));
  std::vector<TPose2D> path = log.path;
  const auto closures = closeLoops(path, log.scans, std::nullopt, withLines(false));
  ASSERT_FALSE(closures.empty());
  EXPECT_EQ(path, closures.back().path);
  ASSERT_EQ(path.size(), log.path.size());
  EXPECT_LT((path[0] - log.path[0]).norm(), 1e-6) << "the first pose defines the map frame";
  EXPECT_LT(test::rms(path, log.truth), 0.5 * test::rms(log.path, log.truth));
  for (const LoopClosure& closure : closures) {
    ASSERT_TRUE(closure.earlier);
    EXPECT_LT(*closure.earlier, closure.later);
    EXPECT_LT(closure.later, log.scans.size());
  }
}

TEST(CloseLoops, PosesWithoutScansFollowTheLastScan) {
  WholeLog log = wholeLog(ringDrive(0.03 * kDegree));
  log.scans.resize(log.scans.size() - 40);
  std::vector<TPose2D> path = log.path;
  ASSERT_FALSE(closeLoops(path, log.scans, std::nullopt, withLines(false)).empty());
  ASSERT_EQ(path.size(), log.path.size());
  for (size_t i = log.scans.size(); i < path.size(); ++i) {
    const TPose2D motion = path[i] - path[i - 1], before = log.path[i] - log.path[i - 1];
    EXPECT_NEAR(motion.x, before.x, 1e-9);
    EXPECT_NEAR(motion.y, before.y, 1e-9);
    EXPECT_NEAR(motion.phi, before.phi, 1e-9);
  }
}

TEST(CloseLoops, APathThatClosesItselfStaysAsItIs) {
  const WholeLog log = wholeLog(ringDrive(0));
  std::vector<TPose2D> path = log.path;
  EXPECT_TRUE(closeLoops(path, log.scans, std::nullopt, withLines(false)).empty());
  EXPECT_EQ(path, log.path);
}

// One wrong turn: see LoopCloser_test.
TEST(CloseLoops, UsesTheDirectionOfTheWalls) {
  auto drive = ringDrive(0);
  drive[63].motion.phi += 2.5 * kDegree;
  const WholeLog log = wholeLog(drive);
  std::vector<TPose2D> without = log.path, with = log.path;
  ASSERT_FALSE(closeLoops(without, log.scans, std::nullopt, withLines(true)).empty());
  ASSERT_FALSE(closeLoops(with, log.scans, 0.0, withLines(true)).empty());
  EXPECT_LT(test::rms(with, log.truth), 0.6 * test::rms(without, log.truth));
}

}  // namespace
}  // namespace hybrid_slam
