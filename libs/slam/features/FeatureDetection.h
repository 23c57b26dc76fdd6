/// @file FeatureDetection.h
/// @brief Corners and arcs of a scan, with covariance.
#pragma once

#include <vector>

#include "slam/features/FeatureOptions.h"
#include "slam/features/PointFeature.h"
#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {

/// Returns the features of a scan, in the robot frame and in beam order. A run of neighbouring beams is an
/// arc if a circle describes it better than straight pieces do (less variance, by their degrees of freedom)
/// and its radius is certain to a quarter. Otherwise it has a corner where two adjacent straight pieces of at
/// least minWall meet at 30 to 150 deg, and a wall end where one of them ends and the laser sees farther, as
/// at an opening, or at a door frame whose other wall shows too few points. The end lies between two beams;
/// its variance along the wall is that of a uniform distribution between them.
///
/// The covariance is propagated from the variance of the points about their lines or circle; it does not
/// include errors common to all beams of a scan (`withModelError`).
/// @param lines  settings of line extraction: the gaps that end a run of points, and the largest RMS distance
///               of points from a line, here also from a circle
std::vector<PointFeature> detectFeatures(const LaserScan& scan, const LineExtractionOptions& lines,
                                         const FeatureOptions& options);

/// Adds the error `sigma` of the map and the pose, and 0.5 deg of heading, to the covariance.
/// @param feature  robot frame
PointFeature withModelError(const PointFeature& feature, double sigma);

}  // namespace hybrid_slam
