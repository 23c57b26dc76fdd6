#include "run/FinishedPath.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/LineReader.h"
#include "readings/LogWarnings.h"
#include "readings/RawlogSource.h"
#include "run/Configuration.h"
#include "run/JsonFile.h"
#include "run/VerdictCheck.h"

namespace hybrid_slam::run {

using mrpt::math::TPose2D;

namespace {

constexpr double kSameTime = 1e-6;  // s; files have six decimals

/// Reads the first column of steps.csv.
std::vector<double> updateTimes(const std::string& file) {
  files::LineReader reader(file);
  std::vector<double> times;
  std::string line;
  for (reader.next(line); reader.next(line);) {
    const auto time = parseFinite(line.substr(0, line.find(',')));
    if (!time)
      throw InputError("broken line", "file `" + file + "`, line " + std::to_string(reader.number()),
                       "expected a row of steps.csv");
    times.push_back(*time);
  }
  return times;
}

/// Reads whether the errors of the path were distributed over its loops.
bool isRelaxed(const std::string& file) {
  const auto metrics = readJson(file);
  if (!metrics.is_object() || !metrics.contains("path_relaxed") || !metrics["path_relaxed"].is_boolean())
    throw InputError("no key `path_relaxed`", file, "expected the metrics of a run of this version");
  return metrics["path_relaxed"];
}

}  // namespace

PathPoint FinishedPath::at(const TPose2D& pose, size_t row) const {
  return {std::max<size_t>(updates[row], 1) - 1, pose};
}

FinishedPath readFinishedPath(const std::string& folder, const std::string& log,
                              const readings::WarningReport& report) {
  const Configuration configuration(folder + "/config.ini", {"run.rawlog=" + log});
  const files::Trajectory trajectory = files::loadTum(folder + "/trajectory.tum");
  const std::vector<double> times = updateTimes(folder + "/steps.csv");
  std::vector<TPose2D> path;
  std::vector<size_t> updates;
  for (const files::StampedPose& row : trajectory) {
    if (path.size() < times.size() && std::abs(row.timestamp - times[path.size()]) < kSameTime)
      path.push_back(row.pose);
    updates.push_back(path.size());
  }
  // The first of several rows of one time may not be that of the update. A few such times do no harm.
  constexpr double kMostShared = 0.1;
  size_t shared = 0;
  for (size_t i = 1; i < trajectory.size(); ++i)
    shared += updates[i - 1] > (i > 1 ? updates[i - 2] : 0) &&
              std::abs(trajectory[i].timestamp - trajectory[i - 1].timestamp) < kSameTime;
  if (static_cast<double>(shared) > kMostShared * static_cast<double>(times.size()))
    throw InputError(counted(shared, "update(s) share the time of another scan"), folder + "/trajectory.tum",
                     "expected a log whose timestamps tell its scans apart");
  if (path.empty() || path.size() < times.size())
    throw InputError("the updates are not those of the trajectory", folder + "/steps.csv",
                     "expected the files of one run");

  const readings::RawlogSummary summary = readings::summarise(log, configuration.input);
  if (report) report(readings::warningsOf(summary, log));
  readings::RawlogSource source(log, configuration.input, summary);
  VerdictCheck check(configuration.filter.grid.maxRange);
  size_t row = 0;
  while (const auto reading = source.next()) {
    if (row == trajectory.size() || std::abs(reading->timestamp - trajectory[row].timestamp) >= kSameTime)
      continue;  // the run skipped it
    if (updates[row] > (row > 0 ? updates[row - 1] : 0)) check.add(trajectory[row].pose, reading->scans);
    ++row;
  }
  if (row < trajectory.size())
    throw InputError("the log is not that of the run", log,
                     "expected a scan at each time of " + folder + "/trajectory.tum");
  return {trajectory, updates,
          PathCovariances(path, {}, check.evidence().returning, configuration.filter.useLines,
                          isRelaxed(folder + "/metrics.json"))};
}

}  // namespace hybrid_slam::run
