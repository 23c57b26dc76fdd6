#include "io/Replay.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/system/os.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/Errors.h"
#include "grid/GridConversion.h"
#include "io/MapFiles.h"
#include "io/Progress.h"
#include "io/SimpleMapFile.h"
#include "io/StepsTable.h"
#include "io/TrajectoryRecorder.h"
#include "rbpf/HybridMapBuilder.h"
#include "rbpf/Refinement.h"
#include "rbpf/StockMapBuilder.h"

namespace hybrid_slam {
namespace {

using Clock = std::chrono::steady_clock;
using Method = RunOptions::Method;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Filter {
  std::unique_ptr<mrpt::slam::CMetricMapBuilder> builder;
  FilterView* view;
};

mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions stockSettings(const Configuration& configuration) {
  if (!configuration.source.sectionExists(kStockSection)) return stockOptions(configuration.filter);
  try {
    return stockOptions(configuration.source);
  } catch (const std::exception& e) {
    throw InputError("wrong settings for MRPT's filter", std::string("section [") + kStockSection + "]",
                     messageOf(e));
  }
}

Filter makeFilter(const Configuration& configuration) {
  if (configuration.run.method == Method::stock) {
    // MRPT's filter draws from MRPT's global generator.
    mrpt::random::getRandomGenerator().randomize(static_cast<uint32_t>(configuration.filter.filter.seed));
    auto stock = std::make_unique<StockMapBuilder>(stockSettings(configuration));
    FilterView* view = stock.get();
    return {std::move(stock), view};
  }
  auto hybrid = std::make_unique<HybridMapBuilder>(configuration.filter);
  hybrid->rememberScans(false);  // the log has them
  FilterView* view = hybrid.get();
  return {std::move(hybrid), view};
}

std::vector<std::string> warningsOf(const RawlogSummary& log) {
  std::vector<std::string> all;
  const auto add = [&all](const Oddity& odd, const std::string& what, const std::string& done) {
    if (odd.count > 0)
      all.push_back(std::to_string(odd.count) + " " + what + ": first at entry " + std::to_string(odd.first) +
                    "; " + done);
  };
  add(log.empty, "scans without beams (or aperture or sensor pose)", "left out");
  add(log.unstamped, "scans without timestamp", "they take that of the scan before");
  add(log.repeatedStamps, "timestamps repeat that of the scan before", "kept as they are");
  add(log.stepsBack, "timestamps step back", "the order of the log holds");
  add(log.wrongOdometry, "odometry readings that are not numbers", "left out");
  return all;
}

double cpuSeconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// The most memory that this program has had resident; getrusage would count that of whoever started it, too.
double peakMegabytes() {
  std::ifstream status("/proc/self/status");
  double kilobytes = 0;
  for (std::string word; status >> word;)
    if (word == "VmHWM:") status >> kilobytes;
  return kilobytes / 1024;
}

std::string textOf(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

ReplayOutcome replay(Configuration& configuration, bool isQuiet, const std::atomic<bool>& stop,
                     const std::string& version) {
  const auto start = Clock::now();
  const RunOptions& run = configuration.run;
  if (run.refine > 0 && run.method == Method::stock)
    throw InputError("no refinement of MRPT's filter", "section [run], keys `method`, `refine`",
                     "expected hybrid or general, or refine = 0");
  const RawlogSummary log = summarise(run.rawlog, configuration.input);
  const OutputFolder folder(run.output);
  RawlogSource source(run.rawlog, configuration.input, log);
  const Filter filter = makeFilter(configuration);

  GrowingFile steps(folder.path("steps.csv"));
  writeStepsHeader(steps.stream());
  std::optional<GrowingFile> particles;
  if (run.particlesEvery > 0) writeParticlesHeader(particles.emplace(folder.path("particles.csv")).stream());
  TrajectoryRecorder recorder;
  std::vector<bool> isUpdate;
  size_t resamplings = 0, slips = 0;
  double firstSlip = 0;
  Progress progress(log.scans, isQuiet);
  while (const auto reading = stop ? std::nullopt : source.next()) {
    const auto stepStart = Clock::now();
    const size_t before = filter.view->updates();
    mrpt::obs::CActionCollection action;
    action.insert(toAction(reading->motion, configuration.filter.motion));
    mrpt::obs::CSensoryFrame observations;
    observations.insert(reading->scan);
    filter.builder->processActionObservation(action, observations);

    recorder.add(reading->timestamp, reading->motion, filter.view->updates());
    isUpdate.push_back(filter.view->updates() > before);
    if (!isUpdate.back()) continue;
    const FilterStep& step = filter.view->lastStep();
    resamplings += step.resampled.value_or(false) ? 1 : 0;
    if (step.slipped.value_or(false) && slips++ == 0) firstSlip = reading->timestamp;
    writeStep(steps.stream(), reading->timestamp, step, 1000 * secondsSince(stepStart));
    if (particles && filter.view->updates() % static_cast<size_t>(run.particlesEvery) == 0)
      writeParticles(particles->stream(), reading->timestamp, step);
    progress.update(isUpdate.size(), textOf("spread %.2f m", std::hypot(step.stdX, step.stdY)));
  }
  progress.finish();

  ReplayOutcome outcome;
  outcome.warnings = warningsOf(log);
  if (slips > 0)
    outcome.warnings.push_back(std::to_string(slips) + " updates in which the odometry was far off: first at " +
                               textOf("%.3f s", firstSlip) + "; the motion is that of a scan match");
  if (stop)
    outcome.incomplete = "interrupted: entry " + std::to_string(source.entry()) + " of " + run.rawlog +
                         "; the results cover the log up to there";
  else if (!log.defect.empty())
    outcome.incomplete = "log " + log.defect + ": entry " + std::to_string(log.entries + 1) + " of " +
                         run.rawlog + "; the results cover the log up to there";

  std::vector<mrpt::math::TPose2D> path = filter.view->bestPath();
  Trajectory trajectory = recorder.trajectory(path);
  auto grid = filter.view->bestGrid();
  auto lines = filter.view->bestLines();
  if (run.refine > 0) {
    RawlogSource scans(run.rawlog, configuration.input, log);
    std::vector<PosedScan> posed;
    for (size_t i = 0; i < trajectory.size(); ++i)
      posed.push_back({scans.next()->scan, trajectory[i].pose, isUpdate[i]});
    refine(posed, configuration.filter, run.refine);
    path.clear();
    for (size_t i = 0; i < posed.size(); ++i) {
      trajectory[i].pose = posed[i].pose;
      if (isUpdate[i]) path.push_back(posed[i].pose);
    }
    const ScanMap map = mapOf(posed, configuration.filter);
    grid = toMrpt(map.grid);
    lines = {map.lines.lines().begin(), map.lines.lines().end()};
  }
  folder.write("trajectory.tum", [&](std::ostream& out) { saveTum(trajectory, out); });
  savePicture(folder, grid, trajectory, lines);
  saveRosMap(folder, grid);
  saveGridMap(folder, grid);
  RawlogSource again(run.rawlog, configuration.input, log);
  saveSimpleMap(folder, again, isUpdate, path);
  saveLines(folder, lines);
  steps.finish();
  if (particles) particles->finish();
  folder.write("config.ini", [&](std::ostream& out) { out << configuration.text(); });

  const double wall = secondsSince(start);
  const char* const names[] = {"hybrid", "general", "stock"};
  const nlohmann::ordered_json metrics{
      {"method", names[static_cast<int>(run.method)]},
      {"particles", filter.view->particlePoses().size()},
      {"seed", configuration.filter.filter.seed},
      {"threads", configuration.filter.filter.threads},
      {"scans", isUpdate.size()},
      {"updates", path.size()},
      {"duration_s", log.duration},
      {"wall_s", wall},
      {"cpu_s", cpuSeconds()},
      {"realtime_factor", wall > 0 ? log.duration / wall : 0},
      {"peak_rss_mb", peakMegabytes()},
      {"resamplings", resamplings},
      {"slips", slips},
      {"lines", lines.size()},
      {"distance_m", recorder.distance()},
      {"versions", {{"hybrid_slam", version}, {"mrpt", mrpt::system::MRPT_getVersion()}}}};
  folder.write("metrics.json", [&](std::ostream& out) { out << metrics.dump(2) << '\n'; });

  outcome.summary = std::to_string(isUpdate.size()) + " scans, " + std::to_string(path.size()) +
                    " updates, " + textOf("%.0f m", recorder.distance()) + " in " + textOf("%.1f s", wall) +
                    textOf(" (%.0f times the log's pace): ", wall > 0 ? log.duration / wall : 0) +
                    folder.path("map.png");
  return outcome;
}

}  // namespace hybrid_slam
