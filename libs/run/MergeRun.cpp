#include "run/MergeRun.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/system/os.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/Clock.h"
#include "base/Numbers.h"
#include "files/StagedFolder.h"
#include "run/JsonText.h"
#include "run/KnownMap.h"
#include "run/MapFiles.h"
#include "run/MapPartFile.h"
#include "run/ResultFiles.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPose2D;

/// Returns the configuration of the first map that has one; else the defaults, with the cell size of the
/// older map.
/// @throws InputError for a cell size that no run can have
Configuration configurationOf(const MapPartFile& older, const std::string& olderName,
                              const MapPartFile& newer) {
  Configuration configuration;
  for (const MapPartFile* file : {&newer, &older})
    if (file->configuration) configuration = *file->configuration;
  if (older.configuration && newer.configuration)
    configuration.filter.grid.maxRange =
        std::max(older.configuration->filter.grid.maxRange, newer.configuration->filter.grid.maxRange);
  const double cell = older.part.map.grid.resolution();
  Configuration().load("[grid]\nresolution = " + numberText(cell), olderName);
  configuration.filter.grid.resolution = cell;
  return configuration;
}

double toFourDigits(double value) { return std::round(1e4 * value) / 1e4; }

nlohmann::ordered_json json(const MapPlacement& placement, const TPose2D& frame) {
  return {{"x_m", toFourDigits(frame.x)},
          {"y_m", toFourDigits(frame.y)},
          {"phi_deg", toFourDigits(mrpt::RAD2DEG(mrpt::math::wrapToPi(frame.phi)))},
          {"fit", toFourDigits(placement.agreement.fit)},
          {"overlap", toFourDigits(placement.agreement.overlap)},
          {"compared_walls_m", toFourDigits(placement.compared)},
          {"second", toFourDigits(placement.second)},
          {"patches", placement.patches.size()},
          {"patch_fit", toFourDigits(placement.patchFit)}};
}

std::string figures(const MapPlacement& placement) {
  const auto percent = [](double share) { return fixedText(100 * share, 0) + " %"; };
  return percent(placement.agreement.fit) + " of " + fixedText(placement.compared, 0) +
         " m of compared walls agree (" + percent(placement.agreement.overlap) + " of B's), " +
         std::to_string(placement.patches.size()) + " patches fit by " + percent(placement.patchFit) +
         ", the best place elsewhere scores " + percent(placement.second);
}

files::Trajectory trajectoryOf(const MapPartFile& file, const std::vector<TPose2D>& path) {
  files::Trajectory trajectory;
  if (!file.times.empty())
    for (size_t i = 0; i < path.size(); ++i) trajectory.push_back({file.times.at(i), path[i]});
  return trajectory;
}

}  // namespace

MergeOutcome merge(const MergeOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const MapPartFile older = readMapPart(options.older), newer = readMapPart(options.newer);
  Configuration configuration = configurationOf(older, options.older, newer);
  configuration.filter.filter.threads = options.threads;
  const MapPlacement placement = placementOf(newer.part.map, older.part.map, options.threads);
  MergeOutcome outcome;
  if (!placement.isFound()) {
    outcome.summary = std::string(placement.hasEvidence() ? "ambiguous: the maps fit in several places"
                                                          : "no overlap found") +
                      ": " + figures(placement);
    return outcome;
  }
  files::StagedFolder staged(options.output, kResultFiles, options.overwrite);
  for (const std::string& map : {options.older, options.newer}) staged.expectKept(filesOfMap(map));
  const files::OutputFolder& folder = staged.files();
  MergedMap merged = hybrid_slam::merged(older.part, newer.part, placement, configuration.filter);

  files::Trajectory trajectory = trajectoryOf(older, merged.older);
  for (const files::StampedPose& pose : trajectoryOf(newer, merged.newer)) trajectory.push_back(pose);
  const auto grid = toMrpt(merged.map.grid);
  const std::vector<DatabaseLine>& lines = merged.map.lines.lines();
  if (!trajectory.empty())
    folder.write("trajectory.tum", [&](std::ostream& out) { files::saveTum(trajectory, out); });
  savePicture(folder, grid, trajectory, lines);
  saveRosMap(folder, grid, trajectory);
  saveGridMap(folder, grid);
  saveLines(folder, lines);
  folder.write("config.ini", [&](std::ostream& out) { out << configuration.text(); });

  SessionHeader header{HYBRID_SLAM_VERSION, configuration.text(), merged.map, merged.older, older.times};
  header.times.insert(header.times.end(), newer.times.begin(), newer.times.end());
  header.path.insert(header.path.end(), merged.newer.begin(), merged.newer.end());
  std::string bytes;
  StateWriter out(bytes);
  writeHeader(out, header);
  saveSession(folder.path(kSessionName), bytes);

  nlohmann::ordered_json metrics = json(placement, merged.frame);
  metrics.update(nlohmann::ordered_json{
      {"older", options.older},
      {"newer", options.newer},
      {"updates", header.path.size()},
      {"lines", lines.size()},
      {"wall_s", secondsSince(start)},
      {"versions", {{"hybrid_slam", HYBRID_SLAM_VERSION}, {"mrpt", mrpt::system::MRPT_getVersion()}}}});
  folder.write("metrics.json", [&](std::ostream& file) { file << jsonText(metrics); });
  staged.publish();
  outcome.isMerged = true;
  outcome.note = staged.note();
  outcome.summary = "B's origin in A: (" + fixedText(merged.frame.x, 2) + ", " +
                    fixedText(merged.frame.y, 2) + ") m, " +
                    fixedText(mrpt::RAD2DEG(mrpt::math::wrapToPi(merged.frame.phi)), 1) +
                    " deg: " + figures(placement) + ": " + staged.finalPath("map.png");
  return outcome;
}

}  // namespace hybrid_slam::run
