/// @file RelationErrors.h
/// @brief The relations metric of Kuemmerle et al., "On measuring the accuracy of SLAM algorithms" (2009).
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <string>
#include <vector>

#include "files/Trajectory.h"
#include "study/evaluation/ErrorStatistics.h"

namespace hybrid_slam::evaluation {

/// What is known of the truth: how the robot stood at t2, seen from where it was at t1.
struct Relation {
  double t1 = 0, t2 = 0;         ///< s
  mrpt::math::TPose2D motion{};  ///< pose at t2 in the robot frame at t1; m, rad
};

/// Reads `t1 t2 x y z roll pitch yaw` (s, m, rad); z, roll and pitch are not used.
/// @throws InputError for an unreadable or empty file or a broken line.
std::vector<Relation> loadRelations(const std::string& file);

struct RelationErrors {
  size_t relations = 0;         ///< that were given
  size_t used = 0;              ///< whose two times have a pose
  ErrorStatistics translation;  ///< m
  ErrorStatistics rotation;     ///< rad
};

/// The errors inverse(motion) + (inverse(p1) + p2) over the relations whose poses p1, p2 at t1, t2 are known.
///
/// Without odometry a pose is the trajectory's nearest in time within the tolerance; of several with the same
/// stamp the one that comes last in the order of (x, y, phi). With odometry it is that of the OdometryBridge.
/// @param odometry   may be null
/// @param tolerance  s
/// @throws InputError if no relation can be used.
RelationErrors evaluateRelations(const files::Trajectory& trajectory, const std::vector<Relation>& relations,
                                 const files::Trajectory* odometry, double tolerance);

}  // namespace hybrid_slam::evaluation
