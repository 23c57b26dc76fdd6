#include "slam/localization/PlanSearch.h"

#include <algorithm>
#include <cmath>

#include "base/Errors.h"
#include "slam/localization/PlanFit.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kScales[] = {1, 0.99, 1.01, 0.98, 1.02, 0.97, 1.03};  // the nearest to 1 first
constexpr double kCell = 0.1;                                          // m, coarser than the plan's error
constexpr double kMostCells = 1 << 25;
constexpr double kLeastLength = 1;      // m, of a line of the database
constexpr int kCount = 3;               // observations that a line of the plan counts as
constexpr size_t kLongestSearch = 100;  // scans; each takes a second in a large building
constexpr int8_t kFree = -32, kOccupied = 48;

/// The walls as occupied cells in a free rectangle.
OccupancyGrid gridOf(const std::vector<PlanLine>& walls, double scale) {
  OccupancyGrid grid(kCell);
  TPoint2D low = walls.front().start * scale, high = low;
  for (const PlanLine& wall : walls)
    for (const TPoint2D& p : {wall.start * scale, wall.end * scale}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  const double tile = kCell * Tile::kSize;  // memory is taken by tiles
  if (((high.x - low.x) / tile + 1) * ((high.y - low.y) / tile + 1) * Tile::kSize * Tile::kSize > kMostCells)
    throw InputError("floor plan too large", "option --prior-plan", "expected at most 0.3 km^2, in metres");
  const CellIndex first = grid.cellOf(low.x, low.y), last = grid.cellOf(high.x, high.y);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) grid.tiles().set({x, y}, kFree);
  for (const PlanLine& wall : walls) {
    const TPoint2D a = wall.start * scale, d = wall.end * scale - a;
    const int steps = static_cast<int>(d.norm() / kCell * 2) + 1;
    for (int i = 0; i <= steps; ++i) {
      const TPoint2D p = a + d * (static_cast<double>(i) / steps);
      grid.tiles().set(grid.cellOf(p.x, p.y), kOccupied);
    }
  }
  return grid;
}

LineDatabase linesOf(const std::vector<PlanLine>& walls, double scale, double window) {
  std::vector<DatabaseLine> lines;
  for (const PlanLine& wall : walls) {
    if ((wall.end - wall.start).norm() < kLeastLength) continue;
    DatabaseLine line;
    static_cast<LineSegment&>(line) = makeSegment(wall.start * scale, wall.end * scale);
    line.count = kCount;
    lines.push_back(line);
  }
  setDirections(lines, window);
  return LineDatabase(std::move(lines));
}

}  // namespace

PlanSearch::PlanSearch(const FilterConfiguration& configuration, std::vector<PlanLine> walls,
                       std::optional<TPose2D> start)
    : cell_(configuration.grid.resolution),
      directionWindow_(configuration.database.directionWindow),
      walls_(std::move(walls)) {
  const auto isLong = [](const PlanLine& wall) { return (wall.end - wall.start).norm() >= kLeastLength; };
  if (std::none_of(walls_.begin(), walls_.end(), isLong))
    throw InputError("floor plan without walls of 1 m", "option --prior-plan",
                     "expected coordinates in metres");
  for (const double scale : kScales) {
    if (start && scale != 1) continue;
    candidates_.push_back(
        {scale, std::make_unique<Localizer>(configuration, gridOf(walls_, scale), LineDatabase(), start)});
  }
}

bool PlanSearch::isOver() const { return found_ || scans_ >= kLongestSearch; }

void PlanSearch::process(const TPose2D& odometry, const Scans& scans) {
  if (isOver()) return;
  ++scans_;
  for (Candidate& candidate : candidates_) {
    candidate.localizer->process(odometry, scans);
    if (found_ || !candidate.localizer->isLocalized()) continue;
    const RecentScans& recent = candidate.localizer->recentScans();
    const TPose2D newest = candidate.localizer->bestPath().back() + (TPose2D() - recent.since());
    const PlanFit fit = fitPlan(recent.joined().endPoints(), walls_, {newest, candidate.scale});
    found_ = Found{fit.scale,
                   fit.pose + recent.since(),
                   {OccupancyGrid(cell_), linesOf(walls_, fit.scale, directionWindow_)}};
  }
}

}  // namespace hybrid_slam
