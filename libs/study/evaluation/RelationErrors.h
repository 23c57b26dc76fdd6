/// @file RelationErrors.h
/// @brief The relations metric of Kuemmerle et al., "On measuring the accuracy of SLAM algorithms" (2009).
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <string>
#include <vector>

#include "files/Trajectory.h"
#include "study/evaluation/ErrorStatistics.h"
#include "study/evaluation/OdometryBridge.h"

namespace hybrid_slam::evaluation {

/// A reference relation: the robot's pose at t2 relative to its pose at t1.
struct Relation {
  double t1 = 0, t2 = 0;         ///< s
  mrpt::math::TPose2D motion{};  ///< pose at t2 in the robot frame at t1; m, rad
};

/// Reads `t1 t2 x y z roll pitch yaw` (s, m, rad); z, roll and pitch are not used.
/// @throws InputError for an unreadable or empty file, a broken line, a coordinate beyond 10,000 km or
///         an angle beyond 1e7 rad.
std::vector<Relation> loadRelations(const std::string& file);

/// The errors over all relations.
struct RelationErrors {
  size_t relations = 0;         ///< given
  size_t used = 0;              ///< relations with a pose at both times
  ErrorStatistics translation;  ///< m
  ErrorStatistics rotation;     ///< rad
};

/// A relation with the poses of a trajectory at its times.
struct PlacedRelation {
  mrpt::math::TPose2D motion{};  ///< of the relation
  TrajectoryPoint first, second;
};

/// Finds the poses at the times of relations; relations without both are left out.
///
/// Without odometry, a pose is the trajectory pose nearest in time within the tolerance; of several with the
/// same timestamp, the last in (x, y, phi) order. With odometry, OdometryBridge gives the pose.
/// @param odometry   may be null
/// @param tolerance  s
/// @throws InputError if no relation can be used.
std::vector<PlacedRelation> placeRelations(const files::Trajectory& trajectory,
                                           const std::vector<Relation>& relations,
                                           const files::Trajectory* odometry, double tolerance);

/// Computes the errors inverse(motion) + (inverse(p1) + p2) over the relations with poses p1, p2 at t1, t2.
/// Parameters and errors as placeRelations.
RelationErrors evaluateRelations(const files::Trajectory& trajectory, const std::vector<Relation>& relations,
                                 const files::Trajectory* odometry, double tolerance);

}  // namespace hybrid_slam::evaluation
