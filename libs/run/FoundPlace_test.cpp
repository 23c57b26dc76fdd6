// The results of a run whose place in an earlier map is found late.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <optional>

#include "base/Errors.h"
#include "base/PoseDistance.h"
#include "base/PoseRotation.h"
#include "files/NumberTable.h"
#include "files/TemporaryFolder.h"
#include "files/Trajectory.h"
#include "run/Replay.h"
#include "testing/DriveLog.h"
#include "testing/RingDrive.h"

namespace hybrid_slam::run {
namespace {

struct FoundPlaceTest : testing::Test {
  files::TemporaryFolder folder;
  std::string incomplete;             ///< why the results of the last run are
  std::vector<std::string> settings;  ///< beside those of all runs

  std::optional<mrpt::math::TPose2D> start;
  std::string resume;  ///< session
  Verdict verdict;     ///< of the last run

  /// Maps a log, from the map of an earlier run if one is given.
  std::string map(const std::string& name, const test::Log& entries, const std::string& earlier = {}) {
    const std::string log = test::writeGzipped(folder.path(name + ".rawlog"), entries);
    std::vector<std::string> all = {"run.rawlog=" + log, "run.output=" + folder.path(name), "run.refine=0",
                                    "loop_closing.enabled=false", "particle_filter.particles=10"};
    all.insert(all.end(), settings.begin(), settings.end());
    Configuration configuration("", all);
    configuration.run.start = start;
    configuration.run.resume = resume;
    if (!earlier.empty()) configuration.run.continueFrom = earlier + "/session.hslam";
    const ReplayOutcome outcome = replay(configuration, true, std::atomic<bool>{false});
    incomplete = outcome.incomplete;
    verdict = outcome.verdict;
    return folder.path(name);
  }
};

/// Truth and log of a drive around a block of 30 m x 18 m. The corridors are those of `ring`, but the first
/// one reaches down to y = `low` (m).
struct AroundTheBlock {
  std::vector<test::TPose2D> truth;
  test::Log log;

  explicit AroundTheBlock(double low,
                          const std::vector<test::TPoint2D>& corners = {{0, 0}, {31.5, 0}, {31.5, 18}}) {
    test::Walls walls = test::ring();
    if (low < -1.5) {
      walls = test::box(-3, low, 33, 22.5);
      const test::Walls inside = test::ring();
      walls.insert(walls.end(), inside.begin() + 4, inside.end());
    }
    test::TPose2D pose;
    for (const test::DrivenPose& driven : test::driveAlong(walls, corners, 0)) {
      pose = pose + driven.motion;
      truth.push_back(driven.truth);
      const double time = 1000 + 0.1 * static_cast<double>(log.size());
      const auto scan = test::observed(driven.scans[0])[0];
      scan->timestamp = test::stamp(time);
      scan->sensorLabel = "LASER";
      log.push_back(test::odometry(time, pose));
      log.push_back(scan);
    }
  }
};

/// The last corridors of two buildings are alike, the first ones are not.
TEST_F(FoundPlaceTest, ACorridorOfAnotherBuildingIsNotTaken) {
  const std::string earlier = map("earlier", AroundTheBlock(-1.5).log);
  map("again", AroundTheBlock(-1.5).log, earlier);
  EXPECT_EQ(incomplete, "");
  map("other", AroundTheBlock(-4).log, earlier);
  EXPECT_THAT(incomplete, testing::HasSubstr("place not found"));
}

/// The first corridor has changed, so the place is taken only after others, at a scan between two updates.
TEST_F(FoundPlaceTest, BetweenTwoUpdatesJoinsTheMapAtThePoseOfTheScan) {
  const std::vector<test::TPoint2D> corners = {{0, 0}, {31.5, 0}, {31.5, 21}, {-1.5, 21}};
  const std::string earlier = map("earlier", AroundTheBlock(-1.5, corners).log);
  for (const std::string distance : {"0.8", "1.3"}) {
    const AroundTheBlock changed(-4, corners);
    settings = {"improved_proposal.update_distance=" + distance};
    const std::string joined = map("joined" + distance, changed.log, earlier);
    ASSERT_EQ(incomplete, "");
    const files::Trajectory trajectory = files::loadTum(joined + "/trajectory.tum");
    ASSERT_EQ(trajectory.size(), changed.truth.size());
    for (size_t i = 0; i < trajectory.size(); i += 20)
      EXPECT_LT(distanceBetween(trajectory[i].pose, changed.truth[i]), 0.2) << i;
  }
}

TEST_F(FoundPlaceTest, AResumedRunIsComparedWithTheEarlierMapToo) {
  const std::string earlier = map("earlier", AroundTheBlock(-1.5).log);
  test::Log other = AroundTheBlock(-4, {{0, 0}, {20, 0}}).log;
  start = mrpt::math::TPose2D();
  map("whole", other, earlier);
  EXPECT_THAT(verdict.line(), testing::HasSubstr("contradict the map that the run continues"));
  const std::string line = verdict.line();
  const test::Log begun(other.begin(), other.begin() + 60);
  resume = map("begun", begun, earlier) + "/session.hslam";
  start.reset();
  map("resumed", other);
  EXPECT_EQ(verdict.line(), line);
}

TEST_F(FoundPlaceTest, ARunWithoutOneIsNotResumed) {
  const std::string earlier = map("earlier", test::logOf(test::drive(8, 1)));
  const test::Log log = test::logOf(test::drive(8, 2));
  resume = map("begun", test::Log(log.begin(), log.begin() + 4), earlier) + "/session.hslam";
  ASSERT_THAT(incomplete, testing::HasSubstr("place not found"));
  try {
    map("resumed", log);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(messageOf(error),
              "the run had not found its place in the earlier map or floor plan: " + resume +
                  "; expected a session of a placed run; this one can be the map of "
                  "--continue");
  }
}

Eigen::Matrix3d covarianceOfRow(const std::vector<double>& row) {
  Eigen::Matrix3d covariance;
  covariance << row[1], row[2], row[4], row[2], row[3], row[5], row[4], row[5], row[6];
  return covariance;
}

TEST_F(FoundPlaceTest, TurnsTheCovariancesOfThePathSoFar) {
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
    const Eigen::Matrix3d was = covarianceOfRow(before[row].values);
    const Eigen::Matrix3d is = covarianceOfRow(after[row].values);
    EXPECT_GT(std::abs(was(0, 0) - was(1, 1)), 0.02 * was.norm()) << "the axes differ";
    EXPECT_TRUE(is.isApprox(rotated(was, turn), 0.02)) << row << ":\n" << was << "\n\n" << is;
  }
}

}  // namespace
}  // namespace hybrid_slam::run
