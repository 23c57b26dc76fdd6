#include "study/simulation/WheelOdometry.h"

#include <cmath>
#include <sstream>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "base/RandomStream.h"

namespace hybrid_slam::simulation {

void OdometryOptions::describe(OptionTable& t) {
  t.add("rate", rate, 0.1, 100, "Hz", "odometry readings per second");
  t.add("mean_d_d", meanDd, 0.5, 2, "m/m", "forward reading per metre driven: wheel size");
  t.add("mean_d_t", meanDt, -1, 1, "m/rad", "forward reading per radian turned");
  t.add("mean_c_d", meanCd, -1, 1, "m/m", "sideways reading (left) per metre driven");
  t.add("mean_c_t", meanCt, -1, 1, "m/rad", "sideways reading (left) per radian turned");
  t.addAngle("mean_t_d_deg", meanTd, -45, 45, "rotation read per metre driven: unequal wheels (deg/m)");
  t.add("mean_t_t", meanTt, 0.5, 2, "rad/rad", "rotation read per radian turned: wheel base");
  t.add("sigma_d_d", sigmaDd, 0, 1, "m/sqrt(m)", "forward noise from driving");
  t.add("sigma_d_t", sigmaDt, 0, 1, "m/sqrt(rad)", "forward noise from turning");
  t.add("sigma_c_d", sigmaCd, 0, 1, "m/sqrt(m)", "sideways noise from driving");
  t.add("sigma_c_t", sigmaCt, 0, 1, "m/sqrt(rad)", "sideways noise from turning");
  t.addAngle("sigma_t_d_deg", sigmaTd, 0, 45, "rotation noise from driving (deg/sqrt(m))");
  t.addAngle("sigma_t_t_deg", sigmaTt, 0, 45, "rotation noise from turning (deg/sqrt(rad))");
  t.add("slips", slips,
        "`T DEG M, ...`: at T s from the start the odometry gains DEG of rotation and M m of distance");
}

std::vector<Slip> parseSlips(const std::string& text) {
  std::vector<Slip> slips;
  std::istringstream events(text);
  for (std::string event; std::getline(events, event, ',');) {
    std::istringstream words(event);
    std::string t, deg, m, rest;
    words >> t >> deg >> m >> rest;
    const auto time = parseFinite(t), rotation = parseFinite(deg), distance = parseFinite(m);
    if (!time || *time < 0 || !rotation || !distance || !rest.empty())
      throw InputError("wrong slip `" + event + "`", "section [odometry], key `slips`",
                       "expected `T DEG M, T DEG M, ...` (s, deg, m) with T >= 0");
    slips.push_back({*time, mrpt::DEG2RAD(*rotation), *distance});
  }
  return slips;
}

void WheelOdometry::move(double d, double t, RandomStream& random) {
  const OdometryOptions& o = options_;
  const auto draw = [&](double meanD, double meanT, double sigmaD, double sigmaT) {
    const double sigma = std::sqrt(std::abs(d) * sigmaD * sigmaD + std::abs(t) * sigmaT * sigmaT);
    return d * meanD + t * meanT + sigma * random.gaussian();
  };
  const double forwards = draw(o.meanDd, o.meanDt, o.sigmaDd, o.sigmaDt);
  const double sideways = draw(o.meanCd, o.meanCt, o.sigmaCd, o.sigmaCt);
  const double rotation = draw(o.meanTd, o.meanTt, o.sigmaTd, o.sigmaTt);
  advance(forwards, sideways, rotation);
}

/// Moves the pose along an arc, so that error-free odometry is exact in curves.
void WheelOdometry::advance(double forwards, double sideways, double rotation) {
  const double half = rotation / 2;
  const double chord = std::abs(half) < 1e-9 ? 1 : std::sin(half) / half;
  const double c = std::cos(pose_.phi + half) * chord, s = std::sin(pose_.phi + half) * chord;
  pose_.x += forwards * c - sideways * s;
  pose_.y += forwards * s + sideways * c;
  pose_.phi = std::remainder(pose_.phi + rotation, 2 * M_PI);
}

mrpt::math::TPose2D WheelOdometry::reading() const {
  constexpr double kAngleStep = 2 * M_PI / 4096;
  return {std::round(pose_.x * 1000) / 1000, std::round(pose_.y * 1000) / 1000,
          std::round(pose_.phi / kAngleStep) * kAngleStep};
}

}  // namespace hybrid_slam::simulation
