/// @file FeatureDetection.h
/// @brief Corners and arcs of a scan, with covariance.
#pragma once

#include <vector>

#include "slam/features/FeatureOptions.h"
#include "slam/features/PointFeature.h"
#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {

/// The features of a scan, in the robot frame and in beam order. A run of neighbouring beams is an arc if a
/// circle describes it better than straight pieces do (less variance, by their degrees of freedom) and its
/// radius is certain to a quarter. Else it has a corner where two adjacent straight pieces of at least
/// minWall meet at 30 to 150 deg.
///
/// The covariance is propagated from the variance of the points about their lines or circle; it does not
/// include what all beams of a scan have in common (`withModelError`).
/// @param lines  settings of line extraction: the gaps that end a run of points, and the largest RMS distance
///               of points from a line, which here also limits that from a circle
std::vector<PointFeature> detectFeatures(const LaserScan& scan, const LineExtractionOptions& lines,
                                         const FeatureOptions& options);

/// Adds to the covariance the error `sigma` of the surroundings and of the pose, and 0.5 deg of heading.
/// @param feature  robot frame
PointFeature withModelError(const PointFeature& feature, double sigma);

}  // namespace hybrid_slam
