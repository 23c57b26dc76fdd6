#include "base/BeamFan.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>

#include "base/DeskewedScan.h"

namespace hybrid_slam {

BeamFan::BeamFan(const mrpt::obs::CObservation2DRangeScan& scan)
    : beams_(scan.getScanSize()),
      aperture_(scan.aperture),
      step_(beams_ > 1 ? aperture_ / static_cast<double>(beams_ - 1) : 0) {
  const auto rotation = scan.sensorPose.getRotationMatrix();
  const bool isUpsideDown = rotation(2, 2) < 0;
  sensorPose_ = {scan.sensorPose.x(), scan.sensorPose.y(), std::atan2(rotation(1, 0), rotation(0, 0))};
  isReversed_ = scan.rightToLeft == isUpsideDown;
  const auto* deskewed = dynamic_cast<const DeskewedScan*>(&scan);
  if (deskewed && !deskewed->angles.empty()) angles_ = &deskewed->angles;
}

}  // namespace hybrid_slam
