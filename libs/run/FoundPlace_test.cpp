// The results of a run whose place in an earlier map is found late.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "base/PoseRotation.h"
#include "files/NumberTable.h"
#include "files/TemporaryFolder.h"
#include "files/Trajectory.h"
#include "run/Replay.h"
#include "testing/DriveLog.h"
#include "testing/RingDrive.h"

namespace hybrid_slam::run {
namespace {

struct FoundPlace : testing::Test {
  files::TemporaryFolder folder;
  std::string incomplete;  ///< why the results of the last run are

  /// Maps a log, from the map of an earlier run if one is given.
  std::string map(const std::string& name, const test::Log& entries, const std::string& earlier = {}) {
    const std::string log = test::writeGzipped(folder.path(name + ".rawlog"), entries);
    Configuration configuration("", {"run.rawlog=" + log, "run.output=" + folder.path(name), "run.refine=0",
                                     "loop_closing.enabled=false", "particle_filter.particles=10"});
    if (!earlier.empty()) configuration.run.continueFrom = earlier + "/session.hslam";
    incomplete = replay(configuration, true, std::atomic<bool>{false}).incomplete;
    return folder.path(name);
  }
};

/// A log of a drive along two sides of a block of 30 m x 18 m. The corridors are those of
/// `ring`, but the first one reaches down to y = `low` (m).
test::Log aroundTheBlock(double low) {
  test::Walls walls = test::ring();
  if (low < -1.5) {
    walls = test::box(-3, low, 33, 22.5);
    const test::Walls inside = test::ring();
    walls.insert(walls.end(), inside.begin() + 4, inside.end());
  }
  const auto drive = test::driveAlong(walls, {{0, 0}, {31.5, 0}, {31.5, 18}}, 0);
  test::Log log;
  test::TPose2D pose;
  for (const test::DrivenPose& driven : drive) {
    pose = pose + driven.motion;
    const double time = 1000 + 0.1 * static_cast<double>(log.size());
    const auto scan = test::observed(driven.scans[0])[0];
    scan->timestamp = test::stamp(time);
    scan->sensorLabel = "LASER";
    log.push_back(test::odometry(time, pose));
    log.push_back(scan);
  }
  return log;
}

/// The last corridors of two buildings are alike, the first ones are not.
TEST_F(FoundPlace, ACorridorOfAnotherBuildingIsNotTaken) {
  const std::string earlier = map("earlier", aroundTheBlock(-1.5));
  map("again", aroundTheBlock(-1.5), earlier);
  EXPECT_EQ(incomplete, "");
  map("other", aroundTheBlock(-4), earlier);
  EXPECT_THAT(incomplete, testing::HasSubstr("place not found"));
}

Eigen::Matrix3d covarianceOf(const std::vector<double>& row) {
  Eigen::Matrix3d covariance;
  covariance << row[1], row[2], row[4], row[2], row[3], row[5], row[4], row[5], row[6];
  return covariance;
}

TEST_F(FoundPlace, TurnsTheCovariancesOfThePathSoFar) {
  const std::string earlier = map("earlier", test::logOf(test::drive(8, 1)));
  auto drive = test::drive(8, 2);
  drive.erase(drive.begin(), drive.begin() + 22);  // begins at a right angle to the earlier one
  const std::string alone = map("alone", test::logOf(drive)),
                    joined = map("joined", test::logOf(drive), earlier);
  const double turn = files::loadTum(joined + "/trajectory.tum").front().pose.phi;
  ASSERT_NEAR(turn, M_PI / 2, 0.02);
  const std::string columns = "timestamp,xx,xy,yy,xphi,yphi,phiphi";
  const auto before = files::readNumberTable(alone + "/covariance.csv", columns);
  const auto after = files::readNumberTable(joined + "/covariance.csv", columns);
  for (const size_t row : {2, 4}) {  // the place is found later
    const Eigen::Matrix3d was = covarianceOf(before[row].values);
    const Eigen::Matrix3d is = covarianceOf(after[row].values);
    EXPECT_GT(std::abs(was(0, 0) - was(1, 1)), 0.02 * was.norm()) << "the axes differ";
    EXPECT_TRUE(is.isApprox(rotated(was, turn), 0.02)) << row << ":\n" << was << "\n\n" << is;
  }
}

}  // namespace
}  // namespace hybrid_slam::run
