/// @file PreparedScan.h
/// @brief The scans of one reading, prepared once for all particles.
#pragma once

#include <vector>

#include "base/LaserScan.h"
#include "slam/features/PointFeature.h"
#include "slam/filter/FilterOptions.h"
#include "slam/grid/OccupancyGrid.h"
#include "slam/grid/ScanBeams.h"
#include "slam/lines/LineSegment.h"

namespace hybrid_slam {

/// A reading, prepared for all particles.
struct PreparedScan {
  LaserScans scans;
  ScanBeams beams;                 ///< every beam, for insertion
  ScanBeams weighedBeams;          ///< `beams` of [grid_weight] or [line_map]
  ScanBeams matchedBeams;          ///< `beams` of [scan_matcher]
  std::vector<LineSegment> lines;  ///< robot frame; empty if lines are off
  /// Features in the robot frame, whose covariance includes the pose error (`withModelError`); empty if
  /// features are off.
  std::vector<PointFeature> features = {};
};

/// Line detection (Sec. III-B) and all other work common to the particles.
class ScanPreparation {
 public:
  explicit ScanPreparation(const FilterConfiguration& configuration);
  PreparedScan operator()(const Scans& observed) const;
  /// Returns the scan with other beams to weigh and to match, none of them at a thing that has moved.
  /// @param robot  where it was taken, map frame
  PreparedScan withoutMovedThings(PreparedScan scan, const mrpt::math::TPose2D& robot,
                                  const OccupancyGrid& grid) const;
  /// Extracts only the lines, robot frame; empty if lines are off.
  std::vector<LineSegment> lines(const LaserScans& scans) const;
  /// Extracts only the features, as in PreparedScan.
  std::vector<PointFeature> features(const LaserScans& scans) const;

 private:
  double maxRange_;
  int weighedBeams_, matchedBeams_;
  bool useLines_;
  LineExtractionOptions lineExtraction_;
  FeatureOptions features_;
};

}  // namespace hybrid_slam
