/// @file ResourceUse.h
/// @brief Memory that this program uses, and may use.
#pragma once

namespace hybrid_slam::run {

/// CPU time of this program so far, in all threads (s).
double cpuSeconds();

/// Peak resident memory of this program (MB); getrusage would include the parent's.
double peakMegabytes();

/// Memory (bytes) of the machine, or of the process's address space (`ulimit -v`) if that is less.
double memoryLimit();

}  // namespace hybrid_slam::run
