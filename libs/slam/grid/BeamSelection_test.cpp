#include "slam/grid/BeamSelection.h"

#include <gmock/gmock.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

using testing::IsEmpty;

/// A scan at heading `phi` in a corridor of 2.4 m width that ends 8 m ahead; 541 beams over 270 deg.
LaserScan corridorScan(double phi, double noise, RandomStream& random) {
  LaserScan scan;
  for (int i = 0; i < 541; ++i) {
    const double angle = mrpt::DEG2RAD(-135 + 0.5 * i), x = std::cos(angle + phi), y = std::sin(angle + phi);
    const double range = std::min(x > 0 ? 8 / x : 1e9, y == 0 ? 1e9 : 1.2 / std::abs(y));
    scan.beams.push_back({angle, range + noise * random.gaussian(), range < 20});
  }
  return scan;
}

bool meetsTheEnd(const LaserScan& scan, size_t i, double phi) {
  return scan.beams[i].range * std::cos(scan.beams[i].angle + phi) > 7.9;
}

TEST(BeamSelection, TakesAsManyBeamsFromTheEndOfACorridorAsFromItsSides) {
  for (const double phi : {0.0, 0.2, 0.7, -1.0}) {
    RandomStream random(1, 0, 0);
    const LaserScan scan = corridorScan(phi, 0.005, random);
    const auto taken = BeamSelection({scan}).take(60);
    ASSERT_EQ(taken.size(), 60u);
    const auto atEnd = [&](size_t i) { return meetsTheEnd(scan, i, phi); };
    std::vector<size_t> all(scan.beams.size());
    std::iota(all.begin(), all.end(), size_t{0});
    const auto few = std::count_if(all.begin(), all.end(), atEnd);
    ASSERT_LT(few, 40);  // of 541; beams evenly spaced in angle would have 3 or 4 there
    EXPECT_GE(std::count_if(taken.begin(), taken.end(), atEnd), std::min<long>(few, 20)) << phi;
  }
}

TEST(BeamSelection, OneStraightWallIsSampledEvenly) {
  LaserScan scan;
  for (int i = -40; i <= 40; ++i) {  // turned by 10 deg, so that its direction is not on the border of groups
    const double angle = mrpt::DEG2RAD(i);
    scan.beams.push_back({angle + M_PI / 18, 2 / std::cos(angle), true});
  }
  EXPECT_EQ(BeamSelection({scan}).take(3), (std::vector<size_t>{13, 40, 67}));
}

TEST(BeamSelection, TakesAllBeamsIfThereAreTooFew) {
  RandomStream random(2, 0, 0);
  LaserScan scan = corridorScan(0.1, 0, random);
  std::vector<size_t> valid;
  for (size_t i = 0; i < scan.beams.size(); ++i) {
    if (i % 3 == 0) scan.beams[i] = {scan.beams[i].angle, std::numeric_limits<double>::quiet_NaN(), false};
    if (scan.beams[i].valid) valid.push_back(i);
  }
  const BeamSelection selection({scan});
  EXPECT_EQ(selection.take(0), valid);
  EXPECT_EQ(selection.take(541), valid);
  EXPECT_EQ(selection.take(static_cast<int>(valid.size())), valid);
}

TEST(BeamSelection, AnEmptyScanGivesNoBeams) {
  EXPECT_THAT(BeamSelection(LaserScans()).take(10), IsEmpty());
  LaserScan blind;
  blind.beams.assign(100, {0, 0, false});
  EXPECT_THAT(BeamSelection({blind}).take(10), IsEmpty());
}

TEST(BeamSelection, GivesTheRequestedNumberOfValidBeamsInOrder) {
  RandomStream random(3, 0, 0);
  for (int k = 0; k < 200; ++k) {
    LaserScan scan;
    const int count = static_cast<int>(400 * random.uniform());
    int valid = 0;
    for (int i = 0; i < count; ++i) {
      scan.beams.push_back({0.01 * i, 0.01 + 20 * random.uniform(), random.uniform() < 0.8});
      valid += scan.beams.back().valid;
    }
    const int wanted = 1 + static_cast<int>(300 * random.uniform());
    const auto taken = BeamSelection({scan}).take(wanted);
    ASSERT_EQ(taken.size(), static_cast<size_t>(std::min(wanted, valid)));
    for (size_t i = 0; i < taken.size(); ++i) {
      ASSERT_LT(taken[i], scan.beams.size());
      ASSERT_TRUE(scan.beams[taken[i]].valid);
      if (i > 0) {
        ASSERT_LT(taken[i - 1], taken[i]);
      }
    }
  }
}

}  // namespace
}  // namespace hybrid_slam
