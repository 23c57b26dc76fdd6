#include "run/MapRefinement.h"

#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

#include "base/DeskewedScan.h"
#include "base/Errors.h"
#include "base/Numbers.h"
#include "slam/filter/PathRelaxation.h"
#include "slam/filter/Refinement.h"
#include "slam/grid/GridConversion.h"
#include "slam/lines/WallDirections.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam::run {
namespace {

struct TooManyScans : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns about how much memory (bytes) the scans take. MRPT keeps range, intensity and validity of a beam.
double memoryOf(const Scans& scans) {
  double bytes = 0;
  for (const auto& scan : scans) {
    const bool isDeskewed = dynamic_cast<const DeskewedScan*>(scan.get()) != nullptr;
    bytes += 600 + (isDeskewed ? 21 : 9) * static_cast<double>(scan->getScanSize());
  }
  return bytes;
}

}  // namespace

const mrpt::maps::COccupancyGridMap2D& FinishedMap::gridOrThrow() const {
  if (!grid) throw std::bad_alloc();
  return *grid;
}

std::string MapRefinement::operator()(FinishedMap& best, const std::string& file,
                                      const readings::RawlogSummary& log) const {
  if (hasChanged(file, log)) return "the log has changed";
  if (log.scans < uses_.size()) return "the recording ends before the run";
  try {
    LogAgain again(file, configuration_.input, log);
    std::vector<PosedScans> scans = read(again, best.trajectory);
    if (!scans.empty()) best = refined(best, std::move(scans));
    return {};
  } catch (const UnreadableLog& e) {
    return e.what();
  } catch (const TooManyScans& e) {
    return e.what();
  } catch (const InputError& e) {  // the map is too large
    return messageOf(e);
  } catch (const std::bad_alloc&) {
    return "out of memory";
  }
}

/// @throws TooManyScans as soon as so much can be expected
std::vector<PosedScans> MapRefinement::read(LogAgain& log, const files::Trajectory& trajectory) const {
  std::vector<PosedScans> scans;
  double bytes = 0;
  for (const ReadingUse use : uses_) {
    const readings::Reading reading = log.next();
    if (use == ReadingUse::skipped) continue;
    scans.push_back({reading.scans, trajectory[scans.size()].pose, use == ReadingUse::update});
    bytes += memoryOf(reading.scans);
    const double expected =
        bytes * static_cast<double>(trajectory.size()) / static_cast<double>(scans.size());
    if (expected > mostBytes_)
      throw TooManyScans("the scans need " + fixedText(expected / 1e9, 1) + " GB, over " +
                         fixedText(mostBytes_ / 1e9, 1) + " GB");
  }
  return scans;
}

/// Changes path, `loops` and `isRelaxed` of `best`.
/// @param scans  of each update
void MapRefinement::closeLoops(FinishedMap& best, const std::vector<Scans>& scans) const {
  const FilterConfiguration& filter = configuration_.filter;
  const auto contradictionAlong = [&](const std::vector<mrpt::math::TPose2D>& path) {
    return contradictionOf(path, scans, filter.grid.maxRange);
  };
  double contradiction = contradictionAlong(best.path);
  std::vector<mrpt::math::TPose2D> closed = best.path;
  std::vector<LoopClosure> loops =
      hybrid_slam::closeLoops(closed, scans, directionModuloRightAngle(best.lines), filter);
  // A false loop puts walls into free space.
  if (const double after = loops.empty() ? INFINITY : contradictionAlong(closed); after < contradiction) {
    best.loops = std::move(loops);
    best.path = std::move(closed);
    contradiction = after;
  }
  // On a wrong map, returning scans may match the walls of other places.
  constexpr double kMoreContradiction = 0.02;  // of the compared beams
  std::vector<mrpt::math::TPose2D> even = relaxed(best.path, recorder_.motionsOfUpdates(), scans, filter);
  best.isRelaxed = contradictionAlong(even) <= contradiction + kMoreContradiction;
  if (best.isRelaxed) best.path = std::move(even);
}

FinishedMap MapRefinement::refined(FinishedMap best, std::vector<PosedScans> scans) const {
  const FilterConfiguration& filter = configuration_.filter;
  if (filter.closesLoops() && !base_) {
    std::vector<Scans> ofUpdates;
    for (const PosedScans& posed : scans)
      if (posed.isMapped) ofUpdates.push_back(posed.scans);
    closeLoops(best, ofUpdates);
    best.trajectory = recorder_.trajectory(best.path);
    for (size_t i = 0; i < scans.size(); ++i) scans[i].pose = best.trajectory[i].pose;
  }
  std::vector<MotionDistribution> odometry;
  for (const mrpt::math::TPose2D& motion : recorder_.motions())
    odometry.push_back(motionDistribution({}, motion, filter.motion));
  const mrpt::math::TPose2D start = scans.front().pose;
  refine(scans, configuration_.run.refine, filter, base_, odometry);
  // The first pose defines the frame of a new map.
  if (!base_) moveFirstTo(start, scans);
  for (size_t i = 0, update = 0; i < scans.size(); ++i) {
    best.trajectory[i].pose = scans[i].pose;
    if (scans[i].isMapped) best.path[update++] = scans[i].pose;
  }
  best.map = MapMaker(filter)(scans, base_);
  best.hasMap = true;
  best.grid = toMrpt(best.map.grid);
  best.lines = best.map.lines.lines();
  for (LoopClosure& loop : best.loops) loop.place = best.path[loop.later];
  return best;
}

}  // namespace hybrid_slam::run
