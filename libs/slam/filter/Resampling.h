/// @file Resampling.h
/// @brief Residual resampling (Liu & Chen 1998), which MRPT 2.5.8 gets wrong (doc/mrpt-notes.md).
#pragma once

#include <cstddef>
#include <vector>

#include "base/RandomStream.h"

namespace hybrid_slam {

/// The indices, in rising order, of as many particles as there are weights: floor(n w) copies of each, and
/// the rest drawn by what is left of the weights.
/// @param logWeights  not necessarily normalised; at least one
std::vector<size_t> residualResampling(const std::vector<double>& logWeights, RandomStream& random);

}  // namespace hybrid_slam
