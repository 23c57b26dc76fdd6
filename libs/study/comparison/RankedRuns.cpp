#include "study/comparison/RankedRuns.h"

#include <algorithm>

#include "study/evaluation/AbsoluteTrajectoryError.h"

namespace hybrid_slam::comparison {

RunFolder folderOf(const ReportInput& input, const RunResult& run) {
  return {input.runs, runName(input.groups[run.run.group], run.run.seed)};
}

std::vector<const RunResult*> finishedRuns(const ReportInput& input, size_t group) {
  std::vector<const RunResult*> runs;
  for (const RunResult& r : input.results)
    if (r.run.group == group && r.status == RunResult::Status::done) runs.push_back(&r);
  return runs;
}

std::optional<Figure> rankingFigure(const ReportInput& input) {
  for (const Figure figure : {Figure::ate, Figure::transMean})
    for (const RunResult& r : input.results)
      if (r[figure]) return figure;
  return std::nullopt;
}

std::vector<const RunResult*> rankedRuns(const ReportInput& input, size_t group) {
  auto runs = finishedRuns(input, group);
  if (const auto ranking = rankingFigure(input))
    std::stable_sort(runs.begin(), runs.end(), [&](const RunResult* a, const RunResult* b) {
      return (*a)[*ranking].value_or(0) < (*b)[*ranking].value_or(0);
    });
  return runs;
}

const RunResult* medianRun(const ReportInput& input, size_t group) {
  const auto runs = rankedRuns(input, group);
  return runs.empty() ? nullptr : runs[(runs.size() - 1) / 2];
}

mrpt::math::TPose2D alignmentOf(const ReportInput& input, const files::Trajectory& trajectory) {
  if (input.truth.reference.empty()) return {};
  return evaluation::absoluteTrajectoryError(trajectory, input.truth.reference,
                                             GroundTruth::kReferenceTolerance)
      .alignment;
}

}  // namespace hybrid_slam::comparison
