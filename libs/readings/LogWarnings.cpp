#include "readings/LogWarnings.h"

#include "base/Numbers.h"
#include "readings/BagPlan.h"

namespace hybrid_slam::readings {

std::vector<std::string> warningsOf(const RawlogSummary& log, const std::string& file) {
  std::vector<std::string> all;
  const auto add = [&](const Oddity& odd, const std::string& what, const std::string& done) {
    if (odd.count > 0)
      all.push_back(std::to_string(odd.count) + " " + what + ": first at " + log.unit + " " +
                    std::to_string(odd.first) + " of " + file + "; " + done);
  };
  add(log.brokenLines, "broken " + log.unit + "s", "skipped");
  add(log.passedOver, "observations of classes that are not read (" + log.passedOverClasses + ")", "skipped");
  add(log.early, "scans before the last " + std::to_string(kMostEarly) + " that precede the first odometry",
      "skipped");
  add(log.empty, "scans without beams (or aperture or sensor pose)", "skipped");
  add(log.misplaced, "scans with a sensor pose over 100 m from the robot", "skipped");
  add(log.tilted, "scans of a tilted plane", "skipped");
  add(log.unstamped, "scans without timestamp", "previous scan's timestamp used");
  add(log.repeatedStamps, "timestamps equal that of the previous scan", "kept");
  add(log.stepsBack, "timestamps step back", "log order kept");
  add(log.wrongOdometry, "odometry readings that are not numbers, or beyond 1e8 m or 1e6 rad", "skipped");
  add(log.noOdometry, "actions without odometry", "taken as no motion");
  add(log.jumps, "odometry jumps of over 100 m or far above the robot's speed", "taken as no motion");
  add(log.wrongSweeps, "scan times (first beam to last) below 0 or over " + numberText(kLongestSweep) + " s",
      "these scans are not corrected for the robot's motion");
  for (const auto& [label, seconds] : log.sweeps)
    if (!log.isDeskewed)
      all.push_back("laser `" + label + "` takes " + fixedText(1000 * seconds, 1) + " ms for a scan: " +
                    file + "; without odometry the beams are not corrected for the robot's motion");
  if (log.bag) all.insert(all.end(), log.bag->notes.begin(), log.bag->notes.end());
  all.insert(all.end(), log.ignored.begin(), log.ignored.end());
  return all;
}

}  // namespace hybrid_slam::readings
