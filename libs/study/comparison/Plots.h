/// @file Plots.h
/// @brief The report's plots, each an `<svg>` element.
#pragma once

#include <string>
#include <vector>

#include "files/Trajectory.h"
#include "study/comparison/SpreadTable.h"
#include "study/comparison/Summary.h"
#include "study/simulation/FloorPlan.h"

namespace hybrid_slam::comparison {

/// Every run of every group as a dot, and each group's quartiles as a box; empty if no run has the figure.
std::string plotFigure(const FigureName& name, const std::vector<Group>& groups,
                       const std::vector<RunResult>& results);

/// Share of successful runs and its 95 % interval for each group.
std::string plotSuccess(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries);

/// Median and quartiles of a figure against the number of particles, a line for each method and variant.
std::string plotAgainstParticles(const FigureName& name, const std::vector<Group>& groups,
                                 const std::vector<GroupSummary>& summaries);

/// Median over the seeds (line) and quartiles (band) of one spread against time, a line for each group.
/// @param bands  one for each group; groups without runs have no times
std::string plotSpread(size_t spread, const std::vector<Group>& groups,
                       const std::vector<SpreadBands>& bands);

/// All trajectories of a group in the reference's frame, over it and over the floor plan's walls.
/// @param plan  may be null; @param reference  may be empty
std::string plotTrajectories(size_t group, const std::vector<Group>& groups,
                             const std::vector<files::Trajectory>& trajectories,
                             const files::Trajectory& reference, const simulation::FloorPlan* plan);

}  // namespace hybrid_slam::comparison
