// The results of a run, at its end.
#include <mrpt/core/bits_math.h>
#include <mrpt/system/os.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "base/Clock.h"
#include "base/DeskewedScan.h"
#include "base/Numbers.h"
#include "files/InputFile.h"
#include "readings/Timestamps.h"
#include "run/FilterRun.h"
#include "run/JsonText.h"
#include "run/LoopNote.h"
#include "run/MapFiles.h"
#include "run/PlanFiles.h"
#include "run/ResourceUse.h"
#include "run/SimpleMapFile.h"
#include "run/StepsTable.h"
#include "run/VerdictCheck.h"
#include "slam/filter/PathRelaxation.h"
#include "slam/filter/Refinement.h"
#include "slam/grid/GridConversion.h"
#include "slam/loops/RevisitCheck.h"

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

/// Returns the covariances of poses in a fixed map: spread of the particles plus 1 cm and 0.1 deg for a scan
/// match.
std::vector<PoseCovariance> inFixedMap(std::vector<PoseCovariance> covariances) {
  const double angle = mrpt::DEG2RAD(0.1);
  for (PoseCovariance& covariance : covariances)
    covariance.diagonal() += Eigen::Vector3d(1e-4, 1e-4, angle * angle);
  return covariances;
}

/// Returns about how much memory (bytes) the scans take. MRPT keeps range, intensity and validity of a beam.
double memoryOf(const Scans& scans) {
  double bytes = 0;
  for (const auto& scan : scans) {
    const bool isDeskewed = dynamic_cast<const DeskewedScan*>(scan.get()) != nullptr;
    bytes += 600 + (isDeskewed ? 21 : 9) * static_cast<double>(scan->getScanSize());
  }
  return bytes;
}

bool hasChanged(const std::string& file, const readings::RawlogSummary& log) {
  return !log.state.empty() && files::stateOf(file) != log.state;
}

}  // namespace

std::string FilterRun::refineResult(Result& result, LogAgain& log) {
  std::vector<PosedScans> scans;
  double bytes = 0;
  for (const Use use : uses_) {
    const readings::Reading reading = log.next();
    if (use == Use::skipped) continue;
    scans.push_back({reading.scans, result.trajectory[scans.size()].pose, use == Use::update});
    bytes += memoryOf(reading.scans);
    const double expected = bytes * static_cast<double>(scans_) / static_cast<double>(scans.size());
    if (expected <= refinementBytes_) continue;
    return "the scans need " + fixedText(expected / 1e9, 1) + " GB, over " +
           fixedText(refinementBytes_ / 1e9, 1) + " GB";
  }
  if (scans.empty()) return {};
  const std::optional<ScanMap>& base = hybrid_->base();
  if (configuration_.filter.closesLoops() && !base) {
    std::vector<Scans> ofUpdates;
    for (const PosedScans& posed : scans)
      if (posed.isMapped) ofUpdates.push_back(posed.scans);
    const auto contradictionAlong = [&](const std::vector<mrpt::math::TPose2D>& path) {
      return contradictionOf(path, ofUpdates, configuration_.filter.grid.maxRange);
    };
    double contradiction = contradictionAlong(result.path);
    std::vector<mrpt::math::TPose2D> closed = result.path;
    std::vector<LoopClosure> loops =
        closeLoops(closed, ofUpdates, directionModuloRightAngle(result.lines), configuration_.filter);
    // A false loop puts walls into free space.
    if (const double after = loops.empty() ? INFINITY : contradictionAlong(closed); after < contradiction) {
      refinementLoops_ = std::move(loops);
      result.path = std::move(closed);
      contradiction = after;
    }
    // On a wrong map, returning scans may match the walls of other places.
    constexpr double kMoreContradiction = 0.02;  // of the compared beams
    std::vector<mrpt::math::TPose2D> even =
        relaxed(result.path, recorder_.motionsOfUpdates(), ofUpdates, configuration_.filter);
    result.isRelaxed = contradictionAlong(even) <= contradiction + kMoreContradiction;
    if (result.isRelaxed) result.path = std::move(even);
    result.trajectory = recorder_.trajectory(result.path);
    for (size_t i = 0; i < scans.size(); ++i) scans[i].pose = result.trajectory[i].pose;
  }
  std::vector<MotionDistribution> odometry;
  for (const mrpt::math::TPose2D& motion : recorder_.motions())
    odometry.push_back(motionDistribution({}, motion, configuration_.filter.motion));
  const mrpt::math::TPose2D start = scans.front().pose;
  refine(scans, configuration_.run.refine, configuration_.filter.grid, configuration_.filter.matcher,
         configuration_.filter.improved.minFit, configuration_.filter.filter.threads, base, odometry);
  // The first pose defines the frame of a new map.
  if (!base) moveFirstTo(start, scans);
  for (size_t i = 0, update = 0; i < scans.size(); ++i) {
    result.trajectory[i].pose = scans[i].pose;
    if (scans[i].isMapped) result.path[update++] = scans[i].pose;
  }
  result.map = MapMaker(configuration_.filter)(scans, base);
  result.grid = toMrpt(result.map.grid);
  result.lines = result.map.lines.lines();
  for (LoopClosure& loop : refinementLoops_) {
    loop.place = result.path[loop.later];
    notes_.push_back(loopNote(loop, updateTimes_, true));
  }
  return {};
}

/// The result stays as it is if it cannot be refined.
std::string FilterRun::refineOrSayWhyNot(Result& result, const std::string& file,
                                         const readings::RawlogSummary& log) {
  if (hasChanged(file, log)) return "the log has changed";
  if (log.scans < uses_.size()) return "the recording ends before the run";
  try {
    LogAgain again(file, configuration_.input, log);
    Result refined = result;
    const std::string why = refineResult(refined, again);
    if (why.empty()) result = std::move(refined);
    return why;
  } catch (const UnreadableLog& e) {
    return e.what();
  } catch (const InputError& e) {  // the map is too large
    return messageOf(e);
  } catch (const std::bad_alloc&) {
    return "out of memory";
  }
}

/// @throws std::bad_alloc if there was no memory for it
const mrpt::maps::COccupancyGridMap2D& FilterRun::gridOf(const Result& result) {
  if (!result.grid) throw std::bad_alloc();
  return *result.grid;
}

std::string FilterRun::finish(const std::string& file, const readings::RawlogSummary& log,
                              const nlohmann::ordered_json& more) {
  const mrpt::system::CTimeLoggerEntry writing(profiler(), "7 write results");
  finishCheckpoint();
  staged_.follow();
  whyMissing_.clear();  // of an attempt that failed
  refinementLoops_.clear();
  const bool hasRoom = !isMemoryFull();  // the results below are copies
  Result result{{}, filter_->bestPath(), {}, filter_->bestLines(), ScanMap()};
  bool hasMap = false;
  try {
    if (hybrid_ || (configuration_.filter.useLines && !localizer_)) result.map = currentMap();
    hasMap = true;
    result.grid = filter_->bestGrid();
  } catch (const std::bad_alloc&) {  // costs the files of the grid
  }
  result.path.resize(std::min(result.path.size(), updateTimes_.size()));  // without an update that failed
  result.trajectory = recorder_.trajectory(result.path);
  if (hybrid_ && configuration_.filter.useGrid && configuration_.run.refine > 0)
    if (const std::string why = hasRoom ? refineOrSayWhyNot(result, file, log) : "out of memory";
        !why.empty()) {
      notes_.push_back("map not refined: " + why);
      refinementLoops_.clear();
    }
  folder_.write("trajectory.tum", [&](std::ostream& out) { files::saveTum(result.trajectory, out); });
  if (localizer_) {
    verdict_ = verdictOfLocalization();
    writeCovarianceFile(result, inFixedMap(particleCovariances_));
  } else {
    writeMap(result, file, log);
  }
  if (worstVerdict_ && verdict_.isWorseThan(*worstVerdict_))
    throw WorseMap("its map is " + verdict_.name() +
                   (verdict_.level > worstVerdict_->level ? "" : ", too, and more scans contradict it"));
  writeOrNote("map.png", [&] {
    savePicture(folder_, gridOf(result), result.trajectory, result.lines, verdict_.places);
  });
  if (hybrid_)
    writeOrNote("session", [&] {
      if (!hasMap) throw std::bad_alloc();
      saveSessionTo(folder_.path(kSessionName), result.map, result.path);
    });
  if (!std::filesystem::exists(folder_.path(kSessionName)))
    if (const std::string kept = staged_.keepOwn(); !kept.empty())
      notes_.push_back("the last checkpoint stays: " + kept);
  folder_.write("steps.csv", [&](std::ostream& out) { out << withLoops(steps_.str(), refinementLoops_); });
  if (particles_) folder_.write("particles.csv", [&](std::ostream& out) { out << particles_->str(); });
  folder_.write("config.ini", [&](std::ostream& out) { out << configuration_.text(); });
  logHasChanged_ = hasChanged(file, log);
  if (worstVerdict_ && !whyMissing_.empty()) throw std::runtime_error("results are missing: " + whyMissing_);
  if (worstVerdict_ && logHasChanged_) throw std::runtime_error("the log has changed");
  nlohmann::ordered_json all = metrics(result, log);
  all.update(more);
  folder_.write("metrics.json", [&](std::ostream& out) { out << jsonText(all); });
  staged_.publish();

  const double wall = all.at("wall_s");
  return counted(scans_, "scan(s), ") + counted(result.path.size(), "update(s), ") +
         fixedText(recorder_.distance(), 0) + " m in " + fixedText(wall, 1) + " s (" +
         fixedText(all.at("realtime_factor"), 0) + " x real time): " + staged_.finalPath("map.png");
}

/// A result that needs more memory than there is, or a log that is gone, must not cost the others.
template <class Write>
bool FilterRun::writeOrNote(const std::string& result, const Write& write) {
  const auto note = [&](const std::string& reason) {
    notes_.push_back("no " + result + ": " + reason);
    whyMissing_ = reason;
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

void FilterRun::writeMap(const Result& result, const std::string& file, const readings::RawlogSummary& log) {
  savedCell_ = result.grid ? result.grid->getResolution() : cell_;
  writeOrNote("map.yaml", [&] { saveRosMap(folder_, gridOf(result), result.trajectory); });
  writeOrNote("map.gridmap.gz", [&] { saveGridMap(folder_, gridOf(result)); });
  saveLines(folder_, result.lines);
  if (configuration_.filter.useLines)
    writeOrNote("plan", [&] {
      gridOf(result);
      savePlan(folder_, floorPlanOf(result.lines, result.map.grid));
    });
  VerdictCheck check(configuration_.filter.grid.maxRange, filter_->earlierMap());
  std::vector<bool> isUpdate;
  for (size_t i = 0; i < std::min(uses_.size(), log.scans); ++i) isUpdate.push_back(uses_[i] == Use::update);
  const auto compare = [&] {
    LogAgain again(file, configuration_.input, log);
    saveSimpleMap(folder_, again, isUpdate, result.path,
                  [&check](const auto& pose, const Scans& scans) { check.add(pose, scans); });
  };
  const bool isCompared = log.scans == 0 || writeOrNote("map.simplemap.gz", compare);
  Evidence evidence = check.evidence();
  if (!isCompared)
    evidence.notCompared = whyMissing_;
  else if (isUpdate.size() < uses_.size())
    evidence.notCompared = "the recording ends before the run";
  evidence.spread = std::hypot(filter_->lastStep().stdX, filter_->lastStep().stdY);
  evidence.slips = slips_;
  evidence.updates = updateTimes_.size();
  if (!scanOdometry_) evidence.odometryFaults = log.jumps.count + log.wrongOdometry.count;
  evidence.scans = log.scans;
  verdict_ = verdictOf(evidence);
  // The poses of a relaxed path are matches to the map of all scans; the particles knew the earlier ones.
  const PathCovariances covariances(result.path,
                                    result.isRelaxed ? std::vector<PoseCovariance>() : particleCovariances_,
                                    evidence.returning, configuration_.filter.useLines, result.isRelaxed);
  writeCovarianceFile(result, covariances.ofPoses());
}

void FilterRun::writeCovarianceFile(const Result& result, const std::vector<PoseCovariance>& covariances) {
  folder_.write("covariance.csv", [&](std::ostream& out) {
    writeCovariances(out, result.trajectory, recorder_.updates(), result.path, covariances);
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

nlohmann::ordered_json FilterRun::metrics(const Result& result, const readings::RawlogSummary& log) const {
  const bool isWhole = uses_.size() == log.scans;
  const double wall = secondsBefore_ + secondsSince(start_);
  const double duration = isWhole ? log.duration : durationOf(result.trajectory);
  const bool isOne = configuration_.run.method == RunOptions::Method::ortho;
  nlohmann::ordered_json metrics{
      {"method", nameOf(configuration_.run.method)},
      {"particles", isOne ? 1 : filter_->particlePoses().size()},
      {"particles_min", particlesMin_},
      {"particles_max", particlesMax_},
      {"seed", configuration_.filter.filter.seed},
      {"threads", configuration_.filter.filter.threads},
      {"scans", scans_},
      {"updates", result.path.size()},
      {"duration_s", duration},
      {"wall_s", wall},
      {"cpu_s", cpuSeconds()},
      {"realtime_factor", wall > 0 ? duration / wall : 0},
      {"peak_rss_mb", peakMegabytes()},
      {"resamplings", resamplings_},
      {"slips", slips_},
      {"loops_closed", loops_ + refinementLoops_.size()},
      {"path_relaxed", result.isRelaxed},
      {"verdict", verdict_.name()},
      {"reasons", verdict_.reasons},
      {"doubtful_places", json(verdict_.places, updateTimes_)},
      {"lines", result.lines.size()},
      {"distance_m", recorder_.distance()},
      {"complete", isWhole && log.defect.empty() && whyMissing_.empty() && !logHasChanged_},
      {"skipped_readings", log.skippedReadings()},
      {"versions", {{"hybrid_slam", HYBRID_SLAM_VERSION}, {"mrpt", mrpt::system::MRPT_getVersion()}}}};
  if (localizer_ && !result.path.empty())
    metrics["localized_share"] = static_cast<double>(located_) / static_cast<double>(result.path.size());
  return metrics;
}

}  // namespace hybrid_slam::run
