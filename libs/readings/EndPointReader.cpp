#include "readings/EndPointReader.h"

#include <cmath>

#include "base/Errors.h"
#include "base/LaserScan.h"
#include "files/InputFile.h"
#include "readings/LogWarnings.h"

namespace hybrid_slam::readings {

std::vector<EndPoints> loadEndPoints(const std::string& rawlog, const InputOptions& options, double maxRange,
                                     const WarningReport& report, size_t mostKept) {
  const RawlogSummary summary = summarise(rawlog, options);
  if (!summary.defect.empty())
    throw InputError("log " + summary.defect, summary.defectPlace(rawlog), "expected a whole log");
  if (report) report(warningsOf(summary, rawlog));
  RawlogSource source(rawlog, options, summary);
  std::vector<EndPoints> scans;
  size_t kept = 0;
  while (const auto reading = source.next()) {
    EndPoints ends{reading->timestamp, {}};
    for (const LaserScan& scan : toLaserScans(reading->scans, maxRange))
      for (const Beam& beam : scan.beams) {
        if (!beam.valid) continue;
        ends.points.push_back(scan.sensorPose.composePoint(
            {beam.range * std::cos(beam.angle), beam.range * std::sin(beam.angle)}));
      }
    kept += 1 + ends.points.size();
    if (kept > mostKept)
      throw InputError("too many scans", rawlog + ", scan " + std::to_string(scans.size() + 1),
                       "expected at most " + std::to_string(mostKept) + " scans and valid beams together");
    scans.push_back(std::move(ends));
  }
  if (files::stateOf(rawlog) != summary.state)
    throw InputError("log has changed while it was read", rawlog, "expected a finished log");
  return scans;
}

}  // namespace hybrid_slam::readings
