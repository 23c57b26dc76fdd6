/// @file LoopNote.h
/// @brief The line on stderr for a closed loop.
#pragma once

#include <string>
#include <vector>

#include "slam/loops/LoopClosure.h"

namespace hybrid_slam::run {

/// Says in one line where a loop was closed, by how much the path moved, and on what evidence.
/// @param times         of the updates, s
/// @param isRefinement  closed in the refinement after the run, not while filtering
std::string loopNote(const LoopClosure& loop, const std::vector<double>& times, bool isRefinement);

}  // namespace hybrid_slam::run
