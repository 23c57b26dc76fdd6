#include "slam/loops/RevisitCheck.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/PoseDistance.h"
#include "slam/grid/NarrowThings.h"
#include "slam/grid/RaySamples.h"
#include "slam/grid/ScanBeams.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr size_t kComparedBeams = 90;
constexpr int kWall = 6, kSolidWall = 12, kSeenFree = -1;  // log-odds, in units of a cell: 1, 2 hits; 1 miss
constexpr double kNear = 3, kShort = 4;  // cells at both ends of a beam that may touch its own wall
constexpr double kFewestShare = 0.1;

// Of a correction: true loops add up to 0.002 to the share, false ones 0.005 or more (Intel, 12 simulated
// offices).
constexpr size_t kFewestReturning = 20;  // scans
constexpr double kWorse = 0.0035;

enum class Finding { unknown, agrees, crossesWall, endsInFreeSpace };

Finding compare(const ScanBeams::Ray& ray, const GridPose& frame, TileReader& cells) {
  const double range = ray.range / RevisitCheck::kResolution, dx = frame.dirX(ray), dy = frame.dirY(ray);
  const auto& origin = frame.origin(ray);
  for (double along = kNear; along < range - kShort; along += 1)
    if (cells.at(floorOf(origin.x + along * dx), floorOf(origin.y + along * dy)) >= kSolidWall)
      return Finding::crossesWall;
  const int x = floorOf(origin.x + range * dx), y = floorOf(origin.y + range * dy);
  int8_t highest = -128;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) highest = std::max(highest, cells.at(x + i, y + j));
  if (highest >= kWall) return Finding::agrees;
  // A wall seen at a grazing angle has free cells: beams that end further along it pass through them.
  return highest <= kSeenFree ? Finding::endsInFreeSpace : Finding::unknown;
}

/// The revisits of those scans that are also among the others.
std::vector<Revisit> common(const std::vector<Revisit>& revisits, const std::vector<Revisit>& others) {
  std::vector<Revisit> both;
  std::set_intersection(revisits.begin(), revisits.end(), others.begin(), others.end(),
                        std::back_inserter(both),
                        [](const Revisit& a, const Revisit& b) { return a.update < b.update; });
  return both;
}

}  // namespace

RevisitCheck::RevisitCheck(const OccupancyGrid& map) : delay_(INFINITY), grid_(map) {}

void RevisitCheck::add(const TPose2D& pose, const ScanBeams& beams, double distance, size_t update) {
  if (!isInReach(pose)) return;
  GridOptions options = hitsAlone({});  // what the scans have measured
  options.resolution = kResolution;
  for (; !waiting_.empty() && waiting_.front().distance < distance - delay_; waiting_.pop_front())
    grid_.insert(waiting_.front().beams, waiting_.front().pose, options);

  ++scans_, beams_ += beams.rays.size();
  const GridPose frame(pose, beams, kResolution);
  TileReader cells(grid_.tiles());
  Revisit revisit{pose, update, distance};
  std::vector<bool> isNarrow;  // most scans of a right map need none
  for (size_t i = 0; i < beams.rays.size(); ++i) {
    const Finding finding = compare(beams.rays[i], frame, cells);
    revisit.compared += finding != Finding::unknown;
    revisit.contradicted += finding == Finding::crossesWall || finding == Finding::endsInFreeSpace;
    if (finding != Finding::endsInFreeSpace) continue;
    if (isNarrow.empty()) isNarrow = endsAtNarrowThing(beams);
    revisit.narrow += isNarrow[i];
  }
  if (revisit.compared >= Revisit::kFewest &&
      static_cast<double>(revisit.compared) >= kFewestShare * static_cast<double>(beams.rays.size()))
    revisits_.push_back(revisit);
  if (std::isfinite(delay_)) waiting_.push_back({pose, beams, distance});
}

std::vector<Revisit> withoutNarrowThings(std::vector<Revisit> revisits) {
  for (Revisit& revisit : revisits) {
    revisit.compared -= revisit.narrow, revisit.contradicted -= revisit.narrow, revisit.narrow = 0;
    if (revisit.compared < Revisit::kFewest) revisit.contradicted = 0;
  }
  return revisits;
}

size_t contradictedOf(const std::vector<Revisit>& revisits) {
  return static_cast<size_t>(std::count_if(revisits.begin(), revisits.end(),
                                           [](const Revisit& revisit) { return revisit.isContradicted(); }));
}

double contradictionOf(const std::vector<Revisit>& revisits) {
  double compared = 0, contradicted = 0;
  for (const Revisit& revisit : revisits) {
    compared += static_cast<double>(revisit.compared);
    contradicted += static_cast<double>(revisit.contradicted);
  }
  return compared > 0 ? contradicted / compared : 0;
}

bool isMoreContradicted(const std::vector<Revisit>& before, const std::vector<Revisit>& after) {
  if (contradictionOf(after) <= contradictionOf(before)) return false;
  const std::vector<Revisit> still = common(after, before);
  return still.size() >= kFewestReturning &&
         contradictionOf(still) > contradictionOf(common(before, after)) + kWorse;
}

double contradictionOf(const std::vector<TPose2D>& path, const std::vector<Scans>& scans, double maxRange) {
  RevisitCheck check(RevisitCheck::kReturn);
  const std::vector<double> distances = lengthsAlong(path);
  for (size_t i = 0; i < std::min(path.size(), scans.size()); ++i)
    check.add(path[i], beamsToCompare(scans[i], maxRange), distances[i], i);
  return contradictionOf(check.revisits());
}

ScanBeams beamsToCompare(const LaserScans& scans) { return ScanBeams(scans).thinned(kComparedBeams); }

ScanBeams beamsToCompare(const Scans& scans, double maxRange) {
  return beamsToCompare(toLaserScans(scans, RevisitCheck::rangeOf(maxRange)));
}

}  // namespace hybrid_slam
