#include "slam/loops/LoopMatch.h"

#include <algorithm>
#include <cmath>

#include "base/PoseDistance.h"
#include "slam/grid/RaySamples.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr int kOccupied = 3, kFree = -3;                         // log-odds, in units of a cell
constexpr size_t kRefinedPlaces = 24;                            // maxima of the search that are refined
constexpr double kElsewhere = 0.6, kElsewhereAngle = M_PI / 36;  // m, rad: another place
constexpr size_t kMatchedBeams = 180;

struct Counts {
  size_t agreeing = 0, contradicting = 0;
};

/// The walls of a map on the cells of another one.
Counts compare(const ScanBeams& walls, const TPose2D& pose, const OccupancyGrid& grid) {
  const GridPose frame(pose, walls, grid.resolution());
  TileReader cells(grid.tiles());
  Counts counts;
  for (const ScanBeams::Ray& ray : walls.rays) {
    const double range = ray.range / grid.resolution();
    const int x = floorOf(frame.origin(ray).x + range * frame.dirX(ray)),
              y = floorOf(frame.origin(ray).y + range * frame.dirY(ray));
    int8_t highest = -128;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) highest = std::max(highest, cells.at(x + dx, y + dy));
    if (highest >= kOccupied)
      ++counts.agreeing;
    else if (cells.at(x, y) <= kFree)
      ++counts.contradicting;
  }
  return counts;
}

/// With the default [scan_matcher], whose sigma suits the cells of the local maps.
const ScanMatcher& matcher() {
  static const ScanMatcher matcher{ScanMatcherOptions()};
  return matcher;
}

LoopMatch matched(const TPose2D& start, const ScanBeams& some, const LocalMap& newer, const LocalMap& older) {
  LoopMatch result;
  result.pose = matcher().match(some, start, older.grid, noPrior).pose;
  result.agreement = agreementOf(newer, older, result.pose);
  return result;
}

bool isElsewhere(const TPose2D& a, const TPose2D& b) { return !isWithin(a, b, kElsewhere, kElsewhereAngle); }

}  // namespace

Agreement agreementOf(const LocalMap& newer, const LocalMap& older, const TPose2D& pose) {
  const Counts newOnOld = compare(newer.ends, pose, older.grid);
  const Counts oldOnNew = compare(older.ends, TPose2D() - pose, newer.grid);
  const size_t agreeing = newOnOld.agreeing + oldOnNew.agreeing;
  const size_t compared = agreeing + newOnOld.contradicting + oldOnNew.contradicting;
  if (compared == 0) return {};
  return {static_cast<double>(agreeing) / static_cast<double>(compared),
          static_cast<double>(newOnOld.agreeing + newOnOld.contradicting) /
              static_cast<double>(newer.ends.rays.size())};
}

Eigen::Matrix3d informationOf(const TPose2D& pose, const LocalMap& newer, const LocalMap& older) {
  const ScanBeams some = newer.ends.thinned(kMatchedBeams);
  ScanLikelihood likelihood = matcher().likelihood(some, older.grid);
  return scanInformation(likelihood, pose);
}

LoopMatch matchFrom(const TPose2D& start, const LocalMap& newer, const LocalMap& older) {
  return matched(start, newer.ends.thinned(kMatchedBeams), newer, older);
}

std::optional<LoopMatch> searchMatch(const TPose2D& centre, const SearchWindow& window, const LocalMap& newer,
                                     const LocalMap& older) {
  const ScanBeams some = newer.ends.thinned(kMatchedBeams);
  std::vector<LoopMatch> matches;
  for (const TPose2D& place : correlativeSearch(some, centre, older.grid, window, kRefinedPlaces))
    matches.push_back(matched(place, some, newer, older));
  const auto best = std::max_element(matches.begin(), matches.end(), [](const auto& a, const auto& b) {
    return a.agreement.score() < b.agreement.score();
  });
  if (best == matches.end() || best->agreement.score() <= 0) return std::nullopt;
  for (const LoopMatch& match : matches)
    if (isElsewhere(match.pose, best->pose))
      best->second = std::max(best->second, match.agreement.score() / best->agreement.score());
  return *best;
}

}  // namespace hybrid_slam
