// A laser that takes time for a scan, on a robot that turns at 1.5 rad/s, from the simulator to the
// trajectory.
#include <cmath>

#include "HybridSlamProgram.h"
#include "files/Trajectory.h"

namespace hybrid_slam {
namespace {

using testing::HasSubstr;
using testing::Not;

class Deskew : public HybridSlam {
 protected:
  /// Simulates full turns in a room; `log` is the rawlog, `truth` the ground truth.
  void simulate(const std::string& settings) {
    folder.write("room.plan", "rectangle 0 0 8 6\nwall 3 0 3 2\nwall 6 6 6 4\n");
    folder.write(
        "room.route",
        "start 1.5 1.5 0\nspeed 0.5\nturn_speed 85.944\nturn 120\nturn 240\nturn 0\nturn 90\ngo 1.5 4\n"
        "turn 300\nturn 60\nturn 180\nturn 0\ngo 5 3\nturn 120\nturn 240\nturn 0\nturn 120\nturn 240\n");
    const std::string config =
        folder.write("room.ini", "[simulation]\nplan = room.plan\nroute = room.route\n[laser]\nrate = 5\n");
    const test::Outcome outcome =
        test::shell(folder, "'" SIMUL_FLOORPLAN "' '" + config + "' -q -o '" + log + "' " + settings);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  /// RMS error (deg) of the headings since the start.
  double headingError() const {
    const files::Trajectory path = files::loadTum(output + "/trajectory.tum"),
                            truth = files::loadTum(truthFile);
    EXPECT_EQ(path.size(), truth.size());
    double sum = 0;
    for (size_t i = 0; i < std::min(path.size(), truth.size()); ++i) {
      const double error = std::remainder(
          (path[i].pose.phi - path[0].pose.phi) - (truth[i].pose.phi - truth[0].pose.phi), 2 * M_PI);
      sum += error * error;
    }
    return std::sqrt(sum / static_cast<double>(path.size())) * 180 / M_PI;
  }

  std::string log = folder.path("turns.rawlog"), truthFile = folder.path("turns.tum");
  const std::string swept = "--set laser.scan_time=0.15 ";
};

TEST_F(Deskew, HalvesTheErrorOfTheHeadingAtLeast) {
  for (const char* const form : {"observations", "pairs"}) {
    SCOPED_TRACE(form);
    simulate(swept + "--set simulation.form=" + form);
    expectDone(replay(log, "--set input.scan_time=0"));
    EXPECT_THAT(out, Not(HasSubstr("corrected for motion")));
    const double without = headingError();
    expectDone(replay(log));
    EXPECT_THAT(out, HasSubstr("corrected for motion during its scans of 150.0 ms"));
    EXPECT_LT(headingError(), 0.5 * without) << without << " deg";
  }
}

TEST_F(Deskew, TheSettingDoesForALogWithoutAWord) {
  simulate(swept);
  expectDone(replay(log));
  const std::string told = result("trajectory.tum"), map = result("map.simplemap.gz");
  expectDone(replay(log, "--set input.scan_time=0.15"));
  EXPECT_EQ(result("trajectory.tum"), told);
  EXPECT_EQ(result("map.simplemap.gz"), map);
}

/// The simulated laser sees 270 of 360 deg.
TEST_F(Deskew, ARateGivesTheTimeOfTheAperture) {
  simulate(swept);
  expectDone(replay(log, "--set input.scan_rate=5"));
  EXPECT_THAT(out, HasSubstr("corrected for motion during its scans of 150.0 ms"));
  expectDone(replay(log, "--set input.scan_rate=10"));
  EXPECT_THAT(out, HasSubstr("corrected for motion during its scans of 75.0 ms"));
}

/// The last scan of the first run had no odometry up to its last beam.
TEST_F(Deskew, ASessionGoesOnInALogThatHasGrown) {
  simulate(swept + "--set simulation.scans=60");
  ASSERT_EQ(replay(log), 0) << err;
  simulate(swept);
  EXPECT_EQ(run("'" + log + "' --resume '" + output + "/session.hslam' -o '" + folder.path("grown") + "'"), 0)
      << err;
  EXPECT_EQ(files::loadTum(folder.path("grown") + "/trajectory.tum").size(),
            files::loadTum(truthFile).size());
}

TEST_F(Deskew, WithoutOdometryALineSaysThatNothingIsCorrected) {
  simulate(swept);
  expectDone(replay(log, "--set input.require_odometry=false"),
             "without odometry the beams are not corrected");
}

TEST_F(Deskew, WrongScanTimesAreErrors) {
  const std::string room = test::writeGzipped(folder.path("room.rawlog"), test::laps(5));
  for (const std::string value : {"-0.1", "1.5", "nan", "1e9", "fast"})
    expectError(replay(room, "--set input.scan_time=" + value), "expected auto or a number in 0..1 s");
  for (const std::string value : {"0", "0.5", "1001", "nan", "fast"})
    expectError(replay(room, "--set input.scan_rate=" + value), "expected auto or a number in 1..1000 Hz");
  expectError(replay(room, "--set input.scan_rate=5 --set input.scan_time=0.15"),
              "both scan_time and scan_rate are set");
}

}  // namespace
}  // namespace hybrid_slam
