// Values that no run writes but damaged session files hold: each would overflow, or take memory, in the next
// update.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "base/ScanState.h"
#include "base/State.h"
#include "slam/filter/RecentMap.h"
#include "slam/filter/ScanOdometry.h"
#include "slam/filter/StuckOdometry.h"
#include "slam/lines/LineDatabase.h"
#include "slam/loops/LoopCloser.h"
#include "slam/motion/MotionBelief.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr int kLeast = std::numeric_limits<int>::min(), kMost = std::numeric_limits<int>::max();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns whether the written values can be read as `value`.
template <class T, class... Written>
bool canRead(T value, Written... written) {
  std::string bytes;
  StateWriter out(bytes);
  out(written...);
  StateReader in(bytes);
  try {
    in(value);
    return in.isAtEnd();
  } catch (const StateError&) {
    return false;
  }
}
template <class T>
bool canBeReadBack(const T& value) {
  return canRead(value, value);
}

TEST(ImpossibleState, GridFarFromTheOrigin) {
  const auto canReadAt = [](int firstX) { return canRead(TileGrid(), firstX, 0, 0, 0, size_t{0}); };
  EXPECT_TRUE(canReadAt(-1000));
  EXPECT_FALSE(canReadAt(kLeast));
  EXPECT_FALSE(canReadAt(kMost));
}

TEST(ImpossibleState, CellsOfNoSize) {
  EXPECT_TRUE(canBeReadBack(OccupancyGrid(0.05)));
  for (const double size : {1e-300, kInfinity}) EXPECT_FALSE(canBeReadBack(OccupancyGrid(size))) << size;
}

TEST(ImpossibleState, StuckOdometryWithoutItsScan) {
  const auto canReadWith = [](const Scans& scans) {
    return canRead(StuckOdometry({}, {}), false, size_t{0}, scans, TPose2D(), 0.0, 0.0, 0.0, TPose2D(),
                   false);
  };
  EXPECT_TRUE(canReadWith({std::make_shared<mrpt::obs::CObservation2DRangeScan>()}));
  EXPECT_FALSE(canReadWith({nullptr}));
}

TEST(ImpossibleState, LineThatWasSeenTooOften) {
  DatabaseLine line;
  EXPECT_TRUE(canBeReadBack(line));
  line.count = kMost;
  EXPECT_FALSE(canBeReadBack(line));
  line.count = 1, line.inserted = kLeast;
  EXPECT_FALSE(canBeReadBack(line));
}

TEST(ImpossibleState, LineDatabaseOfImpossibleAge) {
  const auto canReadAt = [](int updates) { return canRead(LineDatabase(), size_t{0}, updates); };
  EXPECT_TRUE(canReadAt(7));
  EXPECT_FALSE(canReadAt(kMost));
  EXPECT_FALSE(canReadAt(-1));
}

TEST(ImpossibleState, InformationThatIsNone) {
  PoseEdge edge{0, 1, {}, Eigen::Matrix3d::Identity()};
  EXPECT_TRUE(canBeReadBack(edge));
  for (const double wrong : {kInfinity, -1.0, 0.0, 1e300}) {
    edge.information(1, 1) = wrong;
    EXPECT_FALSE(canBeReadBack(edge)) << wrong;
  }
}

TEST(ImpossibleState, MotionBeliefThatIsNone) {
  const MotionModelOptions options;
  const auto isPlausible = [&](double dd, double dt, double d) {
    std::string bytes;
    StateWriter out(bytes);
    std::array<double, 15> terms{};
    terms[0] = dd, terms[1] = dt, terms[2] = 1, terms[3] = d;  // of the distance; 2: tt
    out(terms);
    MotionBelief belief;
    StateReader in(bytes);
    in(belief);
    return belief.isPlausible(options);
  };
  EXPECT_TRUE(isPlausible(0, 0, 0));
  EXPECT_TRUE(isPlausible(1e6, 10, 1e3));
  EXPECT_FALSE(isPlausible(-1e9, 0, 0));
  EXPECT_FALSE(isPlausible(0, 1e9, 0));
  EXPECT_FALSE(isPlausible(0, 0, 1e300));
  EXPECT_FALSE(isPlausible(kInfinity, 0, 0));
}

ScanBeams beamOf(double range, const TPoint2D& laser = {0, 0}) {
  ScanBeams beams;
  beams.origins = {laser};
  beams.rays = {{1, 0, range, 0}};
  return beams;
}

TEST(ImpossibleState, LaserFarFromTheRobot) {
  EXPECT_TRUE(canBeReadBack(beamOf(5, {0.3, 0})));
  EXPECT_FALSE(canBeReadBack(beamOf(5, {1e5, 0})));
}

TEST(ImpossibleState, BeamBeyondTheRange) {
  const GridOptions grid;
  const auto canReadOdometry = [&](double range) {
    return canRead(ScanOdometry(grid, ScanMatcherOptions()), size_t{1}, beamOf(range), TPose2D(), TPose2D(),
                   TPose2D(), 0.0, 0.0);
  };
  const auto canReadLoops = [&](double range, const StepVariance& variance) {
    return canRead(LoopCloser(LoopClosingOptions(), grid), std::vector<Keyframe>{{0, beamOf(range)}},
                   std::vector<StepVariance>{variance}, std::vector<std::optional<double>>(1),
                   std::vector<PoseEdge>(), size_t{0}, size_t{1}, TPose2D(), StepVariance(), 0.0);
  };
  const auto canReadRecent = [&](double range) {
    return canRead(RecentMap(grid), std::deque<ScanBeams>{beamOf(range)});
  };
  EXPECT_TRUE(canReadRecent(19));
  EXPECT_FALSE(canReadRecent(5000));
  EXPECT_TRUE(canReadOdometry(19));
  EXPECT_FALSE(canReadOdometry(5000));
  EXPECT_TRUE(canReadLoops(19, {1e-5, 1e-6}));
  EXPECT_FALSE(canReadLoops(5000, {1e-5, 1e-6}));
  EXPECT_FALSE(canReadLoops(19, {1e-5, 0})) << "no inverse";
}

}  // namespace
}  // namespace hybrid_slam
