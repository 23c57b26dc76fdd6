#include "slam/motion/Determination.h"

#include <cmath>

namespace hybrid_slam {
namespace {

/// Cosine of the angle between two regressors over the steps; 1: proportional.
template <class F, class G>
double cosine(const std::vector<MotionSample>& samples, const F& f, const G& g) {
  double fg = 0, ff = 0, gg = 0;
  for (const MotionSample& sample : samples) {
    const MotionStep odometry(sample.odometry);
    const double a = f(odometry), b = g(odometry);
    fg += sample.weight * a * b, ff += sample.weight * a * a, gg += sample.weight * b * b;
  }
  return fg / std::sqrt(ff * gg);
}

}  // namespace

Determination determine(const std::vector<MotionSample>& samples) {
  constexpr double kLeastDistance = 0.02, kLeastTurn = 0.05;  // m, rad
  constexpr double kLeastSteps = 20;
  // Above this, the standard errors are 7 times those of a single regressor.
  constexpr double kMostCosine = 0.99;

  double moved = 0, turned = 0;
  for (const MotionSample& sample : samples) {
    const MotionStep odometry(sample.odometry);
    if (std::abs(odometry.distance) >= kLeastDistance) moved += sample.weight;
    if (std::abs(odometry.turn) >= kLeastTurn) turned += sample.weight;
  }
  Determination result;
  const auto lacks = [&result](const std::string& keys, double steps, const std::string& least) {
    result.lacks.push_back({keys, "the robot " + least + " in " + std::to_string(std::lround(steps)) +
                                      " updates; at least " + std::to_string(std::lround(kLeastSteps)) +
                                      " needed"});
  };
  if (std::round(moved) < kLeastSteps) {
    result.meanD = result.varianceD = false;
    lacks("mean_d, var_d", moved, "moved 2 cm or more");
  }
  if (std::round(turned) < kLeastSteps) {
    result.meanT = result.varianceT = false;
    lacks("mean_t, var_t", turned, "turned 2.9 deg or more");
  }
  if (!result.meanD || !result.meanT) return result;

  const auto d = [](const MotionStep& step) { return step.distance; };
  const auto t = [](const MotionStep& step) { return step.turn; };
  const auto dd = [](const MotionStep& step) { return step.distance * step.distance; };
  const auto tt = [](const MotionStep& step) { return step.turn * step.turn; };
  if (std::abs(cosine(samples, d, t)) > kMostCosine) {
    result.meanD = result.meanT = false;
    result.lacks.push_back({"mean_d, mean_t", "the robot's turns were proportional to its translations"});
  }
  if (cosine(samples, dd, tt) > kMostCosine) {
    result.varianceD = result.varianceT = false;
    result.lacks.push_back({"var_d, var_t", "the robot's turns were proportional to its translations"});
  }
  return result;
}

}  // namespace hybrid_slam
