#include "study/comparison/Figures.h"

#include <ostream>

#include "base/Numbers.h"

namespace hybrid_slam::comparison {

const std::array<FigureName, kFigures> kFigureNames{{
    {Figure::transMean, "trans_mean_m", "relations: mean translation error", "m", true},
    {Figure::rotMean, "rot_mean_deg", "relations: mean rotation error", "deg", true},
    {Figure::ate, "ate_rmse_m", "absolute trajectory error, rmse", "m", true},
    {Figure::returnTrans, "return_trans_m", "position error at the return", "m", true},
    {Figure::returnRot, "return_rot_deg", "heading error at the return", "deg", true},
    {Figure::wallMean, "wall_mean_m", "distance of occupied cells to the walls: mean", "m", true},
    {Figure::wallP95, "wall_p95_m", "distance of occupied cells to the walls: 95th percentile", "m", true},
    {Figure::doubledShare, "doubled_share", "share of doubled wall", "", true},
    {Figure::success, "success", "success", "", false},
    {Figure::wallTime, "wall_s", "wall time", "s", false},
    {Figure::cpuTime, "cpu_s", "CPU time", "s", false},
    {Figure::peakMemory, "peak_rss_mb", "peak memory", "MB", false},
    {Figure::realtimeFactor, "realtime_factor", "real-time factor", "", false},
    {Figure::lines, "lines", "lines in the best particle's database", "", false},
    {Figure::stdAlong, "std_along_m", "particle spread along the heading", "m", true},
    {Figure::stdAcross, "std_across_m", "particle spread across the heading", "m", true},
    {Figure::stdPhi, "std_phi_deg", "particle spread of the heading", "deg", true},
    {Figure::revisitMedian, "revisit_median_m", "revisit error, median", "m", true},
    {Figure::revisits, "revisits", "revisiting scans", "", false},
}};

const char* statusName(RunResult::Status status) {
  return status == RunResult::Status::done     ? "done"
         : status == RunResult::Status::failed ? "failed"
                                               : "missing";
}

std::string cell(const std::optional<double>& value) {
  return value ? numberText(*value, std::chars_format::general, 6) : std::string();
}

void writeResults(const std::vector<Group>& groups, const std::vector<RunResult>& results,
                  std::ostream& out) {
  out << "method,variant,particles,seed,status";
  for (const FigureName& name : kFigureNames) out << ',' << name.column;
  out << '\n';
  for (const RunResult& result : results) {
    const Group& group = groups[result.run.group];
    out << group.method << ',' << group.variant.name << ',' << group.particles << ',' << result.run.seed
        << ',' << statusName(result.status);
    for (const auto& value : result.figures) out << ',' << cell(value);
    out << '\n';
  }
}

}  // namespace hybrid_slam::comparison
