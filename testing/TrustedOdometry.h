/// @file TrustedOdometry.h
/// @brief For the tests: a filter that trusts an odometry whose heading drifts, so that no particle closes
/// the loop.
#pragma once

#include "slam/filter/FilterOptions.h"
#include "testing/TestScans.h"

namespace hybrid_slam::test {

/// Four particles with the standard proposal; without lines.
inline FilterConfiguration trustingConfiguration() {
  FilterConfiguration c;
  c.useLines = false;
  c.filter.proposal = ParticleFilterOptions::Proposal::standard;
  c.filter.particles = 4;
  c.filter.updateDistance = 0.2, c.filter.updateAngle = 10 * kDegree;
  for (MotionTerm* term : {&c.motion.distance, &c.motion.drift, &c.motion.turn})
    term->varianceD = term->varianceT = 1e-8, term->meanStd = 0;
  c.motion.minStdXY = c.motion.minStdPhi = 1e-4;
  return c;
}

}  // namespace hybrid_slam::test
