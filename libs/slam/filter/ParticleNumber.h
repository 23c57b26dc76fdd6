/// @file ParticleNumber.h
/// @brief How many particles a posterior needs: D. Fox, "Adapting the sample size in particle filters through
/// KLD-sampling", IJRR 22(12), 2003.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "slam/filter/FilterView.h"

namespace hybrid_slam {

/// The bins in which particles count as one hypothesis, and the quality of the approximation.
struct ParticleNumberOptions {
  double binSize = 0.2;              ///< m
  double binAngle = 3 * M_PI / 180;  ///< rad
  double error = 0.25;               ///< largest Kullback-Leibler divergence from the true posterior ...
  double quantile = 1.64;            ///< ... with the probability of this quantile of the normal distribution
};

/// Fox's eq. (7): the particles that approximate a distribution over `bins` bins.
/// @param bins  at least 1; need not be whole
double kldParticles(double bins, const ParticleNumberOptions& options);

/// The bins that the particles occupy: the exponential of the entropy of the weights per bin, which counts a
/// bin of little weight for less than one. Between 1 and the number of particles.
double occupiedBins(const std::vector<WeightedPose>& particles, const ParticleNumberOptions& options);

}  // namespace hybrid_slam
