#include "study/evaluation/RelationErrors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "base/Degree.h"
#include "base/Errors.h"
#include "base/RandomStream.h"
#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"

namespace hybrid_slam::evaluation {
namespace {

using mrpt::math::TPose2D;

TEST(RelationErrors, ByHandWithoutOdometry) {
  const files::Trajectory trajectory{{0, {5, 5, M_PI / 2}}, {1, {5, 6, M_PI}}, {2, {4, 6, M_PI}}};
  // The trajectory moves (1, 0, 90 deg) from time 0 to 1, and (1, 0, 0) from 1 to 2.
  const std::vector<Relation> relations{
      {0, 1, {1.3, 0.4, 88 * kDegree}}, {1, 2, {1, 0, 0}}, {2, 3, {0, 0, 0}}, {2, 1, {-1, 0, 0}}};
  const RelationErrors e = evaluateRelations(trajectory, relations, nullptr, 0.006);
  EXPECT_EQ(e.relations, 4u);
  EXPECT_EQ(e.used, 3u);
  EXPECT_NEAR(e.translation.mean, 0.5 / 3, 1e-12);
  EXPECT_NEAR(e.translation.std, std::sqrt((0.25 / 3) - 0.25 / 9), 1e-12);
  EXPECT_NEAR(e.translation.median, 0, 1e-12);
  EXPECT_NEAR(e.translation.max, 0.5, 1e-12);
  EXPECT_NEAR(e.rotation.mean, 2 * kDegree / 3, 1e-12);
  EXPECT_NEAR(e.rotation.max, 2 * kDegree, 1e-12);
}

TEST(RelationErrors, ByHandWithOdometry) {
  files::Trajectory odometry;
  for (int i = 0; i <= 4; ++i) odometry.push_back({static_cast<double>(i), {static_cast<double>(i), 0, 0}});
  const files::Trajectory trajectory{{0, {0, 0, 0}}, {4, {4, 0.4, 0.08}}};
  // At 2 the bridge is at (2, 0.2, 0.04): relations without a pose of their own become usable.
  const std::vector<Relation> relations{{0, 2, {2, 0, 0}}, {0, 4, {4, 0.4, 0.08}}};
  const RelationErrors e = evaluateRelations(trajectory, relations, &odometry, 0.006);
  EXPECT_EQ(e.used, 2u);
  EXPECT_NEAR(e.translation.mean, 0.1, 1e-12);
  EXPECT_NEAR(e.translation.std, 0.1, 1e-12);
  EXPECT_NEAR(e.translation.median, 0.2, 1e-12) << "the upper of the two in the middle";
  EXPECT_NEAR(e.translation.max, 0.2, 1e-12);
  EXPECT_NEAR(e.rotation.mean, 0.02, 1e-12);
  EXPECT_NEAR(e.rotation.std, 0.02, 1e-12);
  EXPECT_EQ(evaluateRelations(trajectory, relations, nullptr, 0.006).used, 1u);
}

TEST(RelationErrors, RotationErrorTakesTheShorterWay) {
  const files::Trajectory trajectory{{0, {0, 0, 0}}, {1, {0, 0, -179 * kDegree}}};
  const RelationErrors e = evaluateRelations(trajectory, {{0, 1, {0, 0, 179 * kDegree}}}, nullptr, 0.006);
  EXPECT_NEAR(e.rotation.max, 2 * kDegree, 1e-12);
}

TEST(RelationErrors, AreInvariantUnderRigidMotionOfTheTrajectory) {
  RandomStream random(8, 0, 0);
  for (int trial = 0; trial < 50; ++trial) {
    files::Trajectory trajectory, moved;
    std::vector<Relation> relations;
    const TPose2D motion{9 * random.gaussian(), 9 * random.gaussian(), 3 * random.gaussian()};
    for (int i = 0; i < 40; ++i) {
      trajectory.push_back({i * 1.0, {random.gaussian(), random.gaussian(), random.gaussian()}});
      moved.push_back({i * 1.0, motion + trajectory.back().pose});
      relations.push_back({i * 1.0, std::floor(40 * random.uniform()), {random.gaussian(), 0, 0}});
    }
    const RelationErrors a = evaluateRelations(trajectory, relations, nullptr, 0.006);
    const RelationErrors b = evaluateRelations(moved, relations, nullptr, 0.006);
    EXPECT_GT(a.translation.mean, 0.1);
    EXPECT_NEAR(a.translation.mean, b.translation.mean, 1e-12);
    EXPECT_NEAR(a.translation.max, b.translation.max, 1e-12);
    EXPECT_NEAR(a.rotation.mean, b.rotation.mean, 1e-12);
  }
}

TEST(RelationErrors, OfSeveralPosesWithOneStampTheLastByPositionIsTaken) {
  const files::Trajectory trajectory{{0, {0, 0, 0}}, {1, {3, 0, 0}}, {1, {2, 0, 0}}};
  const RelationErrors e = evaluateRelations(trajectory, {{0, 1, {3, 0, 0}}}, nullptr, 0.006);
  EXPECT_NEAR(e.translation.max, 0, 1e-12);
}

TEST(RelationErrors, RelationsAreAtRowsOfTheTrajectory) {
  const files::Trajectory trajectory{{2, {7, 0, 0}}, {1, {3, 0, 0}}, {1, {4, 0, 0}}};
  const std::vector<Relation> relations{{1, 2, {}}, {0, 1, {}}};
  const auto placed = placeRelations(trajectory, relations, nullptr, 0.006);
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_EQ(placed[0].first.row, 2u);
  EXPECT_EQ(placed[0].first.pose.x, 4);
  EXPECT_EQ(placed[0].second.row, 0u);
  EXPECT_EQ(placed[0].second.pose.x, 7);
}

TEST(RelationErrors, NoUsableRelation) {
  using testing::HasSubstr;
  const auto errorOf = [](const files::Trajectory& trajectory,
                          const files::Trajectory* odometry) -> std::string {
    try {
      evaluateRelations(trajectory, {{10, 12, {}}}, odometry, 0.006);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  const files::Trajectory odometry{{10, {}}, {11, {}}, {12, {}}};
  EXPECT_THAT(errorOf({{10, {}}, {11, {}}}, nullptr),
              HasSubstr("no usable relation: trajectory 10.000..11.000 s, relations 10.000..12.000 s; "));
  EXPECT_THAT(errorOf({{11, {}}}, &odometry), HasSubstr("after the first pose"));
  EXPECT_THAT(errorOf({}, nullptr), HasSubstr("no usable relation: trajectory without poses"));
}

TEST(RelationErrors, ValuesThatCannotBeTrueAreNamed) {
  const files::TemporaryFolder folder;
  const auto errorOf = [&](const std::string& row) {
    const std::string file = folder.write("relations", "5 7 1 2 3 4 5 6\n" + row + "\n");
    return test::errorOf([&] { loadRelations(file); });
  };
  const std::string line = "broken line: file `" + folder.path("relations") + "`, line 2; expected ";
  for (const char* xyz : {"1e200 0 0", "0 -10000001 0", "0 0 1e8"})
    EXPECT_EQ(errorOf("5 7 " + std::string(xyz) + " 0 0 0"), line + "coordinates in -1e7..1e7 m") << xyz;
  EXPECT_EQ(errorOf("5 7 0 0 0 0 0 1e200"), line + "angles in -1e7..1e7 rad");
}

TEST(RelationErrors, LoadsTheYawFromTheLastColumn) {
  const std::string file = testing::TempDir() + "relations_" + std::to_string(getpid()) + ".txt";
  std::ofstream(file) << "# t1 t2 x y z roll pitch yaw\n5 7 1 2 3 4 5 6\n";
  const auto relations = loadRelations(file);
  std::remove(file.c_str());
  ASSERT_EQ(relations.size(), 1u);
  EXPECT_EQ(relations[0].t1, 5);
  EXPECT_EQ(relations[0].t2, 7);
  EXPECT_EQ(relations[0].motion, TPose2D(1, 2, 6));
}

}  // namespace
}  // namespace hybrid_slam::evaluation
