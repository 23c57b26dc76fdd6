/// @file OrthoMap.h
/// @brief Pose and lines of the orthogonal line SLAM, and their update by the lines of a scan.
#pragma once

#include <optional>
#include <vector>

#include "slam/lines/LineDatabase.h"
#include "slam/ortho/OrthoAssociation.h"

namespace hybrid_slam {

/// After Nguyen, Harati, Martinelli, Siegwart & Tomatis, "Orthogonal SLAM: a step toward lightweight indoor
/// autonomous navigation" (IROS 2006), the paper's [8]: only lines parallel to one of two perpendicular
/// directions are kept. The heading follows from these directions, and a line has one parameter, its offset.
class OrthoMap {
 public:
  /// @param pruning  min_count and prune_interval of [line_database] apply
  OrthoMap(const OrthoOptions& options, const LineDatabaseOptions& pruning);

  void move(const mrpt::math::TPose2D& odometry, const MotionModelOptions& model) {
    state_.move(odometry, model);
  }
  /// Corrects the pose by the lines of a scan, and the lines by the pose. @param seen  robot frame
  void update(const std::vector<LineSegment>& seen);

  mrpt::math::TPose2D pose() const;        ///< map frame, in which the robot starts at the origin (m, rad)
  Eigen::Matrix3d poseCovariance() const;  ///< map frame (m, rad)
  /// Direction of the building's axes in the map frame, rad in [-pi/4, pi/4]; empty until lines have shown
  /// it.
  const std::optional<double>& direction() const { return direction_; }
  std::vector<DatabaseLine> lines() const;  ///< map frame
  int matched() const { return matched_; }  ///< lines of the last scan that belong to walls of the map

 private:
  /// Returns the lines that may be parallel to an axis, given the heading and its uncertainty.
  std::vector<SeenOrthoLine> parallels(const std::vector<LineSegment>& seen) const;
  void findDirection(const std::vector<LineSegment>& seen);
  void correctHeading(const std::vector<LineSegment>& seen);
  void correctOrInsert(const SeenOrthoLine& seen);
  void joinPieces(size_t line);
  void prune();
  void remove(size_t line);

  OrthoOptions options_;
  LineDatabaseOptions pruning_;
  OrthoState state_;
  std::vector<OrthoLine> lines_;
  std::optional<double> direction_;
  int updates_ = 0, matched_ = 0;
};

}  // namespace hybrid_slam
