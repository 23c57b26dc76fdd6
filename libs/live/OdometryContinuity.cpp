#include "live/OdometryContinuity.h"

#include <mrpt/obs/CObservationOdometry.h>

#include "readings/ReadingAssembler.h"

namespace hybrid_slam::live {

void rebase(mrpt::obs::CObservation& observation, OdometryContinuity& continuity) {
  auto* odometry = dynamic_cast<mrpt::obs::CObservationOdometry*>(&observation);
  if (!odometry) return;
  const mrpt::math::TPose2D told = odometry->odometry.asTPose();
  if (!readings::isPossible(told)) return;
  const mrpt::math::TPose2D pose = continuity(told);
  if (!(pose == told)) odometry->odometry = mrpt::poses::CPose2D(pose);
}

}  // namespace hybrid_slam::live
