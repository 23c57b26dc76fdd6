#include "run/OdometryTimeOffset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "base/Degree.h"
#include "base/RandomStream.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPose2D;
using test::CObservation2DRangeScan;

constexpr double kPeriod = 0.2, kDuration = 120;  // s

/// A robot near the middle of the room that turns at another random speed every 2 s.
class TurningRobot {
 public:
  /// @param speed  1: up to 30 deg/s
  explicit TurningRobot(double speed) {
    RandomStream random(1, 0, 0);
    double heading = 0;
    for (double t = 0; t < kDuration + 40; t += 2) {
      headings_.push_back(heading);
      heading += speed * 60 * kDegree * (2 * random.uniform() - 1);
    }
  }
  /// @param time  s, from -20 to kDuration + 15
  TPose2D at(double time) const {
    const double t = (time + 20) / 2;
    const auto i = static_cast<size_t>(t);
    const double share = t - static_cast<double>(i);
    return {0.5 * std::sin(time), 0, headings_[i] + share * (headings_[i + 1] - headings_[i])};
  }

 private:
  std::vector<double> headings_;
};

/// A drive whose odometry of the time t is stamped t + late(t).
struct Drive {
  std::function<double(double)> late = [](double) { return 0; };
  std::function<void(CObservation2DRangeScan&)> change = [](CObservation2DRangeScan&) {};
  double turned = 1;        ///< by the odometry, as a share of the robot's turns
  double speed = 1;         ///< see TurningRobot
  double period = kPeriod;  ///< s
  double duration = kDuration;
  bool hasOlderScan = false;  ///< of another laser, 0.08 s before each scan

  explicit Drive(double by) : late([by](double) { return by; }) {}

  std::optional<double> offset() const {
    const TurningRobot robot(speed);
    OdometryTimeOffset found;
    TPose2D last;
    for (double t = 0; t < duration; t += period) {
      readings::Reading reading;
      if (hasOlderScan) reading.scans.push_back(test::scan(t - 0.08, robot.at(t - 0.08), 181, "OLDER"));
      reading.scans.push_back(test::scan(t, robot.at(t)));
      change(*reading.scans.back());
      TPose2D odometry = robot.at(t - late(t));
      odometry.phi *= turned;
      reading.timestamp = t;
      reading.motion = odometry - last;
      last = odometry;
      found.add(reading);
    }
    return found.seconds();
  }
};

TEST(OdometryTimeOffset, IsWhereTheTurnsOfScansAndOdometryAgree) {
  for (const double late : {-9.0, -2.3, -1.0, -0.4, 0.4, 1.0, 2.3, 9.0})
    EXPECT_NEAR(Drive(late).offset().value_or(0), -late, 0.06) << late;
  EXPECT_FALSE(Drive(0).offset()) << "none is as good";
}

TEST(OdometryTimeOffset, IsTheSameForOtherSensors) {
  Drive sparse(2), dense(2), ofTwo(2), upsideDown(2);
  sparse.period = 1;
  EXPECT_NEAR(sparse.offset().value_or(0), -2, 0.1) << "up to 30 deg between scans";
  dense.period = 0.02;
  EXPECT_NEAR(dense.offset().value_or(0), -2, 0.06) << "50 Hz";
  ofTwo.hasOlderScan = true;
  EXPECT_NEAR(ofTwo.offset().value_or(0), -2, 0.06) << "the time of a reading is that of its last scan";
  upsideDown.change = [](CObservation2DRangeScan& scan) {
    scan.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0, M_PI);
    for (size_t i = 0, k = scan.getScanSize() - 1; i < k; ++i, --k) {
      const float range = scan.getScanRange(i);
      scan.setScanRange(i, scan.getScanRange(k));
      scan.setScanRange(k, range);
    }
  };
  EXPECT_NEAR(upsideDown.offset().value_or(0), -2, 0.06);
}

TEST(OdometryTimeOffset, NeedsOdometryThatTurnsLikeTheScans) {
  Drive mirrored(1), straight(1), changing(1);
  mirrored.turned = -1;
  EXPECT_FALSE(mirrored.offset());
  straight.turned = 0;
  EXPECT_FALSE(straight.offset());
  changing.late = [](double t) { return t < kDuration / 2 ? 1 : -1; };
  EXPECT_FALSE(changing.offset()) << "not the same in both halves";
}

TEST(OdometryTimeOffset, NeedsTurns) {
  EXPECT_FALSE(OdometryTimeOffset().seconds());
  Drive brief(1), slow(1);
  brief.duration = 15;
  EXPECT_FALSE(brief.offset()) << "75 scans";
  slow.speed = 0.05;
  EXPECT_FALSE(slow.offset()) << "90 deg in all";
}

TEST(OdometryTimeOffset, NeedsScans) {
  Drive blind(1), ofOneBeam(1), narrow(1);
  blind.change = [](CObservation2DRangeScan& scan) {
    for (size_t i = 0; i < scan.getScanSize(); ++i) scan.setScanRangeValidity(i, false);
  };
  EXPECT_FALSE(blind.offset());
  ofOneBeam.change = [](CObservation2DRangeScan& scan) { scan.resizeScan(1); };
  EXPECT_FALSE(ofOneBeam.offset());
  narrow.change = [](CObservation2DRangeScan& scan) { scan.aperture = 1e-25F; };
  EXPECT_FALSE(narrow.offset()) << "all beams in one direction";
}

}  // namespace
}  // namespace hybrid_slam::run
