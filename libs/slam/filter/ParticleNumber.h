/// @file ParticleNumber.h
/// @brief Number of particles that a posterior needs: D. Fox, "Adapting the sample size in particle filters
/// through KLD-sampling", IJRR 22(12), 2003.
#pragma once

#include <mrpt/core/bits_math.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "slam/filter/FilterView.h"

namespace hybrid_slam {

/// Particles in one bin count as one hypothesis.
constexpr double kBinSize = 0.2;  // m
constexpr double kBinAngle = mrpt::DEG2RAD(3.0);
/// Largest Kullback-Leibler divergence from the true posterior, with the probability of this quantile of the
/// normal distribution (95 %).
constexpr double kDivergence = 0.25, kQuantile = 1.64;

/// Eq. (7) of Fox, not of the paper: the number of particles that approximate a distribution over `bins`
/// bins.
/// @param bins  at least 1; need not be whole
double kldParticles(double bins);

/// The bins that the particles occupy: the exponential of the entropy of the weights per bin, which counts a
/// bin of little weight for less than one. Between 1 and the number of particles.
double occupiedBins(const std::vector<WeightedPose>& particles);

}  // namespace hybrid_slam
