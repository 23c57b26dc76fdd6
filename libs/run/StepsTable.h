/// @file StepsTable.h
/// @brief Writes `steps.csv`, one row per filter update, and `particles.csv`, one row per particle of an
/// update.
#pragma once

#include <ostream>

#include "slam/filter/FilterView.h"

namespace hybrid_slam::run {

/// Writes the names of the columns of steps.csv.
void writeStepsHeader(std::ostream& out);
/// @param timestamp  s; @param milliseconds  duration of the update
void writeStep(std::ostream& out, double timestamp, const FilterStep& step, double milliseconds);

/// Writes the names of the columns of particles.csv.
void writeParticlesHeader(std::ostream& out);
/// Writes a row for each particle of an update. @param timestamp  s
void writeParticles(std::ostream& out, double timestamp, const FilterStep& step);

}  // namespace hybrid_slam::run
