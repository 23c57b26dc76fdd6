/// @file ParticlePlot.h
/// @brief Where the particles are at chosen moments, as in the paper's Fig. 3.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "study/comparison/Gnuplot.h"
#include "study/simulation/FloorPlan.h"

namespace hybrid_slam::comparison {

struct WeightedParticle {
  mrpt::math::TPose2D pose;
  double logWeight = 0;
};

/// All particles of one update.
struct ParticleSnapshot {
  double timestamp = 0;  ///< s
  std::vector<WeightedParticle> particles;

  const mrpt::math::TPose2D& best() const;  ///< the pose of the highest weight
  double radius() const;                    ///< m, from there to the farthest particle
};

/// Reads `particles.csv`; nothing if there is no such file.
/// @throws std::runtime_error for a broken file
std::vector<ParticleSnapshot> loadParticles(const std::string& file);

/// One moment of each of `count` equal parts of a run: that at which the robot had turned most since the
/// snapshot before, be it at a corner or in a doorway. Their timestamps.
std::vector<double> turningMoments(const std::vector<ParticleSnapshot>& run, size_t count);

/// The snapshot that is nearest in time; `run` holds at least one.
const ParticleSnapshot& nearestSnapshot(const std::vector<ParticleSnapshot>& run, double timestamp);

/// Particles red with their headings, the robot (the best particle) light blue, walls black. Of more than 200
/// particles every second, third, ... is drawn.
/// @param alignment  the particles' frame in the plan's
/// @param plan       may be null
/// @param side       m, of the square that is shown, around the robot
Plot plotParticles(const ParticleSnapshot& snapshot, const mrpt::math::TPose2D& alignment,
                   const simulation::FloorPlan* plan, double side, const std::string& title);

}  // namespace hybrid_slam::comparison
