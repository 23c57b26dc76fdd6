#include "slam/motion/MotionModel.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

/// The term's keys: NAME_mean_d, NAME_mean_t, NAME_var_d, NAME_var_t.
void describeTerm(OptionTable& t, MotionTerm& term, const std::string& name, const std::string& unit,
                  const std::string& what) {
  const std::string perMetre = unit + "/m", perRadian = unit + "/rad";
  const auto square = [](const std::string& text) { return "(" + text + ")^2"; };
  t.add(name + "_mean_d", term.meanD, -10, 10, perMetre, "mean of the " + what + " per metre of odometry");
  t.add(name + "_mean_t", term.meanT, -10, 10, perRadian, "mean of the " + what + " per radian of odometry");
  t.add(name + "_var_d", term.varianceD, 0, 100, square(perMetre),
        "variance of the " + what + " per squared metre of odometry");
  t.add(name + "_var_t", term.varianceT, 0, 100, square(perRadian),
        "variance of the " + what + " per squared radian of odometry");
  t.add(name + "_mean_std", term.meanStd, 0, 1, perMetre + ", " + perRadian,
        "prior standard deviation of the means of the " + what +
            "; each particle estimates its own; 0: known exactly");
}

}  // namespace

MotionStep::MotionStep(const TPose2D& p)
    : distance(std::cos(p.phi / 2) * p.x + std::sin(p.phi / 2) * p.y),
      drift(-std::sin(p.phi / 2) * p.x + std::cos(p.phi / 2) * p.y),
      turn(p.phi) {}

TPose2D MotionStep::increment() const {
  const double c = std::cos(turn / 2), s = std::sin(turn / 2);
  return {c * distance - s * drift, s * distance + c * drift, turn};
}

double distanceOfVariance(const MotionStep& odometry) {
  constexpr double kArc = 0.02;  // m
  const double ahead = std::abs(odometry.distance);
  const double sideways = std::max(0.0, std::abs(odometry.drift) - std::max(kArc, ahead));
  const double length = std::hypot(ahead, sideways);
  return std::copysign(length <= kLongestStep ? length : std::sqrt(length * kLongestStep), odometry.distance);
}

void MotionModelOptions::describe(OptionTable& t) {
  describeTerm(t, distance, "distance", "m", "distance along the heading");
  describeTerm(t, drift, "drift", "m", "drift to the left");
  describeTerm(t, turn, "turn", "rad", "turn");
  t.add("min_std_xy", minStdXY, 0, 1, "m", "minimum standard deviation of distance and drift per step");
  t.addAngle("min_std_phi_deg", minStdPhi, 0, 60, "minimum standard deviation of the turn per step");
}

// Sec. III-A, step 1 (sampling).
TPose2D sampleMotion(const TPose2D& odometry, const MotionModelOptions& o, RandomStream& random) {
  std::array<double, 3> normals;
  for (double& normal : normals) normal = random.gaussian();
  return sampleMotion(odometry, o, normals);
}

TPose2D sampleMotion(const TPose2D& odometry, const MotionModelOptions& o,
                     const std::array<double, 3>& normals) {
  const MotionStep seen(odometry);
  const auto draw = [&](const MotionTerm& term, double minStd, double normal) {
    return term.mean(seen) + std::sqrt(term.variance(seen, minStd)) * normal;
  };
  const double distance = draw(o.distance, o.minStdXY, normals[0]);
  const double drift = seen.drift + draw(o.drift, o.minStdXY, normals[1]);
  return MotionStep(distance, drift, draw(o.turn, o.minStdPhi, normals[2])).increment();
}

MotionDistribution motionDistribution(const TPose2D& start, const TPose2D& odometry,
                                      const MotionModelOptions& o) {
  const MotionStep seen(odometry);
  const double distance = o.distance.mean(seen), drift = seen.drift + o.drift.mean(seen);
  const double turn = o.turn.mean(seen), heading = start.phi + turn / 2;
  const double c = std::cos(heading), s = std::sin(heading);
  Eigen::Matrix3d jacobian;  // of the pose after the step with respect to (distance, drift, turn)
  jacobian << c, -s, (-s * distance - c * drift) / 2,  //
      s, c, (c * distance - s * drift) / 2,            //
      0, 0, 1;
  const Eigen::Vector3d variances(o.distance.variance(seen, o.minStdXY), o.drift.variance(seen, o.minStdXY),
                                  o.turn.variance(seen, o.minStdPhi));
  return {start + MotionStep(distance, drift, turn).increment(),
          jacobian * variances.asDiagonal() * jacobian.transpose()};
}

mrpt::obs::CActionRobotMovement2D::TMotionModelOptions toMrpt(const MotionModelOptions& o) {
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions out;
  out.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  auto& g = out.gaussianModel;
  const auto byDistance = [](const MotionTerm& t) { return t.varianceD + t.meanStd * t.meanStd; };
  const auto byTurn = [](const MotionTerm& t) { return t.varianceT + t.meanStd * t.meanStd; };
  g.a1 = std::sqrt((byDistance(o.distance) + byDistance(o.drift)) / 2);
  g.a2 = std::sqrt((byTurn(o.distance) + byTurn(o.drift)) / 2);
  g.a3 = std::sqrt(byDistance(o.turn));
  g.a4 = std::sqrt(byTurn(o.turn));
  g.minStdXY = o.minStdXY;
  g.minStdPHI = o.minStdPhi;
  return out;
}

mrpt::obs::CActionRobotMovement2D toAction(const TPose2D& odometry, const MotionModelOptions& options) {
  mrpt::obs::CActionRobotMovement2D action;
  auto model = toMrpt(options);
  action.computeFromOdometry(mrpt::poses::CPose2D(odometry), model);
  // MRPT's filters ignore an action whose covariance has a determinant over 1000, as after 70 m in one step.
  constexpr double kMostDeterminant = 900;
  const double determinant = action.poseChange->getCovariance().det();
  if (determinant <= kMostDeterminant) return action;
  const double scale = std::pow(kMostDeterminant / determinant, 1.0 / 6);
  auto& gaussian = model.gaussianModel;
  for (auto* deviation :
       {&gaussian.a1, &gaussian.a2, &gaussian.a3, &gaussian.a4, &gaussian.minStdXY, &gaussian.minStdPHI})
    *deviation *= static_cast<std::remove_reference_t<decltype(*deviation)>>(scale);
  action.computeFromOdometry(mrpt::poses::CPose2D(odometry), model);
  return action;
}

}  // namespace hybrid_slam
