#include "motion/MotionModel.h"

#include <cmath>

namespace hybrid_slam {
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
}

/// The odometry's own step, seen along its mean heading: what it moved sideways stays in the drift.
struct OdometryStep {
  explicit OdometryStep(const mrpt::math::TPose2D& odometry)
      : d(std::cos(odometry.phi / 2) * odometry.x + std::sin(odometry.phi / 2) * odometry.y),
        sideways(-std::sin(odometry.phi / 2) * odometry.x + std::cos(odometry.phi / 2) * odometry.y),
        t(odometry.phi) {}
  double mean(const MotionTerm& term) const { return term.meanD * d + term.meanT * t; }
  double variance(const MotionTerm& term, double minStd) const {
    return term.varianceD * d * d + term.varianceT * t * t + minStd * minStd;
  }
  double d, sideways, t;  ///< m, m, rad
};

/// The step of `distance` along the heading in the middle of the turn, and `drift` across it.
mrpt::math::TPose2D step(double distance, double drift, double turn) {
  const double c = std::cos(turn / 2), s = std::sin(turn / 2);
  return {c * distance - s * drift, s * distance + c * drift, turn};
}

}  // namespace

void MotionModelOptions::describe(OptionTable& t) {
  describeTerm(t, distance, "distance", "m", "distance along the heading");
  describeTerm(t, drift, "drift", "m", "drift to the left");
  describeTerm(t, turn, "turn", "rad", "turn");
  t.add("min_std_xy", minStdXY, 0, 1, "m", "least standard deviation of distance and drift in a step");
  t.addAngle("min_std_phi_deg", minStdPhi, 0, 60, "least standard deviation of the turn in a step");
}

mrpt::math::TPose2D sampleMotion(const mrpt::math::TPose2D& odometry, const MotionModelOptions& o,
                                 RandomStream& random) {
  const OdometryStep seen(odometry);
  const auto draw = [&](const MotionTerm& term, double minStd) {
    return seen.mean(term) + std::sqrt(seen.variance(term, minStd)) * random.gaussian();
  };
  const double distance = draw(o.distance, o.minStdXY);
  const double drift = seen.sideways + draw(o.drift, o.minStdXY);
  return step(distance, drift, draw(o.turn, o.minStdPhi));
}

MotionDistribution motionDistribution(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& odometry,
                                      const MotionModelOptions& o) {
  const OdometryStep seen(odometry);
  const double distance = seen.mean(o.distance), drift = seen.sideways + seen.mean(o.drift);
  const double turn = seen.mean(o.turn), heading = start.phi + turn / 2;
  const double c = std::cos(heading), s = std::sin(heading);
  Eigen::Matrix3d jacobian;  // of the pose after the step by (distance, drift, turn)
  jacobian << c, -s, (-s * distance - c * drift) / 2,  //
      s, c, (c * distance - s * drift) / 2,            //
      0, 0, 1;
  const Eigen::Vector3d variances(seen.variance(o.distance, o.minStdXY), seen.variance(o.drift, o.minStdXY),
                                  seen.variance(o.turn, o.minStdPhi));
  return {start + step(distance, drift, turn), jacobian * variances.asDiagonal() * jacobian.transpose()};
}

mrpt::obs::CActionRobotMovement2D::TMotionModelOptions toMrpt(const MotionModelOptions& o) {
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions out;
  out.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  auto& g = out.gaussianModel;
  g.a1 = std::sqrt((o.distance.varianceD + o.drift.varianceD) / 2);
  g.a2 = std::sqrt((o.distance.varianceT + o.drift.varianceT) / 2);
  g.a3 = std::sqrt(o.turn.varianceD);
  g.a4 = std::sqrt(o.turn.varianceT);
  g.minStdXY = o.minStdXY;
  g.minStdPHI = o.minStdPhi;
  return out;
}

mrpt::obs::CActionRobotMovement2D toAction(const mrpt::math::TPose2D& odometry,
                                           const MotionModelOptions& options) {
  mrpt::obs::CActionRobotMovement2D action;
  action.computeFromOdometry(mrpt::poses::CPose2D(odometry), toMrpt(options));
  return action;
}

}  // namespace hybrid_slam
