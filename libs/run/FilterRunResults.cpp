// The results of a run, at its end.
#include <mrpt/core/bits_math.h>
#include <mrpt/system/os.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/Clock.h"
#include "base/Errors.h"
#include "base/Numbers.h"
#include "base/PoseDistance.h"
#include "files/Trajectory.h"
#include "readings/Timestamps.h"
#include "run/FilterRun.h"
#include "run/JsonText.h"
#include "run/LogAgain.h"
#include "run/LoopNote.h"
#include "run/MapFiles.h"
#include "run/MapRefinement.h"
#include "run/PlanFiles.h"
#include "run/ResourceUse.h"
#include "run/SimpleMapFile.h"
#include "run/StepsTable.h"
#include "run/VerdictCheck.h"

namespace hybrid_slam::run {
namespace {

double durationOf(const files::Trajectory& trajectory) {
  readings::Duration duration;
  for (const auto& pose : trajectory) duration.add(pose.timestamp);
  return duration.seconds();
}

nlohmann::ordered_json json(const std::vector<DoubtfulPlace>& places, const std::vector<double>& times) {
  auto all = nlohmann::ordered_json::array();
  const auto rounded = [](double metres) { return std::round(100 * metres) / 100; };
  for (const DoubtfulPlace& place : places)
    all.push_back({{"x", rounded(place.at.x)},
                   {"y", rounded(place.at.y)},
                   {"timestamp", times.at(place.update)},
                   {"length_m", rounded(place.length)}});
  return all;
}

/// Returns the covariances of poses in a fixed map: spread of the particles plus that of a scan match, 1 cm
/// and 0.1 deg in cells of 5 cm, and as much more in larger ones.
/// @param cell  m
std::vector<PoseCovariance> inFixedMap(std::vector<PoseCovariance> covariances, double cell) {
  const double scale = std::max(1.0, cell / 0.05), position = 0.01 * scale,
               angle = mrpt::DEG2RAD(0.1) * scale;
  for (PoseCovariance& covariance : covariances)
    covariance.diagonal() += Eigen::Vector3d(position * position, position * position, angle * angle);
  return covariances;
}

}  // namespace

FinishedRun FilterRun::finish(const std::string& file, const readings::RawlogSummary& log,
                              const nlohmann::ordered_json& more) {
  const mrpt::system::CTimeLoggerEntry writing(profiler(), "7 write results");
  finishCheckpoint();
  staged_.follow();
  const bool hasRoom = !isMemoryFull();  // the results below are copies
  FinishedRun finished;
  FinishedMap best = finishedMap();
  if (hybrid_ && configuration_.filter.useGrid && configuration_.run.refine > 0) {
    const MapRefinement refinement(configuration_, recorder_, uses_, hybrid_->base(), refinementBytes_);
    const std::string why = hasRoom ? refinement(best, file, log) : "out of memory";
    if (!why.empty()) notes_.push_back("map not refined: " + why);
    for (const LoopClosure& loop : best.loops) notes_.push_back(loopNote(loop, updateTimes_, true));
  }
  folder_.write("trajectory.tum", [&](std::ostream& out) { files::saveTum(best.trajectory, out); });
  if (localizer_) {
    finished.verdict = verdictOfLocalization();
    writeCovarianceFile(best, inFixedMap(particleCovariances_, configuration_.filter.grid.resolution));
  } else {
    writeMap(finished, best, file, log);
  }
  const Verdict& verdict = finished.verdict;
  if (worstVerdict_ && verdict.isWorseThan(*worstVerdict_))
    throw WorseMap("its map is " + verdict.name() +
                   (verdict.level > worstVerdict_->level ? "" : ", too, and more scans contradict it"));
  writeOrNote("map.png", finished.whyMissing,
              [&] { savePicture(folder_, best.gridOrThrow(), best.trajectory, best.lines, verdict.places); });
  if (hybrid_)
    writeOrNote("session", finished.whyMissing, [&] {
      if (!best.hasMap) throw std::bad_alloc();
      saveSessionTo(folder_.path(kSessionName), best.map, best.path);
    });
  if (!std::filesystem::exists(folder_.path(kSessionName)))
    if (const std::string kept = staged_.keepOwn(); !kept.empty())
      notes_.push_back("the last checkpoint stays: " + kept);
  folder_.write("steps.csv", [&](std::ostream& out) { out << withLoops(steps_.str(), best.loops); });
  if (particles_) folder_.write("particles.csv", [&](std::ostream& out) { out << particles_->str(); });
  folder_.write("config.ini", [&](std::ostream& out) { out << configuration_.text(); });
  if (!finished.whyMissing.empty())
    finished.incomplete = "results are missing: " + finished.whyMissing;
  else if (hasChanged(file, log))
    finished.incomplete =
        "log has changed while it was read: " + file + "; results may be of both its states";
  if (worstVerdict_ && !finished.incomplete.empty())
    throw std::runtime_error(finished.whyMissing.empty() ? "the log has changed" : finished.incomplete);
  nlohmann::ordered_json all = metrics(finished, best, log);
  all.update(more);
  folder_.write("metrics.json", [&](std::ostream& out) { out << jsonText(all); });
  staged_.publish();

  const double wall = all.at("wall_s");
  finished.summary = counted(scans_, "scan(s), ") + counted(best.path.size(), "update(s), ") +
                     fixedText(recorder_.distance(), 0) + " m in " + fixedText(wall, 1) + " s (" +
                     fixedText(all.at("realtime_factor"), 0) +
                     " x real time): " + staged_.finalPath("map.png");
  return finished;
}

FinishedMap FilterRun::finishedMap() const {
  FinishedMap best;
  best.path = filter_->bestPath();
  best.path.resize(std::min(best.path.size(), updateTimes_.size()));  // without an update that failed
  best.trajectory = recorder_.trajectory(best.path);
  best.lines = filter_->bestLines();
  try {
    if (hybrid_ || (configuration_.filter.useLines && !localizer_)) best.map = currentMap();
    best.hasMap = true;
    best.grid = filter_->bestGrid();
  } catch (const std::bad_alloc&) {  // costs the files of the grid
  }
  return best;
}

/// A result that needs more memory than there is, or a log that is gone, must not cost the others.
template <class Write>
bool FilterRun::writeOrNote(const std::string& result, std::string& whyMissing, const Write& write) {
  const auto note = [&](const std::string& reason) {
    notes_.push_back("no " + result + ": " + reason);
    whyMissing = reason;
    return false;
  };
  try {
    write();
    return true;
  } catch (const UnreadableLog& e) {
    return note(e.what());
  } catch (const std::exception& e) {
    if (!isOutOfMemory(e)) throw;
    return note(messageOf(e));
  }
}

void FilterRun::writeMap(FinishedRun& finished, const FinishedMap& best, const std::string& file,
                         const readings::RawlogSummary& log) {
  std::string& whyMissing = finished.whyMissing;
  if (const double cell = best.grid ? best.grid->getResolution() : cell_; cell >= 1.5 * cell_)
    finished.mapNote = "the map files have cells of " + fixedText(cell, 2) + " m instead of " +
                       fixedText(cell_, 2) + " m: the map is too large for MRPT's grid";
  writeOrNote("map.yaml", whyMissing, [&] { saveRosMap(folder_, best.gridOrThrow(), best.trajectory); });
  writeOrNote("map.gridmap.gz", whyMissing, [&] { saveGridMap(folder_, best.gridOrThrow()); });
  saveLines(folder_, best.lines);
  if (configuration_.filter.useLines)
    writeOrNote("plan", whyMissing, [&] {
      best.gridOrThrow();
      savePlan(folder_, floorPlanOf(best.lines, best.map.grid));
    });
  VerdictCheck check(configuration_.filter.grid.maxRange, filter_->earlierMap());
  std::vector<bool> isUpdate;
  for (size_t i = 0; i < std::min(uses_.size(), log.scans); ++i)
    isUpdate.push_back(uses_[i] == ReadingUse::update);
  const auto compare = [&] {
    LogAgain again(file, configuration_.input, log);
    size_t read = 0;
    saveSimpleMap(folder_, again, isUpdate, best.path,
                  [&](const readings::Reading& reading, const auto* pose) {
                    check.addWay(reading.way, uses_[read++] != ReadingUse::skipped && !reading.scans.empty());
                    if (pose) check.add(*pose, reading.scans);
                  });
  };
  const bool isCompared = log.scans == 0 || writeOrNote("map.simplemap.gz", whyMissing, compare);
  Evidence evidence = check.evidence();
  if (!isCompared)
    evidence.notCompared = whyMissing;
  else if (isUpdate.size() < uses_.size())
    evidence.notCompared = "the recording ends before the run";
  evidence.spread = std::hypot(filter_->lastStep().stdX, filter_->lastStep().stdY);
  evidence.slips = counts_.slips;
  evidence.updates = updateTimes_.size();
  if (best.path.size() > 1)
    evidence.spacing = lengthsAlong(best.path).back() / static_cast<double>(best.path.size() - 1);
  if (!scanOdometry_) {
    evidence.odometryFaults = log.jumps.count + log.wrongOdometry.count;
    evidence.turns = turnsOf(recorder_.motionsOfUpdates(), best.path);
  }
  evidence.early = log.early.count;
  evidence.scans = log.scans;
  finished.verdict = verdictOf(evidence);
  // The poses of a relaxed path are matches to the map of all scans; the particles knew the earlier ones.
  const PathCovariances covariances(best.path,
                                    best.isRelaxed ? std::vector<PoseCovariance>() : particleCovariances_,
                                    evidence.returning, configuration_.filter.useLines, best.isRelaxed);
  writeCovarianceFile(best, covariances.ofPoses());
}

void FilterRun::writeCovarianceFile(const FinishedMap& best, const std::vector<PoseCovariance>& covariances) {
  folder_.write("covariance.csv", [&](std::ostream& out) {
    writeCovariances(out, best.trajectory, recorder_.updates(), best.path, covariances);
  });
}

Verdict FilterRun::verdictOfLocalization() const {
  Verdict verdict;
  const bool isLocalized = localizer_->isLocalized();
  const size_t losses = localizer_->losses();
  if (!isLocalized) verdict.reasons.push_back("the place of the robot is unknown at the end");
  if (losses > 0)
    verdict.reasons.push_back("the place was lost " + counted(losses, "time(s)") +
                              ": the robot was carried, or the surroundings have changed");
  verdict.level = !isLocalized ? Verdict::Level::lost
                  : losses > 0 ? Verdict::Level::doubtful
                               : Verdict::Level::consistent;
  return verdict;
}

nlohmann::ordered_json FilterRun::metrics(const FinishedRun& finished, const FinishedMap& best,
                                          const readings::RawlogSummary& log) const {
  const bool isWhole = uses_.size() == log.scans;
  const double wall = secondsBefore_ + secondsSince(start_);
  const double duration = isWhole ? log.duration : durationOf(best.trajectory);
  const bool isOne = configuration_.run.method == RunOptions::Method::ortho;
  nlohmann::ordered_json metrics{
      {"method", nameOf(configuration_.run.method)},
      {"particles", isOne ? 1 : filter_->particlePoses().size()},
      {"particles_min", counts_.particlesMin},
      {"particles_max", counts_.particlesMax},
      {"seed", configuration_.filter.filter.seed},
      {"threads", configuration_.filter.filter.threads},
      {"scans", scans_},
      {"updates", best.path.size()},
      {"duration_s", duration},
      {"wall_s", wall},
      {"cpu_s", cpuSeconds()},
      {"realtime_factor", wall > 0 ? duration / wall : 0},
      {"peak_rss_mb", peakMegabytes()},
      {"resamplings", counts_.resamplings},
      {"slips", counts_.slips},
      {"loops_closed", counts_.loops + best.loops.size()},
      {"path_relaxed", best.isRelaxed},
      {"verdict", finished.verdict.name()},
      {"reasons", finished.verdict.reasons},
      {"doubtful_places", json(finished.verdict.places, updateTimes_)},
      {"lines", best.lines.size()},
      {"distance_m", recorder_.distance()},
      {"complete", isWhole && log.defect.empty() && finished.incomplete.empty()},
      {"skipped_readings", log.skippedReadings()},
      {"versions", {{"hybrid_slam", HYBRID_SLAM_VERSION}, {"mrpt", mrpt::system::MRPT_getVersion()}}}};
  if (localizer_ && !best.path.empty())
    metrics["localized_share"] = static_cast<double>(located_) / static_cast<double>(best.path.size());
  return metrics;
}

}  // namespace hybrid_slam::run
