#include "slam/filter/PreparedScan.h"

#include "slam/grid/BeamSelection.h"

namespace hybrid_slam {

ScanPreparation::ScanPreparation(const FilterConfiguration& c)
    : maxRange_(c.grid.maxRange),
      weighedBeams_(c.gridWeight.beams),
      matchedBeams_(c.matcher.beams),
      useLines_(c.useLines),
      lineExtraction_(c.lineExtraction) {}

PreparedScan ScanPreparation::operator()(const Scans& observed) const {
  const LaserScans scans = toLaserScans(observed, maxRange_);
  const BeamSelection selection(scans);
  PreparedScan prepared{scans,
                        ScanBeams(scans),
                        ScanBeams(scans, selection.take(weighedBeams_)),
                        ScanBeams(scans, selection.take(matchedBeams_)),
                        {}};
  if (useLines_)
    for (const LaserScan& scan : scans)
      for (const LineSegment& line : extractLines(scan, lineExtraction_)) prepared.lines.push_back(line);
  return prepared;
}

}  // namespace hybrid_slam
