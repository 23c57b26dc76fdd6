/// @file ResourceUse.h
/// @brief What this program has used so far, and may use.
#pragma once

namespace hybrid_slam::run {

double cpuSeconds();

/// Peak resident memory of this program; getrusage would include the parent's.
double peakMegabytes();

/// bytes: of the machine, or of the process's address space (`ulimit -v`) if that is less.
double memoryLimit();

}  // namespace hybrid_slam::run
