#include "files/Trajectory.h"

#include <cmath>
#include <ostream>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/NumberTable.h"

namespace hybrid_slam::files {
Trajectory loadTum(const std::string& file) {
  constexpr double kNormTolerance = 0.01;  // quaternions are often written with 3 or 4 digits
  Trajectory trajectory;
  for (const NumberRow& row : readNumberTable(file, "timestamp x y z qx qy qz qw")) {
    const auto& v = row.values;
    checkPose(row, file, {1, 2, 3}, {});
    const double qx = v[4], qy = v[5], qz = v[6], qw = v[7];
    const double squaredNorm = qx * qx + qy * qy + qz * qz + qw * qw;
    if (!(std::abs(std::sqrt(squaredNorm) - 1) <= kNormTolerance))
      throw InputError("broken line", "file `" + file + "`, line " + std::to_string(row.line),
                       "expected a quaternion `qx qy qz qw` of length 1");
    const double yaw = std::atan2(2 * (qw * qz + qx * qy), squaredNorm - 2 * (qy * qy + qz * qz));
    trajectory.push_back({v[0], {v[1], v[2], yaw}});
  }
  return trajectory;
}

void saveTum(const Trajectory& trajectory, std::ostream& out) {
  for (const StampedPose& row : trajectory)
    out << fixedText(row.timestamp, 6) << ' ' << fixedText(row.pose.x, 9) << ' ' << fixedText(row.pose.y, 9)
        << " 0 0 0 " << fixedText(std::sin(row.pose.phi / 2), 9) << ' '
        << fixedText(std::cos(row.pose.phi / 2), 9) << '\n';
}

Trajectory loadOdometry(const std::string& file) {
  Trajectory odometry;
  for (const NumberRow& row : readNumberTable(file, "t x y theta")) {
    const auto& v = row.values;
    checkPose(row, file, {1, 2}, {3});
    odometry.push_back({v[0], {v[1], v[2], v[3]}});
  }
  return odometry;
}

}  // namespace hybrid_slam::files
