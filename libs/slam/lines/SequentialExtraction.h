/// @file SequentialExtraction.h
/// @brief One line after another, for the methods that look for the strongest line among all points: RANSAC,
/// the Hough transform, EM.
#pragma once

#include <optional>

#include "base/RandomStream.h"
#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {

/// The line that most points are near to; empty if there is none.
/// @param near  m: a point at most this far from a line belongs to it
using LineFinder = std::optional<FittedLine> (*)(PointRange points, double near, RandomStream& random);

/// Looks for a line in each run of the scan, removes its points, and looks again in the rest.
///
/// `near` is half of splitDistance. A line is divided where more than two beams in a row miss it: a wall that
/// continues behind a pillar gives two. The random stream depends only on the points of the run, so the same
/// scan gives the same lines.
std::vector<LineSegment> extractSequentially(const LaserScan& scan, const LineExtractionOptions& options,
                                             LineFinder find);

/// The line through two points drawn at random; empty if they coincide.
std::optional<FittedLine> randomLine(PointRange points, RandomStream& random);
/// Number of points within `near` (m) of a line.
size_t countNear(PointRange points, const FittedLine& line, double near);

}  // namespace hybrid_slam
