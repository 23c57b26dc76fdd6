/// @file OrthoAssociation.h
/// @brief Associates lines that are parallel to an axis of the building.
#pragma once

#include <optional>
#include <vector>

#include "slam/lines/LineSegment.h"
#include "slam/ortho/OrthoOptions.h"
#include "slam/ortho/OrthoState.h"

namespace hybrid_slam {

/// A line of the map without its offset, which is in the OrthoState.
struct OrthoLine {
  /// Direction in which the robot looks at it, in quarter turns from the x axis: 0 and 2 are lines x = c, 1
  /// and 3 lines y = c. The two faces of a wall have opposite sides.
  int side = 0;
  double low = 0, high = 0;     ///< m, the extent along the other axis
  int count = 1, inserted = 0;  ///< as in DatabaseLine

  bool isAcrossX() const { return side % 2 == 0; }
};

/// A line of a scan that is parallel to an axis by the predicted heading.
struct SeenOrthoLine {
  mrpt::math::TPoint2D middle;  ///< robot frame, m
  double deviation = 0;         ///< rad, of its direction from the axis
  double length = 0;            ///< m
  int side = 0;                 ///< as in OrthoLine
};

/// Returns the lines of a scan that deviate from an axis by at most `maxAngle` (rad).
/// @param seen     robot frame
/// @param heading  of the robot in the building's frame, rad
std::vector<SeenOrthoLine> orthogonalLines(const std::vector<LineSegment>& seen, double heading,
                                           double maxAngle);

/// A seen line in the frame of the building, by the pose of the state.
struct PlacedLine {
  PlacedLine(const SeenOrthoLine& seen, const mrpt::math::TPose2D& pose);
  double offset;           ///< m
  Eigen::Vector3d byPose;  ///< derivative of the offset with respect to the pose
  double low, high;        ///< m, extent
};

/// The difference of a placed line from a line of the map, as a measurement.
OrthoState::Measurement measurementOf(const PlacedLine& placed, size_t line, const OrthoState& state,
                                      double variance);

/// Returns whether two extents are at most `maxGap` (m) apart.
bool areNear(double low, double high, const OrthoLine& line, double maxGap);

/// Returns the line of the map that a seen line belongs to: of the same side, at most maxGap away along the
/// wall, and nearest by Mahalanobis distance, within the gate. Empty if there is none.
std::optional<size_t> associate(const SeenOrthoLine& seen, const PlacedLine& placed,
                                const std::vector<OrthoLine>& lines, const OrthoState& state,
                                const OrthoOptions& options);

}  // namespace hybrid_slam
