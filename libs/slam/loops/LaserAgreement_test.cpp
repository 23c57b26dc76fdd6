#include "slam/loops/LaserAgreement.h"

#include <gtest/gtest.h>

#include "base/Degree.h"
#include "base/PoseDistance.h"
#include "testing/RoomLog.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

/// The offsets of three laps in the room with a laser in front and one behind.
/// @param error  of the rear laser's logged pose (m, rad)
std::vector<LaserOffset> offsetsWith(const TPose2D& error) {
  const TPose2D front(0.2, 0, 0), rear(-0.2, 0, M_PI);
  LaserAgreement agreement(8);
  double distance = 0;
  TPose2D last = test::poseOnLap(0, 80);
  for (size_t i = 0; i < 240; ++i) {
    const TPose2D pose = test::poseOnLap(i, 80);
    distance += distanceBetween(last, pose);
    last = pose;
    const auto scan = [&](const TPose2D& mounting, const TPose2D& logged, const char* label) {
      auto seen = test::scan(0.1 * static_cast<double>(i), pose + mounting, 181, label);
      seen->sensorPose = mrpt::poses::CPose3D(logged);
      return seen;
    };
    agreement.add(pose, {scan(front, front, "FRONT"), scan(rear, rear + error, "REAR")}, distance);
  }
  return agreement.offsets();
}

TEST(LaserAgreement, LasersWithRightPosesAgree) {
  const std::vector<LaserOffset> offsets = offsetsWith({});
  ASSERT_EQ(offsets.size(), 1u);
  EXPECT_GE(offsets[0].scans, 20u);
  EXPECT_NEAR(offsets[0].turn, 0, 0.2 * kDegree);
  EXPECT_FALSE(offsets[0].isLarge());
}

TEST(LaserAgreement, AWrongYawIsMeasured) {
  for (const double yaw : {-4., -1.5, 1.5, 4.}) {
    const std::vector<LaserOffset> offsets = offsetsWith({0, 0, yaw * kDegree});
    ASSERT_EQ(offsets.size(), 1u) << yaw;
    EXPECT_EQ(offsets[0].laser, "REAR");
    EXPECT_EQ(offsets[0].reference, "FRONT");
    EXPECT_NEAR(offsets[0].turn / kDegree, -yaw, 0.3) << yaw;
    EXPECT_TRUE(offsets[0].isLarge()) << yaw;
  }
}

/// The scans of a robot that only turns are all within the window; of them, the last ones are kept.
TEST(LaserAgreement, ARobotThatTurnsOnTheSpot) {
  LaserAgreement agreement(8);
  for (size_t i = 0; i < 720; ++i) {
    const TPose2D pose(1, 0.5, 20. * static_cast<double>(i) * kDegree);
    const auto front = test::scan(0.1 * static_cast<double>(i), pose, 181, "FRONT"),
               rear = test::scan(0.1 * static_cast<double>(i), pose, 181, "REAR");
    rear->sensorPose = mrpt::poses::CPose3D(TPose2D(0, 0, 2 * kDegree));
    agreement.add(pose, {front, rear}, 0);
  }
  const std::vector<LaserOffset> offsets = agreement.offsets();
  ASSERT_EQ(offsets.size(), 1u);
  EXPECT_GT(offsets[0].scans, 600u) << "without waiting for the robot to drive on";
  EXPECT_NEAR(offsets[0].turn / kDegree, -2, 0.3);
}

TEST(LaserAgreement, OneLaserHasNothingToAgreeWith) {
  LaserAgreement agreement(8);
  for (size_t i = 0; i < 240; ++i)
    agreement.add(test::poseOnLap(i, 80), {test::scan(0, test::poseOnLap(i, 80))},
                  0.1 * static_cast<double>(i));
  EXPECT_TRUE(agreement.offsets().empty());
}

}  // namespace
}  // namespace hybrid_slam
