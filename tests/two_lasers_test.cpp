// A robot with two different lasers, mapped end to end.

#include <gtest/gtest.h>
#include <mrpt/obs/CRawlog.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "base/RandomStream.h"
#include "files/TemporaryFolder.h"
#include "study/evaluation/AbsoluteTrajectoryError.h"
#include "study/simulation/BuildingPlan.h"
#include "study/simulation/Route.h"
#include "study/simulation/SimulationOutput.h"

namespace hybrid_slam {
namespace {

using namespace simulation;
using mrpt::obs::CObservation2DRangeScan;

/// The same scan by a sensor mounted upside down: its beams run the other way round.
void turnUpsideDown(CObservation2DRangeScan& scan) {
  mrpt::math::TPose3D pose = scan.sensorPose.asTPose();
  pose.roll = M_PI;
  scan.sensorPose = mrpt::poses::CPose3D(pose);
  const CObservation2DRangeScan upright = scan;
  const size_t n = scan.getScanSize();
  for (size_t i = 0; i < n; ++i) {
    scan.setScanRange(i, upright.getScanRange(n - 1 - i));
    scan.setScanRangeValidity(i, upright.getScanRangeValidity(n - 1 - i));
  }
}

/// The CSIE loop seen by an LMS-100 in front, whose beam spacing halves in mid-log, and an LMS-200 at the
/// back, upside down, which scans half a period later.
class TwoLasers : public testing::Test {
 protected:
  TwoLasers() {
    const std::string data = SOURCE_DIR "/datasets/csie/";
    const BuildingPlan plan = BuildingPlan::load(data + "csie.plan");
    const Route route = Route::load(data + "csie-loop.route");
    LaserOptions front, rear;
    front.rate = rear.rate = 2.5;
    rear.sensor = LaserType::lms200;
    rear.x = -0.2, rear.y = 0.05, rear.yaw = M_PI;
    SimulatedLog log = simulate(plan, route, {}, front, {});

    LaserOptions fine = front;
    fine.resolutionDeg = 0.25;
    const Laser fineFront(fine), back(rear);
    const std::vector<CObservation2DRangeScan::Ptr> inFront = log.scans;
    log.scans.clear();
    for (size_t i = 0; i < inFront.size(); ++i) {
      RandomStream random(7, i, 0);
      if (i >= inFront.size() / 2) {
        const auto time = inFront[i]->timestamp;
        *inFront[i] = fineFront.scan(plan, log.groundTruth[i].pose, random);
        inFront[i]->timestamp = time;
      }
      inFront[i]->sensorLabel = "FRONT";
      log.scans.push_back(inFront[i]);
      truth_.push_back({mrpt::Clock::toDouble(inFront[i]->timestamp), log.groundTruth[i].pose});
      const double seconds = (static_cast<double>(i) + 0.5) / front.rate;
      if (seconds > route.duration()) break;
      auto scan = CObservation2DRangeScan::Create(back.scan(plan, route.poseAt(seconds), random));
      scan->timestamp = inFront[i]->timestamp + std::chrono::milliseconds(200);
      scan->sensorLabel = "REAR";
      truth_.push_back({mrpt::Clock::toDouble(scan->timestamp), route.poseAt(seconds)});
      turnUpsideDown(*scan);
      log.scans.push_back(scan);
    }
    writeRawlog(toRawlog(log, RawlogForm::observations), folder_.path("two.rawlog"));
  }

  /// Root mean square error of the positions, m, with the laser of this name or, without one, with both.
  double error(const std::string& label, int seed) {
    const std::string command =
        std::string("'") + HYBRID_SLAM + "' '" SOURCE_DIR "/config-ini/csie-lms100.ini' '" +
        folder_.path("two.rawlog") + "' -q --overwrite -p improved -n 10 -s " + std::to_string(seed) +
        " -o '" + folder_.path("out") + "'" + (label.empty() ? "" : " --set input.sensor_label=" + label);
    EXPECT_EQ(std::system((command + " 2>'" + folder_.path("err") + "'").c_str()), 0) << command;
    return evaluation::absoluteTrajectoryError(files::loadTum(folder_.path("out/trajectory.tum")), truth_,
                                               0.02)
        .translation.rmse;
  }

  files::TemporaryFolder folder_;
  files::Trajectory truth_;
};

/// Recorded, mean of three seeds: both .023 m, front .020 m, rear .036 m.
TEST_F(TwoLasers, MakeOneAccurateMap) {
  std::vector<double> both;
  for (int seed = 1; seed <= 3; ++seed) both.push_back(error("", seed));
  const double mean = (both[0] + both[1] + both[2]) / 3;
  EXPECT_LT(mean, 0.03);
  EXPECT_LT(mean, error("REAR", 1));
  EXPECT_NE(both[0], error("FRONT", 1)) << "the rear laser is used";
}

}  // namespace
}  // namespace hybrid_slam
