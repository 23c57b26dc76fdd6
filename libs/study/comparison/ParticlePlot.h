/// @file ParticlePlot.h
/// @brief Particle clouds at selected times, as in the paper's Fig. 3.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "study/comparison/Gnuplot.h"
#include "study/simulation/BuildingPlan.h"

namespace hybrid_slam::comparison {

/// A row of particles.csv.
struct WeightedParticle {
  mrpt::math::TPose2D pose;
  double logWeight = 0;
};

/// All particles of one update.
struct ParticleSnapshot {
  double timestamp = 0;  ///< s
  std::vector<WeightedParticle> particles;

  const mrpt::math::TPose2D& best() const;  ///< the pose with the highest weight
  double radius() const;                    ///< m, from best() to the farthest particle
};

/// Reads `particles.csv`; empty if there is no such file.
/// @throws std::runtime_error for a broken file
std::vector<ParticleSnapshot> loadParticles(const std::string& file);

/// Timestamps of one snapshot in each of `count` equal parts of a run: the one with the largest turn since
/// the previous snapshot, such as at a corner or doorway.
std::vector<double> turningMoments(const std::vector<ParticleSnapshot>& run, size_t count);

/// The snapshot nearest in time; `run` must not be empty.
const ParticleSnapshot& nearestSnapshot(const std::vector<ParticleSnapshot>& run, double timestamp);

/// Particles red with their headings, the robot (the best particle) light blue, walls black. Of more than 200
/// particles every second, third, ... is drawn.
/// @param alignment  the particles' frame in the plan's
/// @param plan       may be null
/// @param side       m, of the square that is shown, around the robot
Plot plotParticles(const ParticleSnapshot& snapshot, const mrpt::math::TPose2D& alignment,
                   const simulation::BuildingPlan* plan, double side, const std::string& title);

}  // namespace hybrid_slam::comparison
