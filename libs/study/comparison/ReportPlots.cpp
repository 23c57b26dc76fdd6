#include "study/comparison/ReportPlots.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "files/GridMapReader.h"
#include "study/comparison/ParticlePlot.h"
#include "study/comparison/PlanPlots.h"
#include "study/comparison/Plots.h"
#include "study/comparison/RankedRuns.h"
#include "study/comparison/ReportText.h"
#include "study/comparison/WallErrors.h"

namespace hybrid_slam::comparison {
namespace {

const simulation::BuildingPlan* planOf(const ReportInput& input) {
  return input.truth.plan ? &*input.truth.plan : nullptr;
}

files::Trajectory trajectoryOf(const RunFolder& folder) {
  return files::loadTum(folder.file("trajectory.tum").string());
}

}  // namespace

std::vector<Plot> spreadPlots(const ReportInput& input) {
  constexpr size_t kTimes = 200;
  std::vector<SpreadBands> bands;
  for (size_t g = 0; g < input.groups.size(); ++g) {
    std::vector<std::vector<SpreadStep>> runs;
    for (const RunResult* r : finishedRuns(input, g))
      runs.push_back(loadSpread(folderOf(input, *r).file("steps.csv").string()));
    bands.push_back(spreadBands(runs, kTimes));
  }
  std::vector<Plot> all;
  for (size_t s = 0; s < kSpreads; ++s) all.push_back(plotSpread(s, input.groups, bands));
  return all;
}

std::vector<Plot> trajectoryPlots(const ReportInput& input) {
  const std::vector<int> colours = plotColours(input.groups);
  std::vector<Plot> all;
  for (size_t g = 0; g < input.groups.size(); ++g) {
    std::vector<files::Trajectory> trajectories;
    for (const RunResult* r : finishedRuns(input, g)) {
      trajectories.push_back(trajectoryOf(folderOf(input, *r)));
      const auto alignment = alignmentOf(input, trajectories.back());
      for (files::StampedPose& p : trajectories.back()) p.pose = alignment + p.pose;
    }
    if (!trajectories.empty())
      all.push_back(plotTrajectories(input.groups[g].name(), colours[g], trajectories, input.truth.reference,
                                     planOf(input)));
  }
  return all;
}

std::vector<Plot> wallPlots(const ReportInput& input) {
  std::vector<Plot> all;
  for (size_t g = 0; planOf(input) && g < input.groups.size(); ++g) {
    const RunResult* median = medianRun(input, g);
    if (!median) continue;
    const RunFolder folder = folderOf(input, *median);
    const auto map = files::readGridMap(folder.file("map.gridmap.gz").string());
    auto cells = occupiedCells(map);
    const auto alignment = alignmentOf(input, trajectoryOf(folder));
    for (auto& cell : cells) cell = alignment.composePoint(cell);
    all.push_back(plotCellsOverWalls(
        cells, map.getResolution(), *planOf(input),
        input.groups[g].name() + ": mean " + shortNumber((*median)[Figure::wallMean].value_or(0), 2) +
            " m, 95 % below " + shortNumber((*median)[Figure::wallP95].value_or(0), 2) + " m"));
  }
  return all;
}

std::vector<std::vector<Plot>> particlePlots(const ReportInput& input) {
  constexpr size_t kMoments = 4;
  struct Shown {
    std::string name;
    std::vector<ParticleSnapshot> run;
    mrpt::math::TPose2D alignment;
  };
  std::vector<Shown> shown;
  for (size_t g = 0; g < input.groups.size(); ++g) {
    const RunResult* median = medianRun(input, g);
    if (!median) continue;
    const RunFolder folder = folderOf(input, *median);
    std::vector<ParticleSnapshot> snapshots;
    try {
      snapshots = loadParticles(folder.file("particles.csv").string());
    } catch (const std::runtime_error&) {  // the table is damaged
      continue;
    }
    if (!snapshots.empty())
      shown.push_back(
          {input.groups[g].name(), std::move(snapshots), alignmentOf(input, trajectoryOf(folder))});
  }
  if (shown.empty()) return {};
  const double start = shown[0].run[0].timestamp;
  const std::vector<double> moments = turningMoments(shown[0].run, kMoments);
  double farthest = 0;  // m, of any particle from its robot
  for (const Shown& s : shown)
    for (const double moment : moments)
      farthest = std::max(farthest, nearestSnapshot(s.run, moment).radius());
  std::vector<std::vector<Plot>> rows;
  for (const Shown& s : shown) {
    rows.emplace_back();
    for (const double moment : moments)
      rows.back().push_back(plotParticles(
          nearestSnapshot(s.run, moment), s.alignment, planOf(input), std::max(0.2, 2.5 * farthest),
          s.name + ", " + shortNumber(std::round(10 * (moment - start)) / 10) + " s"));
  }
  return rows;
}

}  // namespace hybrid_slam::comparison
