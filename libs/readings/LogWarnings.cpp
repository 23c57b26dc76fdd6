#include "readings/LogWarnings.h"

#include "base/Numbers.h"
#include "readings/BagPlan.h"

namespace hybrid_slam::readings {

std::vector<std::string> warningsOf(const RawlogSummary& log, const std::string& file) {
  std::vector<std::string> all;
  const auto add = [&](const Oddity& odd, const std::string& what, const std::string& done) {
    if (odd.count > 0)
      all.push_back(counted(odd.count, what) + ": first at " + log.unit + " " + std::to_string(odd.first) +
                    " of " + file + "; " + done);
  };
  add(log.brokenLines, "broken " + log.unit + "(s)", "skipped");
  add(log.passedOver, "observation(s) of classes that are not read (" + log.passedOverClasses + ")",
      "skipped");
  add(log.early, "scan(s) before the first odometry, other than the last " + std::to_string(kMostEarly),
      "skipped");
  add(log.empty, "scan(s) without beams (or aperture or sensor pose)", "skipped");
  add(log.misplaced, "scan(s) with a sensor pose over 100 m from the robot", "skipped");
  add(log.tilted, "scan(s) of a tilted plane", "skipped");
  constexpr size_t kLeast = 10;  // of this many ranges, at least one is a return
  if (log.returns < log.beams / kLeast)
    all.push_back("only " + std::to_string(log.returns) + " of " + std::to_string(log.beams) +
                  " ranges are above 0 and below the laser's maximum: " + file +
                  "; expected ranges in metres");
  add(log.unstamped, "scan(s) without timestamp", "previous scan's timestamp used");
  add(log.repeatedStamps, "timestamp(s) equal to that of the previous scan", "kept");
  add(log.stepsBack, "step(s) back of the timestamps", "log order kept");
  add(log.timeJumps, "timestamp(s) over a day after that of the previous scan", "kept");
  add(log.wrongOdometry, "impossible odometry reading(s): not a number, or beyond 1e8 m or 1e6 rad",
      "skipped");
  add(log.otherOdometry, "odometry reading(s) of other sensors than `" + log.odometryLabel + "`",
      "not used; --odometry-topic chooses a sensor");
  add(log.noOdometry, "action(s) without odometry", "taken as no motion");
  add(log.jumps, "odometry jump(s) of over 100 m or far above the robot's speed", "taken as no motion");
  add(log.wrongSweeps,
      "scan time(s) (first beam to last) below 0 or over " + numberText(kLongestSweep) + " s",
      "scans after it are not corrected for the robot's motion");
  for (const auto& [label, seconds] : log.sweeps)
    if (!log.isDeskewed)
      all.push_back("laser `" + label + "` takes " + fixedText(1000 * seconds, 1) + " ms for a scan: " +
                    file + "; without odometry the beams are not corrected for the robot's motion");
  if (log.hasMotion || log.hasTurns)
    for (const std::string& label : log.spinning)
      all.push_back("time of a scan is unknown: laser `" + label + "` in " + file +
                    "; input.scan_rate=HZ (turns per second) corrects the scans for the robot's motion");
  if (log.bag) all.insert(all.end(), log.bag->notes.begin(), log.bag->notes.end());
  all.insert(all.end(), log.ignored.begin(), log.ignored.end());
  return all;
}

}  // namespace hybrid_slam::readings
