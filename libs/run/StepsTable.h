/// @file StepsTable.h
/// @brief `steps.csv`: one row for each update of the filter; `particles.csv`: one for each of its particles.
#pragma once

#include <ostream>

#include "slam/filter/FilterView.h"

namespace hybrid_slam::run {

void writeStepsHeader(std::ostream& out);
/// @param timestamp  s; @param milliseconds  that the update took
void writeStep(std::ostream& out, double timestamp, const FilterStep& step, double milliseconds);

void writeParticlesHeader(std::ostream& out);
void writeParticles(std::ostream& out, double timestamp, const FilterStep& step);

}  // namespace hybrid_slam::run
