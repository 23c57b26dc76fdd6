/// @file Resampling.h
/// @brief Residual resampling (Liu & Chen 1998), which MRPT gets wrong (doc/mrpt-notes.md).
#pragma once

#include <cstddef>
#include <vector>

#include "base/RandomStream.h"

namespace hybrid_slam {

/// Ascending indices of n particles: floor(n w) copies of each, the rest drawn by the residual weights.
/// @param logWeights  at least one; need not be normalised
std::vector<size_t> residualResampling(const std::vector<double>& logWeights, RandomStream& random);

}  // namespace hybrid_slam
