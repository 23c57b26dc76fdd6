#include "slam/filter/PreparedScan.h"

#include "slam/grid/BeamSelection.h"

namespace hybrid_slam {

ScanPreparation::ScanPreparation(const FilterConfiguration& configuration)
    : configuration_(configuration),
      lineExtractor_(configuration.segmentation, configuration.lineFit, configuration.hough) {}

PreparedScan ScanPreparation::operator()(const mrpt::obs::CObservation2DRangeScan& observation) const {
  const LaserScan scan = toLaserScan(observation, configuration_.grid.maxRange);
  const BeamSelection selection(scan);
  return {scan, ScanBeams(scan), ScanBeams(scan, selection.take(configuration_.gridWeight.beams)),
          ScanBeams(scan, selection.take(configuration_.matcher.beams)),
          configuration_.useLines ? lineExtractor_.extract(scan) : std::vector<LineSegment>()};
}

}  // namespace hybrid_slam
