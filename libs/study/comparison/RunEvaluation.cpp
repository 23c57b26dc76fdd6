#include "study/comparison/RunEvaluation.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "base/Errors.h"
#include "files/GridMapReader.h"
#include "run/JsonFile.h"
#include "study/comparison/ReturnError.h"
#include "study/comparison/SpreadTable.h"
#include "study/comparison/WallErrors.h"
#include "study/evaluation/AbsoluteTrajectoryError.h"

namespace hybrid_slam::comparison {
namespace {

constexpr double kRadToDeg = mrpt::RAD2DEG(1.0);

evaluation::RelationErrors relationErrors(const files::Trajectory& trajectory, const GroundTruth& truth) {
  return evaluation::evaluateRelations(trajectory, truth.relations,
                                       truth.odometry.empty() ? nullptr : &truth.odometry,
                                       GroundTruth::kRelationTolerance);
}

void takeMetrics(RunResult& result, const std::string& file) {
  const auto metrics = run::readJson(file);
  const auto take = [&](Figure figure, const char* key) {
    if (!metrics.is_object() || !metrics.contains(key) || !metrics[key].is_number())
      throw std::runtime_error("broken file: " + file + "; no number `" + key + "`");
    result[figure] = metrics[key].get<double>();
  };
  take(Figure::wallTime, "wall_s");
  take(Figure::cpuTime, "cpu_s");
  take(Figure::peakMemory, "peak_rss_mb");
  take(Figure::realtimeFactor, "realtime_factor");
  take(Figure::lines, "lines");
}

void takeReferenceErrors(RunResult& result, const files::Trajectory& trajectory, const RunFolder& folder,
                         const GroundTruth& truth) {
  const evaluation::AteErrors ate =
      evaluation::absoluteTrajectoryError(trajectory, truth.reference, GroundTruth::kReferenceTolerance);
  const ReturnError back = returnError(trajectory, truth.reference, GroundTruth::kReferenceTolerance);
  result[Figure::ate] = ate.translation.rmse;
  result[Figure::returnTrans] = back.translation;
  result[Figure::returnRot] = back.rotation * kRadToDeg;
  if (!truth.plan) return;
  const WallErrors walls =
      wallErrors(files::readGridMap(folder.file("map.gridmap.gz").string()), *truth.plan, ate.alignment);
  result[Figure::wallMean] = walls.mean;
  result[Figure::wallP95] = walls.p95;
  if (truth.sightings) result[Figure::doubledShare] = truth.sightings->doubledShare(trajectory);
}

}  // namespace

void GroundTruth::expectOverlap(const files::Trajectory& trajectory) const {
  if (!reference.empty()) evaluation::absoluteTrajectoryError(trajectory, reference, kReferenceTolerance);
  if (!relations.empty()) relationErrors(trajectory, *this);
}

void GroundTruth::takeScans(std::vector<readings::EndPoints> log) {
  scans = std::move(log);
  if (!plan) return;
  sightings.emplace(*plan, reference, scans, kReferenceTolerance);
  if (sightings->empty())
    throw InputError("no scan sees a wall of the floor plan", "scans at the poses of the reference",
                     "expected the floor plan in the reference's frame");
}

std::vector<std::pair<Figure, double>> GroundTruth::bounds() const {
  std::vector<std::pair<Figure, double>> all;
  if (!reference.empty()) {
    all.emplace_back(Figure::returnTrans, criterion.returnTrans);
    all.emplace_back(Figure::returnRot, criterion.returnRot);
    if (plan) all.emplace_back(Figure::doubledShare, criterion.doubledShare);
  }
  if (!relations.empty()) all.emplace_back(Figure::transMean, criterion.relations);
  if (revisits) all.emplace_back(Figure::revisitMedian, criterion.revisits);
  return all;
}

namespace {

void takeFigures(RunResult& result, const RunFolder& folder, const GroundTruth& truth) {
  takeMetrics(result, folder.file("metrics.json").string());
  const Spread spread = meanSpread(loadSpread(folder.file("steps.csv").string()));
  result[Figure::stdAlong] = spread[0];
  result[Figure::stdAcross] = spread[1];
  result[Figure::stdPhi] = spread[2];

  const files::Trajectory trajectory = files::loadTum(folder.file("trajectory.tum").string());
  if (!truth.relations.empty()) {
    const evaluation::RelationErrors errors = relationErrors(trajectory, truth);
    result[Figure::transMean] = errors.translation.mean;
    result[Figure::rotMean] = errors.rotation.mean * kRadToDeg;
  }
  if (!truth.reference.empty()) takeReferenceErrors(result, trajectory, folder, truth);
  if (truth.revisits) {
    const evaluation::RevisitErrors errors =
        evaluation::revisitErrors(trajectory, truth.scans, *truth.revisits);
    result[Figure::revisits] = static_cast<double>(errors.revisits);
    if (errors.revisits > 0) result[Figure::revisitMedian] = errors.error.median;
  }
  const auto bounds = truth.bounds();
  if (!bounds.empty())
    result[Figure::success] = std::all_of(bounds.begin(), bounds.end(), [&](const auto& bound) {
      return result[bound.first] && *result[bound.first] < bound.second;
    });
}

}  // namespace

RunResult evaluateRun(const Run& run, const RunFolder& folder, const GroundTruth& truth) {
  RunResult result;
  result.run = run;
  result.error = folder.error();
  if (!folder.isFinished()) {
    std::error_code none;
    if (result.error.empty() && std::filesystem::exists(std::filesystem::symlink_status(folder.path(), none)))
      result.error = "missing or unreadable file: " + folder.file("metrics.json").string();
    if (!result.error.empty()) result.status = RunResult::Status::failed;
    return result;
  }
  try {
    const std::string damaged = folder.damage();
    if (!damaged.empty()) throw std::runtime_error("damaged file: " + folder.file(damaged).string());
    takeFigures(result, folder, truth);
    result.status = RunResult::Status::done;
  } catch (const std::exception& e) {
    result = RunResult();
    result.run = run;
    result.status = RunResult::Status::failed;
    result.error = messageOf(e);
  }
  return result;
}

}  // namespace hybrid_slam::comparison
