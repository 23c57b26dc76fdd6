#include "run/FilterRun.h"

#include <mrpt/system/os.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/Clock.h"
#include "base/Errors.h"
#include "base/Numbers.h"
#include "run/Fingerprint.h"
#include "run/MapFiles.h"
#include "run/ResultFiles.h"
#include "run/SimpleMapFile.h"
#include "run/StepsTable.h"
#include "slam/filter/Refinement.h"
#include "slam/filter/StockMapBuilder.h"
#include "slam/grid/GridConversion.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam::run {
namespace {

using Method = RunOptions::Method;

mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions stockSettings(const Configuration& configuration) {
  if (!configuration.source.sectionExists(kStockSection)) return stockOptions(configuration.filter);
  try {
    return stockOptions(configuration.source);
  } catch (const std::exception& e) {
    throw InputError("wrong settings for MRPT's filter", std::string("section [") + kStockSection + "]",
                     messageOf(e));
  }
}

double cpuSeconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Peak resident memory of this program; getrusage would include the parent's.
double peakMegabytes() {
  std::ifstream status("/proc/self/status");
  double kilobytes = 0;
  for (std::string word; status >> word;)
    if (word == "VmHWM:") status >> kilobytes;
  return kilobytes / 1024;
}

std::string describe(const LoopClosure& loop, const std::vector<double>& times) {
  return "loop closed at (" + fixedText(loop.place.x, 1) + ", " + fixedText(loop.place.y, 1) +
         ") m between " + fixedText(times.at(loop.earlier), 1) + " s and " +
         fixedText(times.at(loop.later), 1) + " s: path moved by up to " + fixedText(loop.shift, 2) +
         " m and " + fixedText(loop.turn * 180 / M_PI, 1) + " deg; " + std::to_string(loop.matches) +
         " matches agree, at least " + fixedText(100 * loop.fit, 0) +
         " % of their walls fit, other places score " + fixedText(100 * loop.second, 0) + " % of theirs";
}

/// s, between the earliest and the latest pose.
double durationOf(const files::Trajectory& trajectory) {
  const auto [first, last] =
      std::minmax_element(trajectory.begin(), trajectory.end(),
                          [](const auto& a, const auto& b) { return a.timestamp < b.timestamp; });
  return first == trajectory.end() ? 0 : last->timestamp - first->timestamp;
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

}  // namespace

FilterRun::FilterRun(Configuration& configuration, Clock::time_point start)
    : configuration_(configuration),
      start_(start),
      staged_(configuration.run.output, kResultFiles, configuration.run.overwrite,
              configuration.run.resume.empty() ? "" : kSessionName),
      folder_(staged_.files()),
      steps_(folder_.path("steps.csv")) {
  if (configuration.run.method == Method::stock) {
    filter_ = std::make_unique<StockMapBuilder>(stockSettings(configuration), configuration.filter.motion,
                                                static_cast<uint32_t>(configuration.filter.filter.seed));
  } else {
    auto ours = std::make_unique<HybridFilter>(configuration.filter);
    hybrid_ = ours.get();
    filter_ = std::move(ours);
  }
  if (!configuration.input.requireOdometry) scanOdometry_.emplace(configuration.filter);
  writeStepsHeader(steps_.stream());
  if (configuration.run.particlesEvery > 0)
    writeParticlesHeader(particles_.emplace(folder_.path("particles.csv")).stream());
}

FilterRun::~FilterRun() = default;

bool FilterRun::process(const readings::Reading& reading) {
  const auto stepStart = Clock::now();
  const size_t before = filter_->updates();
  const mrpt::math::TPose2D motion =
      scanOdometry_ ? scanOdometry_->motionTo(reading.scans, reading.timestamp) : reading.motion;
  filter_->process(motion, reading.scans);

  ++scans_;
  fingerprint_ = fingerprintAfter(fingerprint_, reading);
  recorder_.add(reading.timestamp, motion, filter_->updates());
  uses_.push_back(filter_->updates() > before ? Use::update : Use::carried);
  const bool isUpdate = uses_.back() == Use::update;
  if (isUpdate) record(reading.timestamp, stepStart);
  checkpointIfDue();
  return isUpdate;
}

void FilterRun::record(double timestamp, Clock::time_point stepStart) {
  updateTimes_.push_back(timestamp);
  const FilterStep& step = filter_->lastStep();
  particlesMin_ = particlesMin_ == 0 ? step.particles : std::min(particlesMin_, step.particles);
  particlesMax_ = std::max(particlesMax_, step.particles);
  particleCovariances_.push_back(covarianceOf(step.poses));
  resamplings_ += step.resampled.value_or(false) ? 1 : 0;
  if (step.slipped.value_or(false) && slips_++ == 0) firstSlip_ = timestamp;
  if (step.loop) note(*step.loop);
  writeStep(steps_.stream(), timestamp, step, 1000 * secondsSince(stepStart));
  if (particles_ && filter_->updates() % static_cast<size_t>(configuration_.run.particlesEvery) == 0)
    writeParticles(particles_->stream(), timestamp, step);
}

std::string FilterRun::slipNote() const {
  if (slips_ == 0) return {};
  return std::to_string(slips_) + " updates with a large odometry error: first at " +
         fixedText(firstSlip_, 3) + " s" + "; scan matching replaced it";
}

std::string FilterRun::mapNote() const {
  const double cell = configuration_.filter.grid.resolution;
  if (configuration_.run.method == Method::stock || savedCell_ < 1.5 * cell) return {};
  return "the map files have cells of " + fixedText(savedCell_, 2) + " m instead of " + fixedText(cell, 2) +
         " m: the map is too large for MRPT's grid";
}

void FilterRun::note(const LoopClosure& loop) {
  ++loops_;
  loopNotes_.push_back(describe(loop, updateTimes_));
}

void FilterRun::refineResult(Result& result, readings::RawlogSource& source) {
  std::vector<PosedScans> scans;
  for (const Use use : uses_) {
    const auto reading = source.next();
    if (!reading) break;
    if (use != Use::skipped)
      scans.push_back({reading->scans, result.trajectory[scans.size()].pose, use == Use::update});
  }
  if (configuration_.filter.loopClosing.enabled) {
    std::vector<Scans> ofUpdates;
    for (const PosedScans& posed : scans)
      if (posed.isMapped) ofUpdates.push_back(posed.scans);
    std::vector<mrpt::math::TPose2D> closed = result.path;
    const auto loops =
        closeLoops(closed, ofUpdates, directionModuloRightAngle(result.lines), configuration_.filter);
    // A false loop puts walls into free space.
    if (!loops.empty() && contradictionOf(closed, ofUpdates) < contradictionOf(result.path, ofUpdates)) {
      for (const LoopClosure& loop : loops) note(loop);
      result.path = std::move(closed);
      result.trajectory = recorder_.trajectory(result.path);
      for (size_t i = 0; i < scans.size(); ++i) scans[i].pose = result.trajectory[i].pose;
    }
  }
  refine(scans, configuration_.filter, configuration_.run.refine);
  for (size_t i = 0, update = 0; i < scans.size(); ++i) {
    result.trajectory[i].pose = scans[i].pose;
    if (scans[i].isMapped) result.path[update++] = scans[i].pose;
  }
  result.map = mapOf(scans, configuration_.filter);
  result.grid = toMrpt(result.map.grid);
  result.lines = result.map.lines.lines();
}

std::string FilterRun::finish(const std::string& file, const readings::RawlogSummary& log,
                              const nlohmann::ordered_json& more) {
  const mrpt::system::CTimeLoggerEntry writing(profiler(), "7 write results");
  uses_.resize(std::min(uses_.size(), log.scans));
  const bool isWhole = uses_.size() == log.scans;
  Result result{{}, filter_->bestPath(), filter_->bestGrid(), filter_->bestLines(), ScanMap()};
  if (hybrid_) result.map = hybrid_->bestMap();
  result.trajectory = recorder_.trajectory(result.path);
  if (configuration_.run.refine > 0 && configuration_.run.method != Method::stock) {
    readings::RawlogSource scans(file, configuration_.input, log);
    refineResult(result, scans);
  }
  const auto& [trajectory, path, grid, lines, map] = result;
  folder_.write("trajectory.tum", [&](std::ostream& out) { files::saveTum(result.trajectory, out); });
  savedCell_ = grid.getResolution();
  saveRosMap(folder_, grid);
  saveGridMap(folder_, grid);
  std::vector<bool> isUpdate;
  for (const Use use : uses_) isUpdate.push_back(use == Use::update);
  readings::RawlogSource again(file, configuration_.input, log);
  VerdictCheck check;
  saveSimpleMap(folder_, again, isUpdate, path,
                [&check](const auto& pose, const Scans& scans) { check.add(pose, scans); });
  Evidence evidence = check.evidence();
  evidence.spread = std::hypot(filter_->lastStep().stdX, filter_->lastStep().stdY);
  evidence.slips = slips_;
  verdict_ = verdictOf(evidence);
  const bool hasLines = configuration_.run.method == Method::hybrid;
  const auto covariances = pathCovariances(path, particleCovariances_, evidence.returning, hasLines);
  folder_.write("covariance.csv", [&, &path = path](std::ostream& out) {
    writeCovariances(out, result.trajectory, recorder_.updates(), path, covariances);
  });
  savePicture(folder_, grid, trajectory, lines, verdict_.places);
  saveLines(folder_, lines);
  steps_.finish();
  if (particles_) particles_->finish();
  folder_.write("config.ini", [&](std::ostream& out) { out << configuration_.text(); });

  if (hybrid_) saveSessionTo(folder_.path(kSessionName), map, path);

  const double wall = secondsBefore_ + secondsSince(start_);
  const double duration = isWhole ? log.duration : durationOf(trajectory);
  const char* const names[] = {"hybrid", "general", "stock"};
  nlohmann::ordered_json metrics{
      {"method", names[static_cast<int>(configuration_.run.method)]},
      {"particles", filter_->particlePoses().size()},
      {"particles_min", particlesMin_},
      {"particles_max", particlesMax_},
      {"seed", configuration_.filter.filter.seed},
      {"threads", configuration_.filter.filter.threads},
      {"scans", scans_},
      {"updates", path.size()},
      {"duration_s", duration},
      {"wall_s", wall},
      {"cpu_s", cpuSeconds()},
      {"realtime_factor", wall > 0 ? duration / wall : 0},
      {"peak_rss_mb", peakMegabytes()},
      {"resamplings", resamplings_},
      {"slips", slips_},
      {"loops_closed", loops_},
      {"verdict", verdict_.name()},
      {"reasons", verdict_.reasons},
      {"doubtful_places", json(verdict_.places, updateTimes_)},
      {"lines", lines.size()},
      {"distance_m", recorder_.distance()},
      {"complete", isWhole && log.defect.empty()},
      {"skipped_readings", log.skippedReadings()},
      {"versions", {{"hybrid_slam", HYBRID_SLAM_VERSION}, {"mrpt", mrpt::system::MRPT_getVersion()}}}};
  metrics.update(more);
  folder_.write("metrics.json", [&](std::ostream& out) { out << metrics.dump(2) << '\n'; });
  staged_.publish();

  return std::to_string(scans_) + " scans, " + std::to_string(path.size()) + " updates, " +
         fixedText(recorder_.distance(), 0) + " m in " + fixedText(wall, 1) + " s (" +
         fixedText(wall > 0 ? duration / wall : 0, 0) + " x real time): " + staged_.finalPath("map.png");
}

}  // namespace hybrid_slam::run
