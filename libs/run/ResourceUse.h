/// @file ResourceUse.h
/// @brief What this program has used so far.
#pragma once

namespace hybrid_slam::run {

double cpuSeconds();

/// Peak resident memory of this program; getrusage would include the parent's.
double peakMegabytes();

}  // namespace hybrid_slam::run
