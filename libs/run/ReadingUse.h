/// @file ReadingUse.h
/// @brief What a run did with a reading of its log.
#pragma once

namespace hybrid_slam::run {

/// A reading was skipped (a live robot was faster than the filter), carried over to the next update, or
/// caused one.
enum class ReadingUse { skipped, carried, update };

}  // namespace hybrid_slam::run
