/// @file SimulatedMotions.h
/// @brief For the tests: odometry of a simulated drive, and how well its log determines the parameters.
#pragma once

#include <array>
#include <vector>

#include "slam/motion/Determination.h"

namespace hybrid_slam::test {

/// A model in which every parameter differs from the default.
inline MotionModelOptions trueModel() {
  MotionModelOptions o;
  o.distance = {0.97, 0.02, 0.004, 0.0009};
  o.drift = {0.01, -0.03, 0.0016, 0.0004};
  o.turn = {0.05, 1.04, 0.01, 0.0025};
  return o;
}

/// Odometry of steps of 0 to 0.6 m and up to 40 deg to either side.
inline std::vector<mrpt::math::TPose2D> randomOdometry(size_t steps, RandomStream& random) {
  std::vector<mrpt::math::TPose2D> all;
  for (size_t i = 0; i < steps; ++i) {
    const double d = 0.6 * random.uniform(), t = 1.4 * (random.uniform() - 0.5);
    all.push_back(MotionStep(d, 0.02 * random.gaussian(), t).increment());
  }
  return all;
}

/// True motions for such steps.
inline std::vector<MotionSample> simulate(const MotionModelOptions& model,
                                          const std::vector<mrpt::math::TPose2D>& odometry,
                                          RandomStream& random) {
  std::vector<MotionSample> samples;
  for (const mrpt::math::TPose2D& step : odometry)
    samples.push_back({step, sampleMotion(step, model, random), 1});
  return samples;
}

using Parameters = std::array<double, 4>;  ///< mean_d, mean_t, var_d, var_t

inline Parameters parametersOf(const MotionTerm& term) {
  return {term.meanD, term.meanT, term.varianceD, term.varianceT};
}

/// Cramer-Rao bounds on the standard errors of a term's parameters, with additional observation variance
/// `noise`.
inline Parameters standardErrors(const MotionTerm& term, double minStd,
                                 const std::vector<mrpt::math::TPose2D>& odometry, double noise = 0) {
  Eigen::Matrix2d means = Eigen::Matrix2d::Zero(), variances = Eigen::Matrix2d::Zero();
  for (const auto& increment : odometry) {
    const MotionStep step(increment);
    const double v = term.variance(step, minStd) + noise;
    const Eigen::Vector2d x(step.distance, step.turn), y = x.cwiseProduct(x);
    means += x * x.transpose() / v;
    variances += y * y.transpose() / (2 * v * v);
  }
  const Eigen::Vector2d m = means.inverse().diagonal().cwiseSqrt(),
                        v = variances.inverse().diagonal().cwiseSqrt();
  return {m[0], m[1], v[0], v[1]};
}

}  // namespace hybrid_slam::test
