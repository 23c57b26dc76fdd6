#include "slam/localization/PlanSearch.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Errors.h"
#include "slam/filter/Threads.h"
#include "slam/grid/CorrelativeSearch.h"
#include "slam/lines/WallDirections.h"
#include "slam/localization/GlobalLocalization.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kScales[] = {1, 0.98, 1.02};       // between them the fit finds the scale
constexpr double kCell = 0.1;                       // m, coarser than the plan's error
constexpr double kMostCells = 1 << 25;              // memory
constexpr double kMostSearchedCells = 1 << 23;      // about 2 s for a search
constexpr double kLeastLength = 1;                  // m, of a line of the database
constexpr int kLeastCount = 3;                      // observations that a line of the plan counts as
constexpr size_t kNearStart = 8;                    // places there
constexpr size_t kLongestSearch = 240;              // scans, 0.5 m or 20 deg apart
constexpr size_t kSearchedScans = 80;               // of these that are searched for together
constexpr size_t kEvery = 4;                        // of these to the next search
constexpr size_t kFitted = 40;                      // places, best of all scales
constexpr double kLeastScores[] = {0.6, 0.4, 0.2};  // of a place; lowered until there are kFitted
constexpr double kFarthestWall = 1000;              // m from the origin: a scale off by 0.1 % moves it by 1 m
// The robot is found at a place if, in two searches in succession,
constexpr double kLeastShare = 0.65;  // of the points lie on walls,
constexpr double kPlanMargin = 4;     // and more than at any other place, by these standard deviations;
constexpr double kPlanElsewhere = 1,
                 kPlanElsewhereAngle = 10 * kDegree;  // m, rad: places further apart are two
constexpr int8_t kFree = -32, kOccupied = 48;

/// Draws the walls as occupied cells in a free rectangle.
OccupancyGrid gridOf(const std::vector<PlanLine>& walls, double scale, bool isSearched) {
  OccupancyGrid grid(kCell);
  TPoint2D low = walls.front().start * scale, high = low;
  for (const PlanLine& wall : walls)
    for (const TPoint2D& p : {wall.start * scale, wall.end * scale}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  const double tile = kCell * Tile::kSize;  // memory is taken by tiles
  if (((high.x - low.x) / tile + 1) * ((high.y - low.y) / tile + 1) * Tile::kSize * Tile::kSize >
      (isSearched ? kMostSearchedCells : kMostCells))
    throw InputError("floor plan too large", "option --prior-plan",
                     isSearched ? "expected at most 0.08 km^2, in metres; up to 0.3 km^2 with --start X,Y,DEG"
                                : "expected at most 0.3 km^2, in metres");
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

/// Returns the walls as lines that pruning keeps.
LineDatabase linesOf(const std::vector<PlanLine>& walls, double scale, const LineDatabaseOptions& options) {
  std::vector<DatabaseLine> lines;
  for (const PlanLine& wall : walls) {
    if ((wall.end - wall.start).norm() < kLeastLength) continue;
    DatabaseLine line;
    static_cast<LineSegment&>(line) = makeSegment(wall.start * scale, wall.end * scale);
    line.count = std::max(kLeastCount, options.minCount);
    lines.push_back(line);
  }
  setDirections(lines, options.directionWindow);
  return LineDatabase(std::move(lines));
}

/// Returns the points as beams of one laser at the origin.
ScanBeams beamsTo(const std::vector<TPoint2D>& points) {
  ScanBeams beams;
  beams.origins.emplace_back();
  for (const TPoint2D& p : points)
    if (const double range = p.norm(); range > 0) beams.rays.push_back({p.x / range, p.y / range, range, 0});
  return beams;
}

bool isElsewhere(const PlanFit& a, const PlanFit& b) {
  return std::hypot(a.pose.x / a.scale - b.pose.x / b.scale, a.pose.y / a.scale - b.pose.y / b.scale) >
             kPlanElsewhere ||
         std::abs(mrpt::math::wrapToPi(a.pose.phi - b.pose.phi)) > kPlanElsewhereAngle;
}

/// Returns by how many standard deviations more points lie on walls at `a` than at `b`: McNemar's test, with
/// the points that lie on no wall at both places as further noise.
double advantage(const PlanFit& a, const PlanFit& b) {
  int difference = 0, informative = 0;
  for (size_t i = 0; i < a.isOnWall.size(); ++i) {
    difference += a.isOnWall[i] - b.isOnWall[i];
    informative += !(a.isOnWall[i] && b.isOnWall[i]);
  }
  return difference / std::sqrt(std::max(1, informative));
}

}  // namespace

PlanSearch::PlanSearch(const FilterConfiguration& configuration, std::vector<PlanLine> walls,
                       std::optional<TPose2D> start)
    : cell_(configuration.grid.resolution),
      database_(configuration.database),
      walls_(std::move(walls)),
      start_(start),
      prepare_(configuration),
      recent_(configuration, kSearchedScans),
      arena_(arenaThreads(configuration.filter.threads)) {
  const auto isLong = [](const PlanLine& wall) { return (wall.end - wall.start).norm() >= kLeastLength; };
  if (std::none_of(walls_.begin(), walls_.end(), isLong))
    throw InputError("floor plan without walls of 1 m", "option --prior-plan",
                     "expected coordinates in metres");
  for (const PlanLine& wall : walls_)
    if (std::max(wall.start.norm(), wall.end.norm()) > kFarthestWall)
      throw InputError("floor plan far from its origin", "option --prior-plan",
                       "expected coordinates within 1 km of (0, 0), in metres: its scale is unknown");
  if (configuration.filter.isAuxiliary())
    throw InputError("MRPT's auxiliary filters do not take a floor plan",
                     "section [particle_filter], key `proposal`", "expected improved or standard");
  if (start_) {
    grid_ = gridOf(walls_, 1, false);
    return;
  }
  lines_ = linesOf(walls_, 1, database_);
  for (const double scale : kScales) {
    const OccupancyGrid grid = gridOf(walls_, scale, true);
    plans_.push_back({scale, GlobalSearch(grid, grid.middle())});
  }
}

// Only scans of a moving robot count, so that the limit does not depend on the rate of the laser.
bool PlanSearch::isOver() const { return found_ || added_ >= kLongestSearch; }

void PlanSearch::process(const TPose2D& odometry, const Scans& scans) {
  if (isOver()) return;
  odometry_ = odometry_ + odometry;
  if (start_) start_ = *start_ + odometry;
  if (scans.empty()) return;
  if (!recent_.add(std::exchange(odometry_, {}), prepare_(scans))) return;
  ++added_;
  if (start_) {
    if (recent_.scans().back().scan.matchedBeams.rays.empty()) return;
    if (const PlanFit fit = fitAtStart(); fit.share() >= kLeastShare) accept(fit);
    return;
  }
  if (added_ % kEvery != 0) return;
  const TPose2D now = recent_.scans().back().pose;
  const std::optional<PlanFit> fit = fitAnywhere();
  if (fit && last_ && !isElsewhere(*fit, {last_->pose + (now - at_), last_->scale})) accept(*fit);
  last_ = fit, at_ = now;
}

void PlanSearch::accept(const PlanFit& fit) {
  found_ = Found{fit.scale, fit.pose, {OccupancyGrid(cell_), linesOf(walls_, fit.scale, database_)}};
}

PlanFit PlanSearch::fitAtStart() const {
  const ScanBeams& scan = recent_.scans().back().scan.matchedBeams;
  std::vector<TPose2D> places = correlativeSearch(scan, *start_, grid_, kStartWindow, kNearStart);
  places.push_back(*start_);
  PlanFit best;
  for (const TPose2D& place : places)
    if (PlanFit fit = fitPlan(scan.endPoints(), walls_, {place});
        best.isOnWall.empty() || fit.share() > best.share())
      best = fit;
  return best;
}

std::optional<PlanFit> PlanSearch::fitAnywhere() {
  const std::vector<TPoint2D> points = thinned(recent_.endPoints());
  const ScanBeams beams = beamsTo(points);
  const std::vector<double> headings = alignedHeadings(recent_.lines(), lines_);
  struct Candidate {
    double score;
    PlanFit fit;
  };
  std::vector<Candidate> places;
  for (const double least : kLeastScores) {  // a lower one adds only worse places, and takes longer
    std::vector<std::vector<GlobalSearch::Place>> found(plans_.size());
    parallelFor(arena_, 0, plans_.size(),
                [&](size_t i) { found[i] = plans_[i].search(beams, headings, kFitted, least); });
    places.clear();
    for (size_t i = 0; i < plans_.size(); ++i)
      for (const auto& place : found[i]) places.push_back({place.score, {place.pose, plans_[i].scale}});
    if (places.size() >= kFitted) break;
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  places.resize(std::min(places.size(), kFitted));
  parallelFor(arena_, 0, places.size(),
              [&](size_t i) { places[i].fit = fitPlan(points, walls_, places[i].fit); });
  const PlanFit* best = nullptr;
  for (const Candidate& place : places)
    if (!best || place.fit.share() > best->share()) best = &place.fit;
  if (!best || best->share() < kLeastShare) return std::nullopt;
  for (const Candidate& place : places)
    if (isElsewhere(place.fit, *best) && advantage(*best, place.fit) < kPlanMargin) return std::nullopt;
  return *best;
}

}  // namespace hybrid_slam
