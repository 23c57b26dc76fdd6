/// @file RankedRuns.h
/// @brief Ranks the runs of a group, whose median and worst the report shows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/comparison/Report.h"

namespace hybrid_slam::comparison {

/// Returns the folder of a run.
RunFolder folderOf(const ReportInput& input, const RunResult& run);

/// Returns the finished runs of a group, in the order of the results.
std::vector<const RunResult*> finishedRuns(const ReportInput& input, size_t group);

/// The figure that ranks the runs; empty without a reference and relations.
std::optional<Figure> rankingFigure(const ReportInput& input);

/// A group's finished runs from the best to the worst; in the order of `finishedRuns` if no figure ranks
/// them.
std::vector<const RunResult*> rankedRuns(const ReportInput& input, size_t group);

/// Returns the median run; null if the group has no finished run.
const RunResult* medianRun(const ReportInput& input, size_t group);

/// Pose of a run's map frame in the reference's frame; zero without a reference.
mrpt::math::TPose2D alignmentOf(const ReportInput& input, const files::Trajectory& trajectory);

}  // namespace hybrid_slam::comparison
