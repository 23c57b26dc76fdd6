// The results of a run whose place in an earlier map is found late.
#include <gtest/gtest.h>

#include <atomic>

#include "base/PoseRotation.h"
#include "files/NumberTable.h"
#include "files/TemporaryFolder.h"
#include "files/Trajectory.h"
#include "run/Replay.h"
#include "testing/DriveLog.h"

namespace hybrid_slam::run {
namespace {

struct FoundPlace : testing::Test {
  files::TemporaryFolder folder;

  /// Maps a drive, from the map of an earlier run if one is given.
  std::string map(const std::string& name, const std::vector<test::DriveStep>& drive,
                  const std::string& earlier = {}) const {
    const std::string log = test::writeGzipped(folder.path(name + ".rawlog"), test::logOf(drive));
    Configuration configuration("", {"run.rawlog=" + log, "run.output=" + folder.path(name), "run.refine=0",
                                     "loop_closing.enabled=false", "particle_filter.particles=10"});
    if (!earlier.empty()) configuration.run.continueFrom = earlier + "/session.hslam";
    replay(configuration, true, std::atomic<bool>{false});
    return folder.path(name);
  }
};

Eigen::Matrix3d covarianceOf(const std::vector<double>& row) {
  Eigen::Matrix3d covariance;
  covariance << row[1], row[2], row[4], row[2], row[3], row[5], row[4], row[5], row[6];
  return covariance;
}

TEST_F(FoundPlace, TurnsTheCovariancesOfThePathSoFar) {
  const std::string earlier = map("earlier", test::drive(8, 1));
  auto drive = test::drive(8, 2);
  drive.erase(drive.begin(), drive.begin() + 22);  // begins at a right angle to the earlier one
  const std::string alone = map("alone", drive), joined = map("joined", drive, earlier);
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
