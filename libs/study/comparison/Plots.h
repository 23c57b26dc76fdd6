/// @file Plots.h
/// @brief The report's plots of figures and spreads. A plot with nothing to show has no script.
#pragma once

#include <string>
#include <vector>

#include "study/comparison/Gnuplot.h"
#include "study/comparison/SpreadTable.h"
#include "study/comparison/Summary.h"

namespace hybrid_slam::comparison {

/// Okabe & Ito's colour-blind-safe colours, one for each method and variant.
/// @returns one for each group, 0xRRGGBB
std::vector<int> plotColours(const std::vector<Group>& groups);

/// Every run of every group as a dot, and each group's quartiles as a box.
Plot plotFigure(const FigureName& name, const std::vector<Group>& groups,
                const std::vector<RunResult>& results);

/// Share of successful runs and its 95 % interval for each group.
Plot plotSuccess(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries);

/// Median and quartiles of a figure against the number of particles, a line for each method and variant.
Plot plotAgainstParticles(const FigureName& name, const std::vector<Group>& groups,
                          const std::vector<GroupSummary>& summaries);

/// Median over the seeds (line) and quartiles (band) of one spread against time, a line for each group.
/// @param bands  one for each group; groups without runs have no times
Plot plotSpread(size_t spread, const std::vector<Group>& groups, const std::vector<SpreadBands>& bands);

}  // namespace hybrid_slam::comparison
