#include "slam/filter/HybridFilter.h"

#include <cmath>

#include "base/PoseDistance.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;
using mrpt::system::CTimeLoggerEntry;

HybridFilter::HybridFilter(const FilterConfiguration& configuration)
    : interval_(configuration.updateInterval()),
      useGrid_(configuration.useGrid),
      closesLoops_(configuration.closesLoops()),
      keepsScans_(configuration.keepsScans()),
      resolution_(configuration.grid.resolution),
      maxRange_(configuration.grid.maxRange),
      prepare_(configuration),
      makeMap_(configuration),
      particles_(configuration, &profiler()),
      remembersScans_(keepsScans_),
      loopCloser_(configuration.loopClosing, configuration.grid),
      pathGrid_(configuration.grid) {
  checkMemory(configuration.grid, configuration.gridWeight);
  reset();
}

void HybridFilter::process(const TPose2D& odometry, const Scans& scans) {
  expectFinite(odometry);
  odometry_ = odometry_ + odometry;
  if (!scans.empty() && (!hasMap_ || interval_.isOver(odometry_))) update(scans);
}

// Fig. 1 from top to bottom: the factorisation of eq. (1), first the path (steps 1 to 3), then the maps given
// the path (step 4).
void HybridFilter::update(const Scans& scans) {
  CTimeLoggerEntry preparing(profiler(), "2 prepare scan, extract lines");
  const PreparedScan scan = prepare_(scans);  // line detection, Sec. III-B, eq. (2)-(6)
  preparing.stop();
  particles_.beginStep();
  if (hasMap_) {
    particles_.sampleAndWeigh(odometry_, scan);  // Sec. III-A, steps 1 and 2; w_line: III-D, eq. (9)
    particles_.resampleIfDue();                  // step 3
  } else {
    particles_.appendPose(odometry_);
  }
  CTimeLoggerEntry mapping(profiler(), "5 update maps");
  particles_.updateMaps(scan);  // step 4, map estimation: grids and line databases, Sec. III-C, eq. (7)-(8)
  mapping.stop();
  if (remembersScans_) updateScans_.push_back(scans);
  if (closesLoops_) closeLoops(scan);

  odometry_ = TPose2D();
  hasMap_ = true;
  ++updates_;
}

// Corrects path and maps where all particles agree on an inconsistent map. Not in the paper.
void HybridFilter::closeLoops(const PreparedScan& scan) {
  const CTimeLoggerEntry closing(profiler(), "6 close loops");
  const Particle& best = particles_.best();
  loopCloser_.add(best.path.lastMotion(), scan.scans, scan.lines,
                  particles_.lastStep().slipped.value_or(false));
  if (!loopCloser_.isDue()) return;
  const std::vector<TPose2D> before = bestPath();
  const auto closure =
      loopCloser_.close(before, best.lines->dominatingDirection(), base_ ? &base_->grid : nullptr);
  if (!closure) return;
  std::vector<TPose2D> path{best.path.poses().front()};
  if (base_) path.front() = closure->path.front() + (path.front() - before.front());
  path.insert(path.end(), closure->path.begin(), closure->path.end());
  continueFrom(path);
  particles_.setLoop(*closure);
}

// All particles continue from one path, including its start, and from the map of the remembered scans along
// it.
void HybridFilter::continueFrom(const std::vector<TPose2D>& path) {
  std::vector<PosedScans> all = known_;
  for (size_t i = 0; i < updateScans_.size(); ++i) all.push_back({updateScans_[i], path[i + 1], true});
  const ScanMap map = makeMap_(all, base_);
  particles_.continueFrom(path, map.grid, map.lines, map.features);
}

TPose2D HybridFilter::frameIn(const TPose2D& pose) const {
  return pose + (TPose2D() - (particles_.best().path.back() + odometry_));
}

std::vector<Revisit> HybridFilter::comparedWith(const OccupancyGrid& map, const TPose2D& pose) const {
  constexpr double kLast = 50;  // m of path: earlier poses may have drifted
  const TPose2D frame = frameIn(pose);
  const std::vector<TPose2D> path = bestPath();
  const std::vector<double> distances = lengthsAlong(path);
  RevisitCheck check(map);
  for (size_t i = 0; i < updateScans_.size(); ++i)
    if (distances[i] > distances.back() - kLast)
      check.add(frame + path[i], beamsToCompare(updateScans_[i], maxRange_), distances[i], i);
  return check.revisits();
}

double HybridFilter::joinMap(const ScanMap& map, const TPose2D& pose) {
  base_ = map;
  const TPose2D origin = frameIn(pose);
  std::vector<TPose2D> path = particles_.best().path.poses();
  for (TPose2D& at : path) at = origin + at;
  for (PosedScans& known : known_) known.pose = origin + known.pose;
  continueFrom(path);
  loopCloser_.joinMap(bestPath());
  expectNoMap();
  return origin.phi;
}

void HybridFilter::expectNoMap() {
  remembersScans_ = keepsScans_;
  if (!remembersScans_) updateScans_.clear();
}

void HybridFilter::reset() {
  loopCloser_.reset();
  base_.reset();
  known_.clear();
  updateScans_.clear();
  odometry_ = TPose2D();
  updates_ = 0;
  hasMap_ = false;
  particles_.reset(TPose2D());
}

void HybridFilter::insertAt(const TPose2D& pose, const Scans& scans) {
  particles_.appendPose(pose - particles_.best().path.back());
  particles_.beginStep();
  particles_.updateMaps(prepare_(scans));
  if (remembersScans_) known_.push_back({scans, pose, true});
  hasMap_ = true;
}

std::vector<TPose2D> HybridFilter::bestPath() const {
  std::vector<TPose2D> poses = particles_.best().path.poses();
  poses.erase(poses.begin());  // where the robot was before its first scan
  return poses;
}

const OccupancyGrid& HybridFilter::bestOccupancy() const {
  return useGrid_ ? particles_.best().grid : pathGrid_.of(bestPath(), updateScans_);
}

mrpt::maps::COccupancyGridMap2D HybridFilter::bestGrid() const { return toMrpt(bestOccupancy()); }

std::vector<DatabaseLine> HybridFilter::bestLines() const {
  const auto& lines = particles_.best().lines->lines();
  return {lines.begin(), lines.end()};
}

}  // namespace hybrid_slam
