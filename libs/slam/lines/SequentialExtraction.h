/// @file SequentialExtraction.h
/// @brief Extracts one line after another, for the methods that find the strongest line among all points:
/// RANSAC, the Hough transform, EM.
#pragma once

#include <optional>

#include "base/RandomStream.h"
#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {

/// Finds the line that most points are near to; empty if there is none.
/// @param near  m: a point at most this far from a line belongs to it
using LineFinder = std::optional<FittedLine> (*)(PointRange points, double near, RandomStream& random);

/// Finds a line in each run of the scan, removes its points, and repeats this for the rest.
///
/// `near` is half of splitDistance. A line is split where more than two beams in a row miss it, so that a
/// wall that continues behind a pillar gives two lines. The random stream depends only on the points of the
/// run, so the same scan gives the same lines.
std::vector<LineSegment> extractSequentially(const LaserScan& scan, const LineExtractionOptions& options,
                                             LineFinder find);

/// The line through two points drawn at random; empty if they coincide.
std::optional<FittedLine> randomLine(PointRange points, RandomStream& random);
/// Number of points within `near` (m) of a line.
size_t countNear(PointRange points, const FittedLine& line, double near);

}  // namespace hybrid_slam
