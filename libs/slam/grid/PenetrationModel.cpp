#include "slam/grid/PenetrationModel.h"

#include <algorithm>
#include <cmath>

#include "slam/grid/RaySamples.h"

namespace hybrid_slam {

void GridWeightOptions::describe(OptionTable& t) {
  t.add("method", method,
        {{Method::penetration, "penetration"},
         {Method::likelihoodField, "likelihood_field"},
         {Method::rayTracing, "ray_tracing"},
         {Method::consensus, "consensus"}},
        "penetration: after the paper's reference [4]; the others are MRPT's likelihood methods (slow; for "
        "comparison). The whole section: weights of proposal standard, and of places (slips, localisation)");
  t.add("exponent", exponent, 0, 1000, "",
        "w_grid = (geometric mean of the beam likelihoods)^exponent: the effective number of independent "
        "beams");
  t.add("beams", beams, 0, 10000,
        "number of beams weighted, evenly over the wall directions (MRPT's methods: about this many, evenly "
        "spaced); 0: all");
  t.add("sigma", sigma, 0.005, 2, "m", "standard deviation of a range relative to the grid");
  t.add("unknown_depth", unknownDepth, 0.1, 1000, "m",
        "mean distance that a beam travels through unknown cells");
  t.add("outlier", outlier, 1e-6, 0.99, "", "fraction of readings the map does not explain (people, doors)");
}

namespace {

constexpr int kBlock = 8;  // steps at a time: skipped if all cells are free

/// Returns whether a block of steps is free. It is no longer than a square is wide, so its cells lie in the
/// squares at the corners of its bounding rectangle.
bool isFree(TileReader& cells, const RaySamples& first, const RaySamples& last) {
  constexpr int kSquaresInTile = Tile::kBits - Tile::kSquareBits;
  for (const int x : {first.squareX(), last.squareX()})
    for (const int y : {first.squareY(), last.squareY()}) {
      const Tile* const tile = cells.tile(x >> kSquaresInTile, y >> kSquaresInTile);
      if (!tile || !tile->isFree(x, y)) return false;
    }
  return true;
}

/// Consecutive occupied cells on a beam.
struct CrossedWall {
  double passes = 1;   ///< prod (1 - P)
  double stops = 0;    ///< sum P
  double density = 0;  ///< sum P exp(-(d - z)^2 / (2 sigma^2))
};

}  // namespace

PenetrationModel::PenetrationModel(const GridWeightOptions& options, double resolution)
    : resolution_(resolution), outlier_(options.outlier) {
  for (int value = -128; value < 128; ++value) {
    double& passes = passes_[static_cast<size_t>(value + 128)];
    if (value == 0)
      passes = std::exp(-resolution / options.unknownDepth);
    else
      passes = value < 0 ? 1 : OccupancyGrid::probabilityOf(-value);
  }
  const double sigma = options.sigma / resolution;
  behind_ = std::max(1, static_cast<int>(std::lround(3 * sigma)));
  const int before = static_cast<int>(std::ceil(6 * sigma));  // exp(-18): negligible before that
  const int steps = (before + behind_ + kBlock - 1) / kBlock * kBlock;
  for (int i = 0; i < steps; ++i) {
    const double off = (behind_ - steps + i + 0.5) / sigma;
    density_.push_back(std::exp(-0.5 * off * off));
  }
}

double PenetrationModel::beamLikelihood(double originX, double originY, double dirX, double dirY,
                                        double range, TileReader& cells) const {
  static constexpr std::array<double, kBlock> kFarFromReading{};
  static constexpr Tile::Cells kUnknown{};
  const int window = static_cast<int>(density_.size());
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): range >= 0
  int left = static_cast<int>(range + 0.5) + behind_;  // steps
  const double start = range + behind_ - left + 0.5;
  RaySamples place(originX + start * dirX, originY + start * dirY, dirX, dirY);
  double passing = 1, stoppedNearRange = 0;  // product and sum of the formula
  CrossedWall wall;
  const auto leaveWall = [&] {
    if (wall.stops == 0) return;
    stoppedNearRange += passing * (1 - wall.passes) * wall.density / wall.stops;
    passing *= wall.passes;
    wall = CrossedWall();
  };
  for (int block = (left - 1) % kBlock + 1; left > 0; left -= block, block = kBlock) {
    const double* const density =
        left <= window ? &density_[static_cast<size_t>(window - left)] : kFarFromReading.data();
    const auto follow = [&](const auto& valueAt) __attribute__((always_inline)) {
      for (int i = 0; i < block; ++i, place.advance()) {
        const int value = valueAt(place.cellX(), place.cellY());
        const double passes = passes_[static_cast<size_t>(value + 128)];
        if (value > 0) {
          wall.passes *= passes;
          wall.stops += 1 - passes;
          wall.density += (1 - passes) * density[i];
        } else {
          leaveWall();
          stoppedNearRange += passing * (1 - passes) * density[i];
          passing *= passes;
        }
      }
    };
    const auto leaveOut = [&] {
      leaveWall();
      place.advance(block);
    };
    const RaySamples last = place.ahead(block - 1);
    if (place.tileX() == last.tileX() && place.tileY() == last.tileY()) {
      const Tile* const tile = cells.tile(place.tileX(), place.tileY());
      if (tile && tile->isFree(place.squareX(), place.squareY(), last.squareX(), last.squareY()))
        leaveOut();
      else
        follow([values = tile ? tile->cells().data() : kUnknown.data()](int x, int y) {
          return values[Tile::index(x, y)];
        });
    } else if (isFree(cells, place, last)) {
      leaveOut();
    } else {
      follow([&](int x, int y) { return cells.at(x, y); });
    }
  }
  leaveWall();
  const double stopped = 1 - passing;
  return stopped > 0 ? std::min(stoppedNearRange / stopped, 1.0) : 0;
}

double PenetrationModel::meanLogLikelihood(const ScanBeams& scan, const mrpt::math::TPose2D& robot,
                                           const OccupancyGrid& grid) const {
  if (scan.rays.empty()) return 0;
  const GridPose pose(robot, scan, resolution_);
  const double perMetre = 1 / resolution_;
  TileReader cells(grid.tiles());
  double sum = 0, product = 1;  // over few enough beams not to underflow: one logarithm for all
  for (const auto& ray : scan.rays) {
    const double likelihood = beamLikelihood(pose.origin(ray).x, pose.origin(ray).y, pose.dirX(ray),
                                             pose.dirY(ray), ray.range * perMetre, cells);
    product *= (1 - outlier_) * likelihood + outlier_;
    if (product > 1e-100) continue;
    sum += std::log(product);
    product = 1;
  }
  sum += std::log(product);
  return sum / static_cast<double>(scan.rays.size());
}

}  // namespace hybrid_slam
