#include "readings/LaserMounting.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include "base/Degree.h"
#include "base/Median.h"
#include "base/PoseDistance.h"

namespace hybrid_slam::readings {

using mrpt::math::TPose2D;

namespace {

constexpr size_t kMostRows = 1000, kFewestRows = 10;
constexpr double kFarthest = 2;                           // m, on the robot
constexpr double kMoved = 0.5, kTurned = 15 * kDegree;    // m, rad
constexpr double kDistance = 0.02, kAngle = 1 * kDegree;  // m, rad: of rows that agree, rounded to 1 cm
constexpr double kSame = 0.005, kSameAngle = 0.005;       // m, rad: of rows without that decision
constexpr double kShare = 0.9;

/// The medians of x, y and the heading.
TPose2D medianOf(const std::vector<TPose2D>& poses) {
  std::vector<double> x, y, phi;
  for (const TPose2D& pose : poses) {
    x.push_back(pose.x), y.push_back(pose.y);
    phi.push_back(mrpt::math::wrapToPi(pose.phi - poses.front().phi));
  }
  return {median(x), median(y), mrpt::math::wrapToPi(poses.front().phi + median(phi))};
}

}  // namespace

void LaserMounting::preview(const TPose2D& laser, const TPose2D& robot) {
  if (isPreviewed()) return;
  mountings_.push_back(laser - robot);
  if (!start_) start_ = robot;
  hasMoved_ = hasMoved_ || !isWithin(robot, *start_, kMoved, kTurned);
}

bool LaserMounting::isPreviewed() const { return mountings_.size() == kMostRows; }

LaserMounting::Agreement LaserMounting::agreement() {
  if (!agreement_) decide();
  return *agreement_;
}

void LaserMounting::decide() {
  agreement_ = Agreement::unknown;
  if (mountings_.size() < kFewestRows || !hasMoved_) return;
  const TPose2D middle = medianOf(mountings_);
  size_t near = 0, alike = 0;
  for (const TPose2D& mounting : mountings_) {
    const bool isHere = distanceBetween(mounting, middle) < kDistance;
    near += isHere;
    alike += isHere && angleBetween(mounting, middle) <= kAngle;
  }
  const double least = kShare * static_cast<double>(mountings_.size());
  if (static_cast<double>(near) < least || middle.norm() > kFarthest) {
    agreement_ = Agreement::none;
  } else if (static_cast<double>(alike) >= least) {  // else a laser that pans
    agreement_ = Agreement::agreed;
    // A row's own digits, if it is not an odd one.
    const TPose2D& first = mountings_.front();
    pose_ = isWithin(first, middle, kDistance, kAngle) ? first : middle;
  }
}

std::optional<TPose2D> LaserMounting::of(const TPose2D& laser, const TPose2D& robot) {
  if (agreement() == Agreement::agreed) return pose_;
  if (*agreement_ == Agreement::none) return std::nullopt;
  const TPose2D mounting = laser - robot;
  if (!pose_) pose_ = mounting;
  if (mounting.norm() > kFarthest || !isWithin(mounting, *pose_, kSame, kSameAngle))
    agreement_ = Agreement::none;
  return *agreement_ == Agreement::none ? std::nullopt : pose_;
}

}  // namespace hybrid_slam::readings
