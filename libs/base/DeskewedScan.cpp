#include "base/DeskewedScan.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include "base/BeamFan.h"
#include "base/Memory.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;

namespace {
constexpr size_t kBeamBytes = 32;  // of a deskewed scan
}

std::shared_ptr<DeskewedScan> deskew(const CObservation2DRangeScan& scan,
                                     const std::vector<TPose2D>& motion) {
  expectMemory(kBeamBytes * scan.getScanSize());
  auto out = std::make_shared<DeskewedScan>(scan);
  for (size_t i = 0; i < scan.getScanSize(); ++i) out->measured.push_back(scan.getScanRange(i));
  const BeamFan fan(scan);
  if (fan.beams() < 2) return out;
  const TPose2D sensor = fan.sensorPose();
  const size_t last = fan.beams() - 1;
  const double firstAngle = fan.angle(0) + motion.front().phi,
               lastAngle = fan.angle(last) + motion.back().phi, middle = (firstAngle + lastAngle) / 2;

  out->angles.resize(fan.beams());
  for (size_t i = 0; i <= last; ++i) {
    const double angle = fan.angle(i), range = scan.getScanRange(i);
    double corrected = angle + motion[i].phi;
    if (scan.getScanRangeValidity(i)) {
      const TPoint2D end = sensor.inverseComposePoint(
          (motion[i] + sensor).composePoint({range * std::cos(angle), range * std::sin(angle)}));
      corrected += mrpt::math::wrapToPi(std::atan2(end.y, end.x) - corrected);  // no step at +-pi
      out->setScanRange(i, static_cast<float>(end.norm()));
    }
    out->angles[i] = corrected - middle;
  }

  out->aperture = static_cast<float>(std::abs(lastAngle - firstAngle));
  const TPoint2D at(sensor.x, sensor.y);
  out->sensorPose = mrpt::poses::CPose3D(0, 0, 0, middle, 0, 0) + scan.sensorPose;
  out->sensorPose.x(at.x), out->sensorPose.y(at.y);
  return out;
}

std::shared_ptr<CObservation2DRangeScan> copyOf(const CObservation2DRangeScan& scan) {
  expectMemory(kBeamBytes * scan.getScanSize());
  if (const auto* deskewed = dynamic_cast<const DeskewedScan*>(&scan))
    return std::make_shared<DeskewedScan>(*deskewed);
  return CObservation2DRangeScan::Create(scan);
}

}  // namespace hybrid_slam
