/// @file LaserMounting.h
/// @brief The pose of a laser on the robot, from the two poses in its rows.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <vector>

namespace hybrid_slam::readings {

/// CARMEN writes the poses of the laser and of the robot into every row. Their difference is the mounting. In
/// a corrected log, a mapper's pose replaces one of them: the rows soon disagree. The first rows of the log,
/// with a robot that moves, decide; nine of ten must agree, within 2 cm and 1 deg, and be below 2 m.
class LaserMounting {
 public:
  /// Adds a row at the beginning of the log, in the map frame (m, rad). Only the first 1,000 count.
  void preview(const mrpt::math::TPose2D& laser, const mrpt::math::TPose2D& robot);
  /// Returns whether no further row counts.
  bool isPreviewed() const;

  enum class Agreement {
    unknown,  ///< too few rows, or the robot stands
    agreed,
    none
  };
  /// Decides. No row may be added afterwards.
  Agreement agreement();
  /// The mounting by a row: that of all rows, if they agreed; empty if they do not. As long as it is unknown,
  /// that of the first row, until a row is off by more than 5 mm or 0.3 deg.
  std::optional<mrpt::math::TPose2D> of(const mrpt::math::TPose2D& laser, const mrpt::math::TPose2D& robot);

 private:
  void decide();

  std::vector<mrpt::math::TPose2D> mountings_;
  std::optional<mrpt::math::TPose2D> start_;  ///< of the robot
  bool hasMoved_ = false;
  std::optional<Agreement> agreement_;
  std::optional<mrpt::math::TPose2D> pose_;
};

}  // namespace hybrid_slam::readings
