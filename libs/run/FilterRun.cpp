#include "run/FilterRun.h"

#include <malloc.h>

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
#include "run/ResourceUse.h"
#include "run/ResultFiles.h"
#include "run/StepsTable.h"
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
    if (map || !configuration.run.priorPlan.empty()) {
      search_.emplace(configuration, std::move(map));
      place_ = PlaceInMap::searched;
      hybrid_->expectMap();
      if (const std::string warning = search_->warning(); !warning.empty()) notes_.push_back(warning);
    }
  }
  if (!configuration.input.requireOdometry || configuration.input.headingOdometry)
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
  noteRepeatedScan(reading);
  readings::Reading moved = reading;
  if (scanOdometry_)
    moved.motion = scanOdometry_->motionTo(reading.scans, reading.timestamp, measuredTurn(reading));
  if (stuckOdometry_) replaceStuckOdometry(moved);
  const bool isUpdate = filter(moved);
  if (search_) searchPlace(moved);
  isConsistent_ = true;
  saveIfDue();
  if (isUpdate || scans_ % 100 == 0) checkMemory();
  return isUpdate;
}

std::optional<double> FilterRun::measuredTurn(const readings::Reading& reading) const {
  const readings::InputOptions& input = configuration_.input;
  if (!input.requireOdometry || !input.headingOdometry) return std::nullopt;
  return reading.motion.phi;
}

void FilterRun::noteRepeatedScan(const readings::Reading& reading) {
  if (!reading.repeating || hasRepeatedScans_) return;
  hasRepeatedScans_ = true;
  notes_.push_back("laser `" + *reading.repeating + "` repeats its last scan while the robot moves: " +
                   "such scans are not used, first at " + fixedText(reading.timestamp, 3) + " s");
}

void FilterRun::replaceStuckOdometry(readings::Reading& reading) {
  const bool wasStuck = stuckOdometry_->isStuck();
  reading.motion = stuckOdometry_->motionTo(reading.motion, reading.scans, reading.timestamp);
  if (!wasStuck && !stuckOdometry_->isStuck()) return;
  counts_.addStuckScan(reading.timestamp);
  if (counts_.stuckScans > 1) return;
  notes_.push_back("the odometry stands still while the scans move: scan matching replaces it from " +
                   fixedText(counts_.firstStuck, 3) + " s on");
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
  uses_.push_back(filter_->updates() > before ? ReadingUse::update : ReadingUse::carried);
  const bool isUpdate = uses_.back() == ReadingUse::update;
  if (isUpdate) record(reading.timestamp, stepStart);
  return isUpdate;
}

// Until the place is found, the filter maps in its own frame.
void FilterRun::searchPlace(const readings::Reading& reading) {
  const std::optional<FoundPlace> found = search_->process(reading, *hybrid_, scans_);
  if (!search_->isOver()) return;
  search_.reset();
  place_ = found ? PlaceInMap::known : PlaceInMap::notFound;
  if (!found) return hybrid_->expectNoMap();
  notes_.push_back(found->note);
  const double turn = hybrid_->joinMap(found->map, found->pose);
  for (PoseCovariance& covariance : particleCovariances_) covariance = rotated(covariance, turn);
}

std::string FilterRun::placeNote() const {
  if (place_ == PlaceInMap::known) return {};
  const RunOptions& run = configuration_.run;
  std::string map = run.continueFrom.empty() ? "floor plan" : "map of " + run.continueFrom;
  if (!run.priorPlan.empty()) map += " " + run.priorPlan;  // a session does not name it
  return "place not found in the " + map + ": " + counted(scans_, "scan(s), mapped in their own frame; ") +
         (run.start ? "they do not fit at --start" : "--start X,Y,DEG gives the place");
}

void FilterRun::record(double timestamp, Clock::time_point stepStart) {
  updateTimes_.push_back(timestamp);
  const FilterStep& step = filter_->lastStep();
  counts_.add(timestamp, step);
  particleCovariances_.push_back(covarianceOf(step.poses));
  if (step.loop) notes_.push_back(loopNote(*step.loop, updateTimes_, false));
  if (localizer_) located_ += localizer_->isLocalized();
  writeStep(steps_, timestamp, step, 1000 * secondsSince(stepStart));
  if (particles_ && filter_->updates() % static_cast<size_t>(configuration_.run.particlesEvery) == 0)
    writeParticles(*particles_, timestamp, step);
}

}  // namespace hybrid_slam::run
