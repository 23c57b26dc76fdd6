#include "base/OdometryIncrement.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/poses/CPosePDFGaussian.h>

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CActionCollection;

void expectPose(const TPose2D& actual, const TPose2D& expected, double tolerance) {
  EXPECT_NEAR(actual.x, expected.x, tolerance);
  EXPECT_NEAR(actual.y, expected.y, tolerance);
  EXPECT_NEAR(actual.phi, expected.phi, tolerance);
}

TEST(OdometryIncrement, TakesEveryKindOfMovement) {
  const TPose2D motion(0.3, -0.1, 0.2);

  mrpt::obs::CActionRobotMovement2D measured;
  measured.computeFromOdometry(mrpt::poses::CPose2D(motion), {});
  CActionCollection odometry;
  odometry.insert(measured);
  EXPECT_EQ(odometryIncrement(odometry), motion);

  mrpt::obs::CActionRobotMovement2D matched;
  matched.computeFromEncoders(0, 0, 0);
  matched.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
  matched.poseChange = mrpt::poses::CPosePDFGaussian::Create(mrpt::poses::CPose2D(motion));
  CActionCollection planar;
  planar.insert(matched);
  expectPose(odometryIncrement(planar), motion, 1e-12);

  mrpt::obs::CActionRobotMovement3D spatial;
  spatial.poseChange.mean = mrpt::poses::CPose3D(0.3, -0.1, 0, 0.2, 0, 0);
  CActionCollection collection;
  collection.insert(spatial);
  expectPose(odometryIncrement(collection), motion, 1e-12);
}

}  // namespace
}  // namespace hybrid_slam
