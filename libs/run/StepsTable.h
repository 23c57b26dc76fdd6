/// @file StepsTable.h
/// @brief Writes `steps.csv`, one row per filter update, and `particles.csv`, one row per particle of an
/// update.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "slam/filter/FilterView.h"

namespace hybrid_slam::run {

/// Writes the names of the columns of steps.csv.
void writeStepsHeader(std::ostream& out);
/// @param timestamp  s; @param milliseconds  duration of the update
void writeStep(std::ostream& out, double timestamp, const FilterStep& step, double milliseconds);

/// Returns the table with loops that were closed after the last update: each is counted in the row of the
/// update at its later visit, and loop_shift of that row is the largest.
/// @param table  header, and a row for each update
std::string withLoops(const std::string& table, const std::vector<LoopClosure>& loops);

/// Writes the names of the columns of particles.csv.
void writeParticlesHeader(std::ostream& out);
/// Writes a row for each particle of an update. @param timestamp  s
void writeParticles(std::ostream& out, double timestamp, const FilterStep& step);

}  // namespace hybrid_slam::run
