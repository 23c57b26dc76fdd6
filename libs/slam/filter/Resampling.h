/// @file Resampling.h
/// @brief Resampling where MRPT's is wrong: residual resampling, and a change of the number of particles
/// (doc/mrpt-notes.md).
#pragma once

#include <cstddef>
#include <vector>

#include "base/RandomStream.h"

namespace hybrid_slam {

/// Ascending indices of n particles: floor(n w) copies of each, the rest drawn by the residual weights.
/// @param logWeights  at least one; need not be normalised
std::vector<size_t> residualResampling(const std::vector<double>& logWeights, RandomStream& random);

/// Ascending indices of `count` particles by systematic resampling (Kitagawa 1996): one draw, `count` evenly
/// spaced points on the cumulative weights.
/// @param logWeights  at least one; need not be normalised
std::vector<size_t> systematicResampling(const std::vector<double>& logWeights, size_t count,
                                         RandomStream& random);

}  // namespace hybrid_slam
