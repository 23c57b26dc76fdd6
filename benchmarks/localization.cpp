/// @file localization.cpp
/// @brief Measures how well Localizer tracks, finds and relocates a robot on logs with reference poses
/// (scripts/localization.sh).
///
///     hybrid-slam-localization track|find|carry MAP LOG REFERENCE MAP_REFERENCE [key=value...]
///
/// MAP is the result folder of a run of hybrid-slam. REFERENCE has the poses of the log, MAP_REFERENCE those
/// of the mapping run in the same frame; its rigid alignment with MAP/trajectory.tum puts the reference in
/// the frame of the map. Prints a row of CSV for each start and a row of a Markdown table.
#include <mrpt/core/bits_math.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/Trajectory.h"
#include "readings/RawlogSource.h"
#include "run/LogSettings.h"
#include "slam/filter/Threads.h"
#include "slam/grid/GridConversion.h"
#include "slam/lines/WallDirections.h"
#include "slam/localization/Localizer.h"
#include "study/evaluation/AbsoluteTrajectoryError.h"
#include "study/evaluation/StampIndex.h"

namespace hybrid_slam::bench {
namespace {

using mrpt::math::TPose2D;

constexpr double kTolerance = 0.02;                                // s, of time stamps
constexpr double kRight = 0.5, kRightAngle = mrpt::DEG2RAD(10.0);  // m, rad
constexpr double kSmall = 1;                                       // m, of the spread
constexpr double kGood = 0.1, kGoodAngle = mrpt::DEG2RAD(1.0);     // m, rad

struct Map {
  OccupancyGrid grid;
  LineDatabase lines;
};

Map readMap(const std::string& folder, bool hasLines) {
  mrpt::io::CFileGZInputStream file(folder + "/map.gridmap.gz");
  auto archive = mrpt::serialization::archiveFrom(file);
  mrpt::maps::COccupancyGridMap2D grid;
  archive >> grid;
  std::vector<DatabaseLine> lines;
  std::ifstream table(folder + "/lines.csv");
  std::string row;
  std::getline(table, row);
  while (hasLines && std::getline(table, row)) {
    double v[8];
    std::sscanf(row.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &v[0], &v[1], &v[2], &v[3], &v[4], &v[5],
                &v[6], &v[7]);
    lines.push_back({makeSegment(v[0], v[1], {v[3], v[4]}, {v[5], v[6]}), static_cast<int>(v[7]), 0, 0});
  }
  setDirections(lines, LineDatabaseOptions().directionWindow);
  return {fromMrpt(grid), LineDatabase(lines)};
}

/// A log with its reference poses in the frame of the map.
struct Log {
  std::vector<readings::Reading> readings;
  std::vector<TPose2D> reference;
  std::vector<double> driven;  ///< m
};

struct Study {
  Map map;
  run::Configuration configuration;
  Log log;
  std::string out;  ///< for the trajectory of `track`
  std::map<std::string, double> numbers{{"seed", 1},  {"count", 100}, {"from", 0},     {"jobs", 1},
                                        {"lines", 1}, {"most", 40},   {"held_out", 0}, {"only", -1}};
  double operator[](const char* key) const { return numbers.at(key); }
};

/// The pose of a scan without a reference pose, by odometry from its neighbours; empty for a scan that has
/// one.
std::optional<TPose2D> between(const std::vector<std::optional<TPose2D>>& known,
                               const std::vector<TPose2D>& odometry, size_t i) {
  if (known[i] || i == 0 || i + 1 >= known.size() || !known[i - 1] || !known[i + 1]) return std::nullopt;
  const TPose2D a = *known[i - 1] + (odometry[i] - odometry[i - 1]);
  const TPose2D b = *known[i + 1] + (odometry[i] - odometry[i + 1]);
  return TPose2D(0.5 * (a.x + b.x), 0.5 * (a.y + b.y), a.phi + 0.5 * mrpt::math::wrapToPi(b.phi - a.phi));
}

/// @param heldOut  uses only the scans without a reference pose: those that the mapping run left out
Log readLog(const std::string& file, const std::string& folder, const std::string& referenceFile,
            const std::string& mapReferenceFile, bool heldOut, run::Configuration& configuration) {
  const auto summary = readings::summarise(file, configuration.input);
  run::applyLogSettings(run::readLogSettings(file, configuration.input, summary), configuration);
  const files::Trajectory reference = files::loadTum(referenceFile);
  const TPose2D alignment = evaluation::rigidAlignment(evaluation::associate(
      files::loadTum(mapReferenceFile), files::loadTum(folder + "/trajectory.tum"), kTolerance));
  const evaluation::StampIndex index(reference);
  readings::RawlogSource source(file, configuration.input, summary);
  std::vector<readings::Reading> all;
  std::vector<std::optional<TPose2D>> known;
  std::vector<TPose2D> odometry{{}};
  while (auto reading = source.next()) {
    // Stamps may repeat and step back, rows of the same log do not.
    const auto row = reference.size() == summary.scans ? std::optional(all.size())
                                                       : index.nearest(reading->timestamp, kTolerance);
    known.push_back(row ? std::optional(alignment + reference[*row].pose) : std::nullopt);
    odometry.push_back(odometry.back() + reading->motion);
    all.push_back(std::move(*reading));
  }
  odometry.erase(odometry.begin());
  Log log;
  TPose2D motion;
  for (size_t i = 0; i < all.size(); ++i) {
    motion = motion + all[i].motion;
    const auto pose = heldOut ? between(known, odometry, i) : known[i];
    if (!pose) continue;
    all[i].motion = motion;
    log.readings.push_back(all[i]);
    log.reference.push_back(*pose);
    log.driven.push_back((log.driven.empty() ? 0 : log.driven.back()) + motion.norm());
    motion = {};
  }
  return log;
}

/// CPU time of this thread, s: other programs do not change it.
double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Error {
  double distance, angle;
  bool isRight() const { return distance < kRight && angle < kRightAngle; }
};

Error errorOf(const TPose2D& pose, const TPose2D& reference) {
  return {std::hypot(pose.x - reference.x, pose.y - reference.y),
          std::abs(mrpt::math::wrapToPi(pose.phi - reference.phi))};
}

/// The outcome of a trial that starts at one place of the log.
struct Trial {
  size_t start = 0;
  bool isFound = false, isRight = false, isRightAtEnd = false, wasLost = false;
  double distance = 0, time = 0;  ///< until found, m, s
  double lost = -1;               ///< until lost, m
  double error = 0, angle = 0;    ///< when found
  size_t updates = 0;
  size_t wrong = 0;   ///< updates with a small spread but far off, after the carrying was noticed
  size_t claims = 0;  ///< wrong places declared
  double seconds = 0, slowest = 0;
};

/// Follows the log from `start` for `most` metres, and for at least 5 m after the robot was found.
Trial follow(Localizer& localizer, const Log& log, size_t start, double most, bool mustLose) {
  Trial trial;
  trial.start = start;
  bool isFirst = true;
  for (size_t i = start; i < log.readings.size(); ++i) {
    const double driven = log.driven[i] - log.driven[start];
    if (driven > most || (trial.isFound && driven > trial.distance + 5)) break;
    const size_t before = localizer.updates();
    const double begin = threadSeconds();
    localizer.process(isFirst ? TPose2D() : log.readings[i].motion, log.readings[i].scans);
    const double took = threadSeconds() - begin;
    isFirst = false;
    if (localizer.updates() == before) continue;
    trial.seconds += took, trial.slowest = std::max(trial.slowest, took);
    ++trial.updates;
    const Error error = errorOf(localizer.bestPath().back(), log.reference[i]);
    const FilterStep& step = localizer.lastStep();
    if (!localizer.isLocalized()) {
      if (!trial.wasLost) trial.lost = driven;
      trial.wasLost = true;
    }
    const bool isSettled = trial.wasLost || !mustLose || error.isRight();
    if (isSettled && std::hypot(step.stdX, step.stdY) < kSmall && !error.isRight()) ++trial.wrong;
    if (localizer.isLocalized() && !trial.isFound && isSettled) {
      trial.isFound = true, trial.isRight = error.isRight();
      trial.distance = driven, trial.time = log.readings[i].timestamp - log.readings[start].timestamp;
      trial.error = error.distance, trial.angle = error.angle;
    }
    if (localizer.isLocalized() && !step.gridWeight && !error.isRight()) ++trial.claims;
    trial.isRightAtEnd = localizer.isLocalized() && error.isRight();
  }
  return trial;
}

/// A random place of the log with enough to drive after it.
size_t randomStart(const Study& study, RandomStream& random, double remaining) {
  const Log& log = study.log;
  for (;;) {
    const auto i = static_cast<size_t>(random.uniform() * static_cast<double>(log.readings.size()));
    if (static_cast<double>(i) >= study["from"] * static_cast<double>(log.readings.size()) &&
        log.driven.back() - log.driven[i] > remaining)
      return i;
  }
}

std::vector<Trial> study(const Study& s, bool isCarried) {
  std::vector<Trial> trials(static_cast<size_t>(s["count"]));
  tbb::task_arena arena(static_cast<int>(s["jobs"]));
  parallelFor(arena, 0, trials.size(), [&](size_t i) {
    if (s["only"] >= 0 && static_cast<size_t>(s["only"]) != i) return;
    RandomStream random(static_cast<uint64_t>(s["seed"]), i, isCarried);
    const size_t first = randomStart(s, random, 20);
    Localizer localizer(s.configuration.filter, s.map.grid, s.map.lines,
                        isCarried ? std::optional(s.log.reference[first]) : std::nullopt);
    if (isCarried) follow(localizer, s.log, first, 5, false);
    const size_t start = isCarried ? randomStart(s, random, 20) : first;
    trials[i] = follow(localizer, s.log, start, s["most"], isCarried);
  });
  return trials;
}

/// Returns whether the map shows what the robot sees at a reading.
bool isMapped(const Study& s, size_t reading) {
  const ScanBeams beams(toLaserScans(s.log.readings[reading].scans, s.configuration.filter.grid.maxRange));
  return isExplained(beamShares(beams, s.log.reference[reading], s.map.grid));
}

/// The smallest value that more than a share of all values do not exceed, or the largest; NaN without values.
double upperQuantile(std::vector<double> values, double q) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<size_t>(q * static_cast<double>(values.size())))];
}

void report(const Study& s, const std::vector<Trial>& trials) {
  std::printf(
      "start,x,y,found,right,right_at_end,distance_m,time_s,lost_m,error_m,error_deg,wrong_updates,"
      "wrong_claims,updates,"
      "mean_ms,slowest_ms\n");
  std::vector<double> distances, times;
  size_t right = 0, within = 0, mapped = 0, mappedWithin = 0, wrong = 0, claims = 0, updates = 0;
  double seconds = 0, slowest = 0;
  for (const Trial& t : trials) {
    const TPose2D at = s.log.reference[t.start];
    std::printf("%zu,%.1f,%.1f,%d,%d,%d,%.1f,%.1f,%.1f,%.3f,%.2f,%zu,%zu,%zu,%.1f,%.0f\n", t.start, at.x,
                at.y, t.isFound, t.isRight, t.isRightAtEnd, t.distance, t.time, t.lost, t.error,
                t.angle * 180 / M_PI, t.wrong, t.claims, t.updates,
                1000 * t.seconds / static_cast<double>(std::max<size_t>(1, t.updates)), 1000 * t.slowest);
    right += t.isRight && t.isFound, wrong += t.wrong > 0, claims += t.claims;
    const bool isWithin = t.isRight && t.isFound && t.distance <= 15, isInMap = isMapped(s, t.start);
    within += isWithin, mapped += isInMap, mappedWithin += isInMap && isWithin;
    distances.push_back(t.isFound && t.isRight ? t.distance : INFINITY);
    times.push_back(t.isFound && t.isRight ? t.time : INFINITY);
    seconds += t.seconds, updates += t.updates, slowest = std::max(slowest, t.slowest);
  }
  std::printf("| %zu | %zu | %zu of %zu | %zu | %zu | %zu | %.1f / %.1f | %.0f / %.0f | %.0f / %.0f |\n",
              trials.size(), within, mappedWithin, mapped, right, claims, wrong,
              upperQuantile(distances, 0.5), upperQuantile(distances, 0.95), upperQuantile(times, 0.5),
              upperQuantile(times, 0.95), 1000 * seconds / static_cast<double>(updates), 1000 * slowest);
}

/// Tracks from the start of the log, or from a given fraction of it.
void track(const Study& s) {
  const Log& log = s.log;
  const auto first = static_cast<size_t>(s["from"] * static_cast<double>(log.readings.size()));
  Localizer localizer(s.configuration.filter, s.map.grid, s.map.lines, log.reference[first]);
  std::vector<double> distances, angles;
  size_t good = 0, mapped = 0, mappedGood = 0, unknown = 0, lost = 0;
  bool wasLocalized = true;
  TPose2D since;
  files::Trajectory trajectory;
  double seconds = 0;
  for (size_t i = first; i < log.readings.size(); ++i) {
    const size_t before = localizer.updates();
    const TPose2D motion = i == first ? TPose2D() : log.readings[i].motion;
    const double begin = threadSeconds();
    localizer.process(motion, log.readings[i].scans);
    seconds += threadSeconds() - begin;
    since = localizer.updates() == before ? since + motion : TPose2D();
    const TPose2D pose = localizer.bestPath().back() + since;
    if (localizer.isLocalized()) trajectory.push_back({log.readings[i].timestamp, pose});
    const Error error = errorOf(pose, log.reference[i]);
    if (!localizer.isLocalized()) ++unknown;
    lost += wasLocalized && !localizer.isLocalized();
    wasLocalized = localizer.isLocalized();
    if (wasLocalized) distances.push_back(error.distance), angles.push_back(error.angle * 180 / M_PI);
    const bool isGood = wasLocalized && error.distance < kGood && error.angle < kGoodAngle,
               isInMap = isMapped(s, i);
    good += isGood, mapped += isInMap, mappedGood += isInMap && isGood;
  }
  if (std::ofstream file(s.out); !s.out.empty()) files::saveTum(trajectory, file);
  double squares = 0;
  for (const double distance : distances) squares += distance * distance;
  const auto scans = static_cast<double>(log.readings.size() - first);
  std::printf("| %.0f | %.3f | %.3f | %.3f | %.2f | %.1f %% | %.1f %% | %.1f %% | %zu | %.0f |\n", scans,
              std::sqrt(squares / static_cast<double>(distances.size())), upperQuantile(distances, 0.5),
              upperQuantile(distances, 0.99), upperQuantile(angles, 0.5),
              100 * static_cast<double>(good) / scans,
              100 * static_cast<double>(mappedGood) / static_cast<double>(mapped),
              100 * static_cast<double>(unknown) / scans, lost,
              (log.readings.back().timestamp - log.readings[first].timestamp) / seconds);
}

int run(int argc, char** argv) {
  if (argc < 6)
    throw InputError("too few arguments", "command line", "expected MODE MAP LOG REFERENCE MAP_REFERENCE");
  Study s;
  std::vector<std::string> settings;
  for (int i = 6; i < argc; ++i) {
    const std::string setting = argv[i];
    const size_t equals = setting.find('=');
    if (setting.rfind("out=", 0) == 0)
      s.out = setting.substr(4);
    else if (setting.find('.') < equals)
      settings.push_back(setting);
    else
      s.numbers.at(setting.substr(0, equals)) = std::stod(setting.substr(equals + 1));
  }
  s.configuration = run::Configuration("", settings);
  s.map = readMap(argv[2], s["lines"] > 0);
  s.log = readLog(argv[3], argv[2], argv[4], argv[5], s["held_out"] > 0, s.configuration);
  const std::string mode = argv[1];
  if (mode == "track")
    track(s);
  else
    report(s, study(s, mode == "carry"));
  return 0;
}

}  // namespace
}  // namespace hybrid_slam::bench

int main(int argc, char** argv) {
  try {
    return hybrid_slam::bench::run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << "error: " << e.what() << "\n";
    return 2;
  }
}
