#include "readings/LaserPose.h"

#include <mrpt/core/bits_math.h>

#include <cmath>
#include <vector>

#include "base/Errors.h"
#include "base/LaserScan.h"
#include "base/Numbers.h"
#include "readings/ScanGrouper.h"

namespace hybrid_slam::readings {

std::optional<mrpt::poses::CPose3D> laserPoseIn(const std::string& text) {
  if (text == "auto") return std::nullopt;
  std::vector<double> v;
  for (const std::string& field : labelsOf(text)) v.push_back(parseFinite(field).value_or(NAN));
  if (v.size() == 3) v.push_back(0);
  const bool isPose = v.size() == 4 && std::hypot(v[0], v[1]) <= kMaxSensorDistance &&
                      std::abs(v[2]) <= 360 && (v[3] == 0 || std::abs(v[3]) == 180);
  if (!isPose)
    throw InputError("wrong pose `" + text + "`", "section [input], key `laser_pose`",
                     "expected `auto`, or X, Y, YAW[, ROLL] (m, deg): within 100 m, ROLL 0 or 180");
  return mrpt::poses::CPose3D(v[0], v[1], 0, mrpt::DEG2RAD(v[2]), 0, mrpt::DEG2RAD(v[3]));
}

}  // namespace hybrid_slam::readings
