#include "slam/motion/MotionBelief.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

namespace hybrid_slam {

MotionTerm MotionBelief::Term::model(MotionTerm prior) const {
  if (prior.meanStd == 0) return prior;
  const double known = 1 / (prior.meanStd * prior.meanStd);
  const double determinant = (dd + known) * (tt + known) - dt * dt;
  // The covariance of the means is the inverse of the information.
  const double varianceD = (tt + known) / determinant, varianceT = (dd + known) / determinant;
  const double covariance = -dt / determinant;
  prior.meanD += varianceD * d + covariance * t;
  prior.meanT += covariance * d + varianceT * t;
  prior.varianceD += varianceD;
  prior.varianceT += varianceT;
  prior.covariance += covariance;
  return prior;
}

void MotionBelief::Term::learn(const MotionStep& odometry, double value, const MotionTerm& prior,
                               double minStd) {
  constexpr double kLeastVariance = 1e-8;  // (0.1 mm, 0.1 mrad)^2
  const double weight = 1 / (prior.variance(odometry, minStd) + kLeastVariance);
  const double residual = value - prior.mean(odometry);
  dd += weight * odometry.distance * odometry.distance;
  dt += weight * odometry.distance * odometry.turn;
  tt += weight * odometry.turn * odometry.turn;
  d += weight * odometry.distance * residual;
  t += weight * odometry.turn * residual;
}

MotionModelOptions MotionBelief::model(const MotionModelOptions& options) const {
  MotionModelOptions learnt = options;
  learnt.distance = distance_.model(options.distance);
  learnt.drift = drift_.model(options.drift);
  learnt.turn = turn_.model(options.turn);
  return learnt;
}

bool MotionBelief::isPlausible(const MotionModelOptions& options) const {
  constexpr double kMost = 1000;  // more than the settings allow
  const auto is = [](const MotionTerm& term) {
    return std::abs(term.meanD) <= kMost && std::abs(term.meanT) <= kMost && 0 <= term.varianceD &&
           term.varianceD <= kMost && 0 <= term.varianceT && term.varianceT <= kMost &&
           term.covariance * term.covariance <= 1.000001 * term.varianceD * term.varianceT;
  };
  const auto isSum = [](const Term& term) {
    return term.dd >= 0 && term.tt >= 0 && term.dt * term.dt <= 1.000001 * term.dd * term.tt;
  };
  const MotionModelOptions learnt = model(options);
  return isSum(distance_) && isSum(drift_) && isSum(turn_) && is(learnt.distance) && is(learnt.drift) &&
         is(learnt.turn);
}

void MotionBelief::learn(const mrpt::math::TPose2D& odometry, const mrpt::math::TPose2D& motion,
                         const MotionModelOptions& options) {
  const MotionStep seen(odometry);
  if (odometry.norm() > kLongestStep) return;                                    // no longer one arc
  const double turn = seen.turn + mrpt::math::wrapToPi(motion.phi - seen.turn);  // the shorter direction
  const MotionStep made(mrpt::math::TPose2D(motion.x, motion.y, turn));
  distance_.learn(seen, made.distance, options.distance, options.minStdXY);
  drift_.learn(seen, made.drift - seen.drift, options.drift, options.minStdXY);
  turn_.learn(seen, made.turn, options.turn, options.minStdPhi);
}

}  // namespace hybrid_slam
