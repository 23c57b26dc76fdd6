#include "base/OdometryIncrement.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>

#include <mrpt/math/TPose3D.h>

#include "base/Errors.h"

namespace hybrid_slam {

mrpt::math::TPose2D odometryIncrement(const mrpt::obs::CActionCollection& action) {
  auto flat = action.getBestMovementEstimation();
  if (!flat) flat = action.getActionByClass<mrpt::obs::CActionRobotMovement2D>();  // large uncertainty
  if (flat) {
    if (flat->estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry)
      return flat->rawOdometryIncrementReading.asTPose();
    return flat->poseChange->getMeanVal().asTPose();
  }
  if (const auto spatial = action.getActionByClass<mrpt::obs::CActionRobotMovement3D>())
    return mrpt::math::TPose2D(spatial->poseChange.getMeanVal().asTPose());
  throw InputError("no odometry", "action of the step", "expected a CActionRobotMovement2D or 3D");
}

}  // namespace hybrid_slam
