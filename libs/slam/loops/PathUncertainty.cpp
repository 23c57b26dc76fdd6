#include "slam/loops/PathUncertainty.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double square(double x) { return x * x; }

/// The covariance of a place fixed to a pose, `lever` from it, by that of the pose.
Eigen::Matrix3d movedBy(const Eigen::Vector2d& lever, const Eigen::Matrix3d& covariance) {
  Eigen::Matrix3d effect = Eigen::Matrix3d::Identity();
  effect(0, 2) = -lever.y(), effect(1, 2) = lever.x();
  return effect * covariance * effect.transpose();
}

}  // namespace

StepVariance stepVariance(const TPose2D& motion, bool hasSlipped) {
  StepVariance variance{
      square(0.05) * motion.norm() + square(0.002),
      square(mrpt::DEG2RAD(0.25)) * motion.norm() + square(0.01 * motion.phi) + square(mrpt::DEG2RAD(0.02))};
  if (hasSlipped) variance.position += square(0.3), variance.heading += square(mrpt::DEG2RAD(5.0));
  return variance;
}

PathUncertainty::PathUncertainty(const std::vector<TPose2D>& path, const std::vector<StepVariance>& steps) {
  Sums sum;
  for (size_t i = 0; i < path.size(); ++i) {
    places_.emplace_back(path[i].x, path[i].y);
    if (i > 0) {
      sum.position += steps[i].position;
      sum.heading += steps[i].heading;
      sum.moment += steps[i].heading * places_[i];
      sum.secondMoment += steps[i].heading * places_[i] * places_[i].transpose();
    }
    sums_.push_back(sum);
  }
}

Eigen::Matrix3d PathUncertainty::along(size_t a, size_t b, const Eigen::Vector2d& at) const {
  const Sums &first = sums_[std::min(a, b)], &last = sums_[std::max(a, b)];
  const double heading = last.heading - first.heading;
  const Eigen::Vector2d moment = last.moment - first.moment;
  // The sum of heading x lever x lever^T, each lever from the motion to `at`; then all levers turned by 90
  // deg: the direction in which a heading error moves `at`.
  const Eigen::Matrix2d levers = last.secondMoment - first.secondMoment - moment * at.transpose() -
                                 at * moment.transpose() + heading * at * at.transpose();
  const Eigen::Vector2d lever = heading * at - moment;
  Eigen::Matrix3d covariance;
  covariance << levers(1, 1), -levers(0, 1), -lever.y(),  //
      -levers(0, 1), levers(0, 0), lever.x(),             //
      -lever.y(), lever.x(), heading;
  covariance.topLeftCorner<2, 2>().diagonal().array() += last.position - first.position;
  return covariance;
}

Eigen::Matrix3d PathUncertainty::between(size_t from, size_t to, const std::vector<KnownPair>& known) const {
  const Eigen::Vector2d& at = places_[to];
  Eigen::Matrix3d least = along(from, to, at);
  for (const KnownPair& pair : known) {
    if (pair.earlier == KnownPair::kMapFrame) continue;
    const size_t near = from <= to ? pair.earlier : pair.later, far = from <= to ? pair.later : pair.earlier;
    const Eigen::Matrix3d ofPair =
        pair.hasLever ? movedBy(at - places_[pair.later], pair.covariance) : pair.covariance;
    const Eigen::Matrix3d detour = along(from, near, at) + ofPair + along(far, to, at);
    if (detour(0, 0) + detour(1, 1) < least(0, 0) + least(1, 1)) least = detour;
  }
  return least;
}

Eigen::Matrix3d PathUncertainty::relaxed(size_t from, size_t to, const std::vector<KnownPair>& known) const {
  const Eigen::Vector2d& at = places_[to];
  const auto [first, last] = std::minmax(from, to);
  Eigen::Matrix3d least = along(first, last, at);
  for (const KnownPair& pair : known) {
    const size_t begin = std::max(first, pair.earlier), end = std::min(last, pair.later);
    if (begin >= end) continue;
    const Eigen::Matrix3d through = along(begin, end, at);
    const Eigen::Matrix3d around = along(pair.earlier, begin, at) +
                                   movedBy(at - places_[pair.later], pair.covariance) +
                                   along(end, pair.later, at);
    const Eigen::Matrix3d both = through - through * (through + around).inverse() * through;
    const Eigen::Matrix3d here = along(first, begin, at) + both + along(end, last, at);
    if (here(0, 0) + here(1, 1) < least(0, 0) + least(1, 1)) least = (here + here.transpose()) / 2;
  }
  return least;
}

std::optional<Eigen::Matrix3d> PathUncertainty::inMap(size_t to, const std::vector<KnownPair>& known) const {
  std::optional<Eigen::Matrix3d> least;
  for (const KnownPair& pair : known) {
    if (pair.earlier != KnownPair::kMapFrame) continue;
    const Eigen::Matrix3d here = pair.covariance + along(pair.later, to, places_[to]);
    if (!least || here.topLeftCorner<2, 2>().trace() < least->topLeftCorner<2, 2>().trace()) least = here;
  }
  return least;
}

}  // namespace hybrid_slam
