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

double drawTerm(const MotionTerm& term, double d, double t, double minStd, RandomStream& random) {
  const double variance = term.varianceD * d * d + term.varianceT * t * t + minStd * minStd;
  return term.meanD * d + term.meanT * t + std::sqrt(variance) * random.gaussian();
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
  // The odometry's own step, seen along its mean heading: what it moved sideways stays in the drift.
  const double c = std::cos(odometry.phi / 2), s = std::sin(odometry.phi / 2);
  const double d = c * odometry.x + s * odometry.y, sideways = -s * odometry.x + c * odometry.y;
  const double t = odometry.phi;

  const double distance = drawTerm(o.distance, d, t, o.minStdXY, random);
  const double drift = sideways + drawTerm(o.drift, d, t, o.minStdXY, random);
  const double turn = drawTerm(o.turn, d, t, o.minStdPhi, random);
  const double cs = std::cos(turn / 2), sn = std::sin(turn / 2);
  return {cs * distance - sn * drift, sn * distance + cs * drift, turn};
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
