#include "run/FilterRun.h"

#include <malloc.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <locale>
#include <new>
#include <stdexcept>

#include "base/Clock.h"
#include "base/Errors.h"
#include "base/Memory.h"
#include "base/Numbers.h"
#include "base/PoseRotation.h"
#include "run/Fingerprint.h"
#include "run/KnownMap.h"
#include "run/LoopNote.h"
#include "run/PlanFiles.h"
#include "run/ResourceUse.h"
#include "run/ResultFiles.h"
#include "run/StepsTable.h"
#include "run/VerdictCheck.h"
#include "slam/filter/StockMapBuilder.h"
#include "slam/ortho/OrthoFilter.h"

namespace hybrid_slam::run {
namespace {

namespace fs = std::filesystem;
using Method = RunOptions::Method;

mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions stockSettings(const Configuration& configuration) {
  if (!configuration.source.sectionExists(kStockSection))
    return stockOptions(configuration.filter.filter, configuration.filter.grid);
  try {
    return stockOptions(configuration.source);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError("wrong settings for MRPT's filter", std::string("section [") + kStockSection + "]",
                     messageOf(e));
  }
}

std::unique_ptr<PlanSearch> planSearchOf(const Configuration& configuration) {
  return std::make_unique<PlanSearch>(configuration.filter, loadPlan(configuration.run.priorPlan),
                                      configuration.run.start);
}

/// Returns the session that the run continues from, if it is in the output folder.
std::string ownFile(const RunOptions& run) {
  const fs::path name = fs::path(run.resume).filename();
  std::error_code ignored;
  return !name.empty() && fs::equivalent(run.resume, run.output / name, ignored) ? name.string() : "";
}

}  // namespace

FilterRun::FilterRun(Configuration& configuration, Clock::time_point start)
    : configuration_(configuration),
      start_(start),
      staged_(configuration.run.output, kResultFiles, configuration.run.overwrite,
              ownFile(configuration.run)),
      folder_(staged_.files()),
      mostBytes_(memoryLimit() / 4),
      refinementBytes_(memoryLimit() / 4),
      sessionBytes_(memoryLimit() / 8) {
  const RunOptions& run = configuration.run;
  std::optional<ScanMap> map = mapOfEarlierRun(configuration);
  staged_.expectKept({configuration.iniFile, run.rawlog, run.priorPlan});
  for (const std::string& name : {run.continueFrom, run.localizeIn}) staged_.expectKept(filesOfMap(name));
  cell_ = configuration.filter.grid.resolution;  // that of the map, if there is one
  if (configuration.run.checkpointEvery > 0 &&
      (configuration.run.method == Method::stock || configuration.run.method == Method::ortho))
    throw InputError("method " + nameOf(configuration.run.method) + " saves no sessions",
                     "option --checkpoint-every", "expected method hybrid, general or linemap");
  if (configuration.run.method == Method::stock) {
    auto stock = std::make_unique<StockMapBuilder>(stockSettings(configuration), configuration.filter.motion,
                                                   static_cast<uint32_t>(configuration.filter.filter.seed),
                                                   memoryLimit() / 2);
    cell_ = stock->cellSize();
    filter_ = std::move(stock);
  } else if (configuration.run.method == Method::ortho) {
    filter_ = std::make_unique<OrthoFilter>(configuration.filter, configuration.ortho);
  } else if (!configuration.run.localizeIn.empty()) {
    auto localizer =
        std::make_unique<Localizer>(configuration.filter, map->grid, map->lines, configuration.run.start);
    localizer_ = localizer.get();
    filter_ = std::move(localizer);
  } else {
    auto hybrid = std::make_unique<HybridFilter>(configuration.filter);
    hybrid_ = hybrid.get();
    filter_ = std::move(hybrid);
    earlierMap_ = std::move(map);
    if (earlierMap_)
      search_ = std::make_unique<Localizer>(configuration.filter, earlierMap_->grid, earlierMap_->lines,
                                            configuration.run.start);
    if (!configuration.run.priorPlan.empty()) planSearch_ = planSearchOf(configuration);
    if (search_ || planSearch_) hybrid_->expectMap();
    if (search_ && !configuration.run.start && earlierMap_->grid.resolution() > RevisitCheck::kResolution)
      notes_.push_back("the place in " + configuration.run.continueFrom +
                       " is not checked: its cells are larger than " +
                       fixedText(RevisitCheck::kResolution, 1) + " m");
  }
  if (!configuration.input.requireOdometry)
    scanOdometry_.emplace(configuration.filter.grid, configuration.filter.matcher);
  else if (configuration.input.replaceStuckOdometry)
    stuckOdometry_.emplace(configuration.filter.grid, configuration.filter.matcher);
  steps_.imbue(std::locale::classic());
  writeStepsHeader(steps_);
  if (configuration.run.particlesEvery == 0) return;
  particles_.emplace().imbue(std::locale::classic());
  writeParticlesHeader(*particles_);
}

FilterRun::~FilterRun() = default;

bool FilterRun::process(const readings::Reading& reading) {
  isConsistent_ = false;
  readings::Reading moved = reading;
  if (scanOdometry_) moved.motion = scanOdometry_->motionTo(reading.scans, reading.timestamp);
  if (stuckOdometry_) replaceStuckOdometry(moved);
  const bool isUpdate = filter(moved);
  if (search_) searchPlace(moved);
  if (planSearch_) searchPlan(moved);
  isConsistent_ = true;
  saveIfDue();
  if (isUpdate || scans_ % 100 == 0) checkMemory();
  return isUpdate;
}

void FilterRun::replaceStuckOdometry(readings::Reading& reading) {
  const bool wasStuck = stuckOdometry_->isStuck();
  reading.motion = stuckOdometry_->motionTo(reading.motion, reading.scans, reading.timestamp);
  if (!wasStuck && !stuckOdometry_->isStuck()) return;
  if (stuckScans_++ > 0) return;
  firstStuck_ = reading.timestamp;
  notes_.push_back("the odometry stands still while the scans move: scan matching replaces it from " +
                   fixedText(firstStuck_, 3) + " s on");
}

bool FilterRun::isMemoryFull() {
  if (configuration_.run.method == Method::stock || residentBytes() <= mostBytes_) return false;
  finishCheckpoint();             // its bytes are a copy
  ::malloc_trim(0);               // the allocator keeps what earlier particles have freed
  constexpr double kFull = 0.95;  // else a run at the limit would spend its time here
  return residentBytes() > kFull * mostBytes_;
}

// Scans of new ground, in a log or from a server, would end the program and the whole machine without
// results.
void FilterRun::checkMemory() {
  if (isMemoryFull()) throw std::runtime_error(memoryNote());
}

std::string FilterRun::memoryNote() const {
  return "out of memory: the map, the path and the scans take over " + fixedText(mostBytes_ / 1e9, 1) +
         " GB, a quarter of the memory";
}

bool FilterRun::filter(const readings::Reading& reading) {
  constexpr double kMargin = 1.25;  // checkMemory, after the update, first gives back what is unused
  const auto stepStart = Clock::now();
  const size_t before = filter_->updates();
  try {
    const ResidentLimit limit(kMargin * mostBytes_);
    filter_->process(reading.motion, reading.scans);
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(memoryNote());
  }
  ++scans_;
  fingerprint_ = fingerprintAfter(fingerprint_, reading);
  recorder_.add(reading.timestamp, reading.motion, filter_->updates());
  uses_.push_back(filter_->updates() > before ? Use::update : Use::carried);
  const bool isUpdate = uses_.back() == Use::update;
  if (isUpdate) record(reading.timestamp, stepStart);
  return isUpdate;
}

// A corridor of another building may look like one of the map. Then the scans on the way there contradict it.
bool FilterRun::isContradictedAt(const mrpt::math::TPose2D& pose) {
  if (!earlierWalls_) earlierWalls_ = toCompare(earlierMap_->grid);
  const std::vector<Revisit> compared = hybrid_->comparedWith(*earlierWalls_, pose);
  return static_cast<double>(contradictedOf(compared)) >
         kMostAgainstEarlierMap * static_cast<double>(compared.size());
}

// Until the place in the map of the earlier run is found, the filter maps in its own frame.
void FilterRun::searchPlace(const readings::Reading& reading) {
  constexpr size_t kPause = 20;  // scans
  const size_t before = search_->updates();
  search_->process(reading.motion, reading.scans);
  const bool isUpdate = search_->updates() > before;  // else its pose is that of an earlier scan
  if (!isUpdate || !search_->isLocalized() || scans_ < nextPlace_) return;
  const mrpt::math::TPose2D pose = search_->bestPath().back();
  if (!configuration_.run.start && isContradictedAt(pose)) {
    nextPlace_ = scans_ + kPause;
    return;
  }
  notes_.push_back("place found after " + counted(scans_, "scan(s): (") + fixedText(pose.x, 2) + ", " +
                   fixedText(pose.y, 2) + ") m, " + fixedText(mrpt::RAD2DEG(pose.phi), 1) +
                   " deg in the map of " + configuration_.run.continueFrom);
  joinMap(*earlierMap_, pose);
  earlierMap_.reset();
  earlierWalls_.reset();
  search_.reset();
}

void FilterRun::searchPlan(const readings::Reading& reading) {
  planSearch_->process(reading.motion, reading.scans);
  if (!planSearch_->isOver()) return;
  const std::unique_ptr<PlanSearch> search = std::move(planSearch_);
  const auto& found = search->found();
  if (!found) return hybrid_->expectNoMap();
  notes_.push_back("place found after " + counted(scans_, "scan(s): (") + fixedText(found->pose.x, 2) + ", " +
                   fixedText(found->pose.y, 2) + ") m, " + fixedText(mrpt::RAD2DEG(found->pose.phi), 1) +
                   " deg in " + configuration_.run.priorPlan + ", scaled by " + fixedText(found->scale, 3));
  joinMap(found->map, found->pose);
}

void FilterRun::joinMap(const ScanMap& map, const mrpt::math::TPose2D& pose) {
  const double turn = hybrid_->joinMap(map, pose);
  for (PoseCovariance& covariance : particleCovariances_) covariance = rotated(covariance, turn);
}

std::string FilterRun::placeNote() const {
  if (hybrid_ && !configuration_.run.priorPlan.empty() && !hybrid_->base())
    return "place not found in the floor plan " + configuration_.run.priorPlan + ": " +
           counted(scans_, "scan(s), mapped in their own frame; --start X,Y,DEG gives the place");
  if (!search_) return {};
  return "place not found in the map of " + configuration_.run.continueFrom + ": " + std::to_string(scans_) +
         " scans, mapped in their own frame; --start X,Y,DEG gives the place";
}

void FilterRun::record(double timestamp, Clock::time_point stepStart) {
  updateTimes_.push_back(timestamp);
  const FilterStep& step = filter_->lastStep();
  particlesMin_ = particlesMin_ == 0 ? step.particles : std::min(particlesMin_, step.particles);
  particlesMax_ = std::max(particlesMax_, step.particles);
  particleCovariances_.push_back(covarianceOf(step.poses));
  resamplings_ += step.resampled.value_or(false) ? 1 : 0;
  if (step.slipped.value_or(false) && slips_++ == 0) firstSlip_ = timestamp;
  if (step.loop) {
    ++loops_;
    notes_.push_back(loopNote(*step.loop, updateTimes_, false));
  }
  if (localizer_) located_ += localizer_->isLocalized();
  writeStep(steps_, timestamp, step, 1000 * secondsSince(stepStart));
  if (particles_ && filter_->updates() % static_cast<size_t>(configuration_.run.particlesEvery) == 0)
    writeParticles(*particles_, timestamp, step);
}

std::string FilterRun::slipNote() const {
  if (slips_ == 0) return {};
  return counted(slips_, "update(s) with rejected odometry: first at ") + fixedText(firstSlip_, 3) + " s" +
         "; scan matching replaced it";
}

std::string FilterRun::stuckNote() const {
  if (stuckScans_ == 0) return {};
  return counted(stuckScans_, "scan(s) with odometry that stood still while the robot moved: first at ") +
         fixedText(firstStuck_, 3) + " s; scan matching replaced it";
}

std::string FilterRun::mapNote() const {
  if (savedCell_ < 1.5 * cell_) return {};
  return "the map files have cells of " + fixedText(savedCell_, 2) + " m instead of " + fixedText(cell_, 2) +
         " m: the map is too large for MRPT's grid";
}

}  // namespace hybrid_slam::run
