/// @file ReportPlots.h
/// @brief The report's plots that read files in the folders of the finished runs.
#pragma once

#include <vector>

#include "study/comparison/Gnuplot.h"
#include "study/comparison/Report.h"

namespace hybrid_slam::comparison {

/// The particles' spread over time.
std::vector<Plot> spreadPlots(const ReportInput& input);

/// All trajectories of each group.
std::vector<Plot> trajectoryPlots(const ReportInput& input);

/// The paper's Fig. 6: the map of each group's median run over the walls.
std::vector<Plot> wallPlots(const ReportInput& input);

/// The particles of each group's median run at the same moments, all at the same scale; a row for each group.
std::vector<std::vector<Plot>> particlePlots(const ReportInput& input);

}  // namespace hybrid_slam::comparison
