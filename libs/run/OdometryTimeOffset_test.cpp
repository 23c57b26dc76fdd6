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
  TurningRobot() {
    RandomStream random(1, 0, 0);
    double heading = 0;
    for (double t = 0; t < kDuration + 40; t += 2) {
      headings_.push_back(heading);
      heading += 60 * kDegree * (2 * random.uniform() - 1);
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

using Change = std::function<void(CObservation2DRangeScan&)>;

/// Returns the estimate where odometry of the time t is stamped t + late(t).
std::optional<double> offset(
    const std::function<double(double)>& late, const Change& change = [](auto&) {}, double turned = 1,
    double period = kPeriod) {
  const TurningRobot robot;
  OdometryTimeOffset found;
  TPose2D last;
  for (double t = 0; t < kDuration; t += period) {
    readings::Reading reading;
    const auto scan = test::scan(t, robot.at(t));
    change(*scan);
    TPose2D odometry = robot.at(t - late(t));
    odometry.phi *= turned;
    reading.scans = {scan};
    reading.timestamp = t;
    reading.motion = odometry - last;
    last = odometry;
    found.add(reading);
  }
  return found.seconds();
}

std::optional<double> offset(double late) {
  return offset([late](double) { return late; });
}

TEST(OdometryTimeOffset, IsWhereTheTurnsOfScansAndOdometryAgree) {
  for (const double late : {-9.0, -2.3, -1.0, -0.4, 0.4, 1.0, 2.3, 9.0})
    EXPECT_NEAR(offset(late).value_or(0), -late, 0.06) << late;
  EXPECT_FALSE(offset(0)) << "none is as good";
  const auto late = [](double) { return 2; };
  const auto asItIs = [](CObservation2DRangeScan&) {};
  EXPECT_NEAR(offset(late, asItIs, 1, 1).value_or(0), -2, 0.1) << "up to 60 deg between scans";
  EXPECT_NEAR(offset(late, asItIs, 1, 0.02).value_or(0), -2, 0.06) << "50 Hz";
}

TEST(OdometryTimeOffset, IsThatOfALaserUpsideDown) {
  const auto upsideDown = [](CObservation2DRangeScan& scan) {
    scan.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0, M_PI);
    for (size_t i = 0, k = scan.getScanSize() - 1; i < k; ++i, --k) {
      const float range = scan.getScanRange(i);
      scan.setScanRange(i, scan.getScanRange(k));
      scan.setScanRange(k, range);
    }
  };
  EXPECT_NEAR(offset([](double) { return 1; }, upsideDown).value_or(0), -1, 0.06);
}

TEST(OdometryTimeOffset, NeedsOdometryThatTurnsLikeTheScans) {
  const auto late = [](double) { return 1; };
  const auto asItIs = [](CObservation2DRangeScan&) {};
  EXPECT_FALSE(offset(late, asItIs, -1)) << "mirrored";
  EXPECT_FALSE(offset(late, asItIs, 0)) << "no turns";
  EXPECT_FALSE(offset([](double t) { return t < kDuration / 2 ? 1 : -1; })) << "not the same in both halves";
  EXPECT_FALSE(offset(late, [](auto& scan) {
    for (size_t i = 0; i < scan.getScanSize(); ++i) scan.setScanRangeValidity(i, false);
  })) << "no returns";
  EXPECT_FALSE(offset(late, [](auto& scan) { scan.resizeScan(1); })) << "a single beam";
  EXPECT_FALSE(offset(late, [](auto& scan) { scan.aperture = 1e-25F; })) << "all beams in one direction";
}

TEST(OdometryTimeOffset, NeedsTurns) {
  OdometryTimeOffset none, standing;
  EXPECT_FALSE(none.seconds());
  for (int i = 0; i < 1000; ++i) {
    readings::Reading reading;
    reading.timestamp = kPeriod * i;
    reading.scans = {test::scan(reading.timestamp)};
    standing.add(reading);
  }
  EXPECT_FALSE(standing.seconds());
}

}  // namespace
}  // namespace hybrid_slam::run
