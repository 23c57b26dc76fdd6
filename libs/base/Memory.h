/// @file Memory.h
/// @brief Limits of memory that MRPT and the filter obey.
#pragma once

#include <cstddef>

namespace mrpt::obs {
class CObservation2DRangeScan;
}

namespace hybrid_slam {

/// Call this before MRPT allocates. Where there is no memory, MRPT's allocator returns a null pointer instead
/// of throwing (2.5.8, aligned_allocator_cpp11), and its containers write to it.
/// @throws std::bad_alloc if this many bytes and 1 MiB more are not available
void expectMemory(size_t bytes);

/// Sets the number of beams of a scan.
/// @throws std::bad_alloc without memory; MRPT's function would write to a null pointer
void resizeScan(mrpt::obs::CObservation2DRangeScan& scan, size_t beams);

/// Returns the resident memory (bytes) of this process.
double residentBytes();

/// While it lives, `expectBelowLimit` throws above a limit (bytes) of the resident memory. One at a time.
class ResidentLimit {
 public:
  explicit ResidentLimit(double bytes);
  ~ResidentLimit();
  ResidentLimit(const ResidentLimit&) = delete;
  ResidentLimit& operator=(const ResidentLimit&) = delete;
};

/// @throws std::bad_alloc above the limit, or if this many more bytes would be
void expectBelowLimit(size_t more = 0);

}  // namespace hybrid_slam
