#include "readings/EndPointReader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::readings {
namespace {

InputOptions lasers(const std::string& labels) {
  InputOptions options;
  options.sensorLabel = labels;
  return options;
}

struct EndPointReader : testing::Test {
  files::TemporaryFolder folder;
  std::string rawlog() const { return folder.path("l.rawlog"); }
};

TEST_F(EndPointReader, BeamsEndOnTheWallsAsTheRobotSeesThem) {
  const test::TPose2D pose(1, 0.5, 0.3), onRobot(0.2, 0.1, -0.4);
  const auto scan = test::scan(7, pose + onRobot);
  scan->sensorPose = mrpt::poses::CPose3D(mrpt::poses::CPose2D(onRobot));
  scan->setScanRangeValidity(3, false);
  test::writeGzipped(rawlog(), {test::scan(5), test::scan(7, {}, 181, "OTHER"), scan});
  const auto scans = loadEndPoints(rawlog(), lasers("LASER"));
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_DOUBLE_EQ(scans[1].timestamp, 7);
  EXPECT_EQ(scans[0].points.size(), 181u);
  EXPECT_EQ(scans[1].points.size(), 180u);
  for (const auto& point : scans[1].points) {
    const auto inRoom = pose.composePoint(point);
    EXPECT_NEAR(std::min(test::kHalfLength - std::abs(inRoom.x), test::kHalfWidth - std::abs(inRoom.y)), 0,
                1e-5);
  }
}

TEST_F(EndPointReader, LaserAndRangeCanBeChosen) {
  test::writeGzipped(rawlog(), {test::scan(5), test::scan(6, {}, 91, "OTHER")});
  const auto scans = loadEndPoints(rawlog(), lasers("OTHER"), 4);
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_GT(scans[0].points.size(), 20u);
  EXPECT_LT(scans[0].points.size(), 91u);
  for (const auto& point : scans[0].points) EXPECT_LT(point.norm(), 4);
  EXPECT_THROW(loadEndPoints(rawlog(), lasers("NONE")), InputError);
}

TEST_F(EndPointReader, WarningsAreReported) {
  test::writeGzipped(rawlog(), {test::scan(5), test::scan(6, {}, 0, "BLIND")});
  std::vector<std::string> all;
  loadEndPoints(rawlog(), {}, 80, [&](const std::vector<std::string>& warnings) { all = warnings; });
  EXPECT_THAT(all, testing::Contains("laser `BLIND` is not used: no beams"));
}

TEST_F(EndPointReader, TooManyEndPointsAreAnErrorBeforeTheyFillTheMemory) {
  test::writeGzipped(rawlog(), {test::scan(5), test::scan(6), test::scan(7)});
  EXPECT_EQ(loadEndPoints(rawlog(), {}, 80, {}, 3 * 181 + 3).size(), 3u);
  EXPECT_EQ(test::errorOf([&] { loadEndPoints(rawlog(), {}, 80, {}, 3 * 181 + 2); }),
            "too many scans: " + rawlog() + ", scan 3; expected at most 545 scans and valid beams together");
}

TEST_F(EndPointReader, ATruncatedLogIsAnError) {
  test::writePlain(rawlog(), test::laps(20));
  std::filesystem::resize_file(rawlog(), std::filesystem::file_size(rawlog()) - 100);
  EXPECT_THROW(loadEndPoints(rawlog()), InputError);
}

}  // namespace
}  // namespace hybrid_slam::readings
