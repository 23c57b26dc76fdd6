// A robot that is lifted and put down elsewhere in the mapped area: the filter's particles.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/PoseOffset.h"
#include "slam/filter/HybridFilter.h"
#include "slam/lines/WallDirections.h"
#include "testing/MappedRoom.h"
#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// A hall of 14 m x 12 m that looks the same after half a turn, but for the cupboard at one wall.
Walls hall() {
  Walls walls = box(-7, -6, 7, 6);
  append(walls, box(-1.5, -6, 1.5, -4.5));
  return walls;
}

const RoomMap& mappedHall() {
  static const RoomMap map = mappedFrom({-5, -3.5}, {5, 4.5}, hall(), 150);
  return map;
}

/// Where the robot is put down: it looks into a corner and does not see the cupboard, nor the other one that
/// there would be if it stood at the opposite place.
const TPose2D kPutDown(5, 4, -18 * kDegree);
const TPose2D kTurn(0, 0, 6.3 * kDegree);

TPose2D opposite(const TPose2D& pose) { return TPose2D(0, 0, M_PI) + pose; }

/// A robot that drives in the middle of the hall, is carried to another place, and turns there. It has the
/// map of the hall, with this line database.
class CarriedRobot {
 public:
  CarriedRobot(const FilterConfiguration& c, const LineDatabase& lines) : filter_(c) {
    filter_.expectMap();
    look({});
    filter_.joinMap({mappedHall().grid, lines}, at_);
    for (int i = 0; i < 3; ++i) move({0.25, 0, 0});
    at_ = kPutDown;
  }
  void move(const TPose2D& motion) {
    at_ = at_ + motion;
    look(motion);
  }
  const TPose2D& at() const { return at_; }
  const HybridFilter& filter() const { return filter_; }
  /// Number of particles near a place, in the last step.
  size_t near(const TPose2D& place) const {
    const auto& poses = filter_.lastStep().poses;
    return static_cast<size_t>(std::count_if(poses.begin(), poses.end(), [&](const WeightedPose& particle) {
      const Eigen::Vector3d off = offsetOf(particle.pose, place);
      return off.head<2>().norm() < 0.3 && std::abs(off.z()) < 10 * kDegree;
    }));
  }
  /// Turns until a particle is where the robot is, at most eight times. @return whether there is one
  bool findsItself() {
    for (int i = 0; i < 8; ++i) {
      move(kTurn);
      if (near(at_) > 0) return true;
    }
    return false;
  }

 private:
  void look(const TPose2D& odometry) {
    filter_.process(odometry, observed(scanOf(hall(), at_, {0.2, 0, 0}, 181, M_PI, 0.01, random_)));
  }
  HybridFilter filter_;
  TPose2D at_{-1, 0, 0};
  RandomStream random_{1, 0, 0};
};

/// A small exponent: both places rival, although their walls were not mapped equally well.
FilterConfiguration configuration(bool useLines) {
  FilterConfiguration c;
  c.useLines = useLines;
  c.filter.particles = 12;
  c.gridWeight.exponent = 2;
  c.loopClosing.enabled = false;
  return c;
}

void expectNear(const TPose2D& pose, const TPose2D& truth) {
  const Eigen::Vector3d off = offsetOf(pose, truth);
  EXPECT_LT(off.head<2>().norm(), 0.1) << pose.asString();
  EXPECT_LT(std::abs(off.z()), 1 * kDegree) << pose.asString();
}

TEST(CarriedRobot, ParticlesAreAtBothPlacesUntilTheScansDecide) {
  for (const bool useLines : {true, false}) {
    SCOPED_TRACE(useLines);
    CarriedRobot robot(configuration(useLines), mappedHall().lines);
    ASSERT_TRUE(robot.findsItself());
    EXPECT_TRUE(robot.filter().lastStep().slipped.value());
    EXPECT_GT(robot.near(opposite(robot.at())), 0u) << "a scan cannot decide";
    const size_t found = robot.filter().updates() - 1;
    const TPose2D there = robot.at();

    for (int i = 0; i < 52; ++i) robot.move(kTurn);
    const auto path = robot.filter().bestPath();
    expectNear(path.back(), robot.at());
    expectNear(path.at(found), there);
  }
}

/// The same lines, turned about the origin.
LineDatabase turned(const LineDatabase& lines, double angle) {
  std::vector<DatabaseLine> all = lines.lines();
  for (DatabaseLine& line : all) {
    static_cast<LineSegment&>(line) = transformed(line, TPose2D(0, 0, angle));
    line.direction = wrapToRightAngle(line.direction + angle);
  }
  return LineDatabase(all);
}

/// With lines, the four headings are searched first at which the walls of the scan are parallel to those of
/// the database. The true one is not among them if the database is turned by 45 deg, as where the robot
/// stands before a wall at an angle.
TEST(CarriedRobot, IsFoundBesideWallsThatDoNotRunAlongTheDatabase) {
  for (const bool useLines : {true, false}) {
    SCOPED_TRACE(useLines);
    CarriedRobot robot(configuration(useLines), turned(mappedHall().lines, 45 * kDegree));
    EXPECT_TRUE(robot.findsItself());
  }
}

}  // namespace
}  // namespace hybrid_slam
