/// @file StepsTable.h
/// @brief Writes `steps.csv`, one row per filter update, and `particles.csv`, one row per particle of an
/// update.
#pragma once

#include <ostream>

#include "slam/filter/FilterView.h"

namespace hybrid_slam::run {

void writeStepsHeader(std::ostream& out);
/// @param timestamp  s; @param milliseconds  duration of the update
void writeStep(std::ostream& out, double timestamp, const FilterStep& step, double milliseconds);

void writeParticlesHeader(std::ostream& out);
void writeParticles(std::ostream& out, double timestamp, const FilterStep& step);

}  // namespace hybrid_slam::run
