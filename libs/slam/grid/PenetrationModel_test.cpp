#include "slam/grid/PenetrationModel.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

constexpr int8_t kFree = -20;

double uniform(RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

/// A row of cells in front of a laser at (0, 0) that looks along x.
class Corridor {
 public:
  Corridor(double cellSize, const GridWeightOptions& options)
      : size_(cellSize), options_(options), grid_(cellSize) {}
  void fill(int from, int to, int8_t value) {
    for (int x = from; x <= to; ++x) grid_.tiles().set({x, 0}, value);
  }
  void wall(int x, int8_t value) { grid_.tiles().set({x, 0}, value); }
  double occupancy(int x) const { return grid_.occupancy({x, 0}); }
  /// L of a reading of z metres.
  double likelihood(double z) const {
    TileReader cells(grid_.tiles());
    return PenetrationModel(options_, size_).beamLikelihood(0, 0.5, 1, 0, z / size_, cells);
  }
  /// exp(-(d - z)^2 / (2 sigma^2)), d the middle of the step in cell x.
  double gaussian(int x, double z) const {
    const double range = z / size_, d = range + 0.5 + std::ceil(x - range - 0.5);
    return std::exp(-0.5 * std::pow((d - range) * size_ / options_.sigma, 2));
  }

 private:
  double size_;
  GridWeightOptions options_;
  OccupancyGrid grid_;
};

TEST(PenetrationModel, OneWallInFreeSpaceGivesTheGaussianOfItsDistance) {
  Corridor corridor(0.05, {});
  corridor.fill(0, 300, kFree);
  corridor.wall(100, 25);  // for any occupancy: the beam is known to have been stopped
  for (const double z : {5.02, 5.01, 5.11, 4.93, 5.23, 4.84}) {
    EXPECT_NEAR(corridor.likelihood(z), corridor.gaussian(100, z), 1e-12) << z;
  }
}

TEST(PenetrationModel, TwoWallsShareTheBeamByTheirOccupancy) {
  Corridor corridor(0.05, {});
  corridor.fill(0, 300, kFree);
  corridor.wall(100, 10), corridor.wall(102, 30);
  const double p1 = corridor.occupancy(100), p2 = corridor.occupancy(102);
  for (const double z : {5.02, 5.12, 4.96, 5.21}) {
    const double expected = (p1 * corridor.gaussian(100, z) + (1 - p1) * p2 * corridor.gaussian(102, z)) /
                            (1 - (1 - p1) * (1 - p2));
    EXPECT_NEAR(corridor.likelihood(z), expected, 1e-12) << z;
  }
}

/// Readings of a wall end equally before and behind its middle: noise and rounding make it thick. The
/// expected reading must also be in the middle, or the pose is biased away from the wall.
TEST(PenetrationModel, AThickWallIsExpectedInItsMiddle) {
  Corridor corridor(0.05, {});
  corridor.fill(0, 300, kFree);
  corridor.fill(99, 101, 30);
  const double middle = 5.025;
  // If the offset is a whole number of steps and a half, the step centres are the cell centres.
  for (const double off : {0.025, 0.075, 0.125, 0.175})
    EXPECT_NEAR(corridor.likelihood(middle - off + 1e-9), corridor.likelihood(middle + off + 1e-9), 1e-6)
        << off;
  EXPECT_GT(corridor.likelihood(middle + 0.025 + 1e-9), corridor.likelihood(middle - 0.075 + 1e-9));
  corridor.wall(99, 10);  // hit less often
  const double p1 = corridor.occupancy(99), p2 = corridor.occupancy(100);
  const double z = 5.01;
  EXPECT_NEAR(corridor.likelihood(z),
              (p1 * corridor.gaussian(99, z) + p2 * (corridor.gaussian(100, z) + corridor.gaussian(101, z))) /
                  (p1 + 2 * p2),
              1e-12);
}

TEST(PenetrationModel, AThickWallTransmitsTheProductOfItsCells) {
  Corridor corridor(0.05, {});
  corridor.fill(0, 300, kFree);
  corridor.fill(58, 60, 20);
  corridor.wall(100, 40);
  const double through = std::pow(1 - corridor.occupancy(58), 3), p = corridor.occupancy(100);
  EXPECT_NEAR(corridor.likelihood(5.02), through * p * corridor.gaussian(100, 5.02) / (1 - through * (1 - p)),
              1e-12);
}

TEST(PenetrationModel, AReadingBehindAWallIsAsUnlikelyAsTheWallIsSolid) {
  Corridor corridor(0.05, {});
  corridor.fill(0, 300, kFree);
  corridor.wall(60, 40), corridor.wall(100, 40);
  const double p = corridor.occupancy(60);
  // The beam passed the first wall and was stopped by the second, 2 m (25 sigma) behind it.
  EXPECT_NEAR(corridor.likelihood(5.02), (1 - p) * p / (1 - (1 - p) * (1 - p)) * corridor.gaussian(100, 5.02),
              1e-12);
  // The beam was stopped by the first wall; the second is out of range of the sum.
  EXPECT_NEAR(corridor.likelihood(3.02), corridor.gaussian(60, 3.02), 1e-12);
}

/// Unknown space stops a beam by the exponential law with mean unknown_depth; with cells much smaller than
/// sigma the sum becomes the integral of exp(-t / depth) / depth * exp(-(t - z)^2 / (2 sigma^2)), t up to
/// z + 3 sigma, over 1 - exp(-(z + 3 sigma) / depth).
TEST(PenetrationModel, UnknownSpaceFollowsTheExponentialLaw) {
  for (const double depth : {2.0, 8.0, 20.0})
    for (const double z : {0.5, 3.0, 10.0}) {
      GridWeightOptions options;
      options.unknownDepth = depth;
      options.sigma = 0.13;
      const double cell = 0.01, s = options.sigma, shift = s / depth;
      const double integral = std::exp(-z / depth + 0.5 * shift * shift) / depth * s * std::sqrt(M_PI / 2) *
                              (std::erf((3 + shift) / M_SQRT2) - std::erf((-z / s + shift) / M_SQRT2));
      const double expected = integral / (1 - std::exp(-(z + 3 * s) / depth));
      // The middle rule's error: (cell / sigma)^2 / 24 of the largest second derivative, 4e-4.
      EXPECT_NEAR(Corridor(cell, options).likelihood(z), expected, 5e-4 * expected) << depth << " " << z;
    }
}

TEST(PenetrationModel, AnObstacleHalfUnknownSpaceBeforeIt) {
  GridWeightOptions options;
  options.unknownDepth = 2;
  Corridor corridor(0.05, options);
  corridor.fill(40, 300, kFree);  // 2 m of unknown space first
  corridor.wall(100, 127);
  const double through = std::exp(-2.0 / 2), p = corridor.occupancy(100);
  // 3 m before the reading, unknown space adds nothing to the sum; it stops 1 - through of the beams.
  const double stopped = 1 - through * (1 - p);
  EXPECT_NEAR(corridor.likelihood(5.02), through * p * corridor.gaussian(100, 5.02) / stopped, 1e-9);
}

TEST(PenetrationModel, KnownFreeSpaceLetsEveryBeamThrough) {
  Corridor corridor(0.05, {});
  corridor.fill(0, 300, kFree);
  EXPECT_EQ(corridor.likelihood(5), 0);  // nothing there could stop it
  corridor.wall(100, 40);
  const double before = corridor.likelihood(5.1);
  corridor.fill(0, 99, -1);  // observed as free once, or often
  EXPECT_EQ(corridor.likelihood(5.1), before);
}

/// The formula of the header, step by step, over the whole beam.
double reference(const GridWeightOptions& o, double size, const OccupancyGrid& grid, double x, double y,
                 double dirX, double dirY, double z) {
  const double behind = std::max(1.0, std::round(3 * o.sigma / size));
  const double steps = std::floor(z / size + 0.5) + behind;
  double passing = 1, sum = 0;
  double wallPasses = 1, wallStops = 0, wallSum = 0;
  const auto leaveWall = [&] {
    if (wallStops > 0) sum += passing * (1 - wallPasses) * wallSum / wallStops;
    passing *= wallPasses;
    wallPasses = 1, wallStops = wallSum = 0;
  };
  for (int i = 0; i < steps; ++i) {
    const double d = z + (behind - steps + i + 0.5) * size;
    const CellIndex cell = grid.cellOf(x + d * dirX, y + d * dirY);
    const int value = grid.tiles().at(cell);
    const double stops = value == 0  ? 1 - std::exp(-size / o.unknownDepth)
                         : value > 0 ? grid.occupancy(cell)
                                     : 0;
    if (value <= 0) leaveWall();
    wallPasses *= 1 - stops;
    wallStops += stops;
    wallSum += stops * std::exp(-(d - z) * (d - z) / (2 * o.sigma * o.sigma));
    if (value <= 0) leaveWall();
  }
  leaveWall();
  return passing < 1 ? sum / (1 - passing) : 0;
}

TEST(PenetrationModel, RandomGridsAgreeWithTheFormulaAndStayWithinZeroAndOne) {
  RandomStream random(1, 0, 0);
  for (int world = 0; world < 40; ++world) {
    GridWeightOptions options;
    options.sigma = uniform(random, 0.02, 0.5);
    options.unknownDepth = uniform(random, 0.5, 50);
    const double size = uniform(random, 0.03, 0.3);
    // The worlds range from sparse ones, in which beams go far, to dense ones, in which the first cells
    // stop them.
    const double share = std::pow(random.uniform(), 3);
    const double unknown = world % 2 == 0 ? 0.1 : 0;  // without, free squares are skipped
    OccupancyGrid grid(size);
    for (int y = -100; y < 100; ++y)
      for (int x = -100; x < 100; ++x) {
        const double what = random.uniform();
        const double level = uniform(random, 1, 127);
        if (what < share)
          grid.tiles().set({x, y}, static_cast<int8_t>(level));
        else if (what < 1 - unknown)
          grid.tiles().set({x, y}, static_cast<int8_t>(-level));
      }
    const PenetrationModel model(options, size);
    for (int beam = 0; beam < 50; ++beam) {
      const double x = uniform(random, -20, 20) * size, y = uniform(random, -20, 20) * size;
      const double heading = uniform(random, -M_PI, M_PI), z = uniform(random, 0.01, 60 * size);
      const double dirX = std::cos(heading), dirY = std::sin(heading);
      TileReader cells(grid.tiles());
      const double likelihood = model.beamLikelihood(x / size, y / size, dirX, dirY, z / size, cells);
      ASSERT_GE(likelihood, 0);
      ASSERT_LE(likelihood, 1);
      // The model omits cells more than 6 sigma before z: at most exp(-18) = 1.5e-8.
      ASSERT_NEAR(likelihood, reference(options, size, grid, x, y, dirX, dirY, z), 2e-8);
    }
  }
}

ScanBeams beamsOf(const std::vector<std::pair<double, double>>& readings) {
  LaserScan scan;
  for (const auto& [angle, range] : readings) scan.beams.push_back({angle, range, true});
  return ScanBeams(scan);
}

TEST(PenetrationModel, AScanIsTheMeanOfItsBeamsWithTheirShareOfOutliers) {
  GridWeightOptions options;
  options.outlier = 0.2;
  options.sigma = 0.1;
  OccupancyGrid grid(0.05);
  for (int x = -200; x < 200; ++x)
    for (int y = -200; y < 200; ++y) grid.tiles().set({x, y}, x == 100 ? int8_t{50} : kFree);
  const PenetrationModel model(options, 0.05);
  const TPose2D robot(0, 0.025, 0);
  // One beam into the wall, one 0.2 m (2 sigma) short of it, one that ends where nothing is; the step in the
  // wall lies half a cell behind the first's reading.
  const auto withOutliers = [](double sigmas) {
    return std::log(0.8 * std::exp(-0.5 * sigmas * sigmas) + 0.2);
  };
  const double right = withOutliers(0.25), off = withOutliers(2.25), wrong = std::log(0.2);
  EXPECT_NEAR(model.meanLogLikelihood(beamsOf({{0, 5.024}}), robot, grid), right, 1e-12);
  EXPECT_NEAR(model.meanLogLikelihood(beamsOf({{0, 4.824}}), robot, grid), off, 1e-9);
  EXPECT_NEAR(model.meanLogLikelihood(beamsOf({{M_PI, 5}}), robot, grid), wrong, 1e-12);
  EXPECT_NEAR(model.meanLogLikelihood(beamsOf({{0, 5.024}, {0, 4.824}, {M_PI, 5}}), robot, grid),
              (right + off + wrong) / 3, 1e-9);
}

TEST(PenetrationModel, AnEmptyScanIsNeutral) {
  EXPECT_EQ(PenetrationModel({}, 0.05).meanLogLikelihood(beamsOf({}), {}, OccupancyGrid(0.05)), 0);
}

}  // namespace
}  // namespace hybrid_slam
