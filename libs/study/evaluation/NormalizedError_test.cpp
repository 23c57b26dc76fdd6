#include "study/evaluation/NormalizedError.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/Errors.h"
#include "base/PoseRotation.h"
#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"

namespace hybrid_slam::evaluation {
namespace {

files::Trajectory line(size_t count, double offset) {
  files::Trajectory all;
  for (size_t i = 0; i < count; ++i)
    all.push_back({0.1 * static_cast<double>(i), {static_cast<double>(i), i > 0 ? offset : 0, 0}});
  return all;
}

TEST(NormalizedError, IsTheSquaredErrorInUnitsOfTheVariance) {
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.01, 0.04, 0.01).asDiagonal();
  const NormalizedErrors errors =
      normalizedErrors(line(4, 0.6), std::vector<Eigen::Matrix3d>(4, covariance), line(4, 0), 0.01);
  EXPECT_EQ(errors.pairs, 4u);
  EXPECT_NEAR(errors.mean, 0.75 * 0.36 / 0.04, 1e-9);
  EXPECT_NEAR(errors.median, 9, 1e-9);
  EXPECT_NEAR(errors.inside95, 0.25, 1e-9) << "9 is outside";
  EXPECT_EQ(errors.insideAxes, Eigen::Vector3d(1, 0.25, 1));
}

TEST(NormalizedError, FramesBeginAtTheFirstPose) {
  files::Trajectory moved = line(4, 0);
  for (auto& stamped : moved) stamped.pose = mrpt::math::TPose2D(5, -2, 1) + stamped.pose;
  const Eigen::Matrix3d covariance = 0.01 * Eigen::Matrix3d::Identity();
  EXPECT_NEAR(normalizedErrors(line(4, 0), std::vector<Eigen::Matrix3d>(4, covariance), moved, 0.01).mean, 0,
              1e-9);
}

TEST(NormalizedError, DoesNotDependOnTheMapFrame) {
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.01, 0.04, 0.01).asDiagonal();
  const double turn = 1.2;
  files::Trajectory turned = line(4, 0.6);
  for (auto& stamped : turned) stamped.pose = mrpt::math::TPose2D(5, -2, turn) + stamped.pose;
  const auto meanOf = [](const files::Trajectory& estimate, const Eigen::Matrix3d& ofEach) {
    return normalizedErrors(estimate, std::vector<Eigen::Matrix3d>(4, ofEach), line(4, 0), 0.01).mean;
  };
  EXPECT_NEAR(meanOf(turned, rotated(covariance, turn)), meanOf(line(4, 0.6), covariance), 1e-9);
}

TEST(NormalizedError, RepeatedTimestampsArePairedInOrder) {
  files::Trajectory stands = line(4, 0);
  for (auto& stamped : stands) stamped.timestamp = 1;
  const std::vector<Eigen::Matrix3d> covariances(4, Eigen::Matrix3d::Identity());
  EXPECT_EQ(normalizedErrors(stands, covariances, stands, 0.01).mean, 0);
}

TEST(NormalizedError, WrongCovariances) {
  EXPECT_THROW(normalizedErrors(line(4, 0), {}, line(4, 0), 0.01), InputError);
  EXPECT_THROW(normalizedErrors(line(1, 0), {Eigen::Matrix3d::Zero()}, line(1, 0), 0.01), InputError);
}

TEST(NormalizedError, ACovarianceTooSmallForItsErrorIsNamed) {
  const Eigen::Matrix3d tiny = 1e-300 * Eigen::Matrix3d::Identity();
  const std::vector<Eigen::Matrix3d> covariances{Eigen::Matrix3d::Identity(), tiny};
  EXPECT_EQ(test::errorOf([&] { normalizedErrors(line(2, 1), covariances, line(2, 0), 0.01); }),
            "covariance too small: row 2; expected an error below 1e15 standard deviations");
}

TEST(NormalizedError, CovariancesThatCannotBeTrueAreNamed) {
  const files::TemporaryFolder folder;
  const std::string file =
      folder.write("c.csv", "timestamp,xx,xy,yy,xphi,yphi,phiphi\n1,1,0,1,0,0,1\n2,1e200,0,1,0,0,1\n");
  EXPECT_EQ(test::errorOf([&] { loadCovariances(file); }),
            "broken line: file `" + file + "`, line 3; expected covariances in -1e14..1e14 (m, rad)");
}

TEST(NormalizedError, OfRelations) {
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.01, 0.04, 0.25).asDiagonal();
  const auto squared = [&](const mrpt::math::TPose2D& motion) {
    // 1 m ahead, while turning from 175 deg to -175 deg
    const TrajectoryPoint first{{5, 5, M_PI - 0.1}},
        second{{5 - std::cos(0.1), 5 + std::sin(0.1), 0.1 - M_PI}};
    return normalizedErrors({{motion, first, second}}, {covariance}).mean;
  };
  EXPECT_NEAR(squared({1, 0, 0.2}), 0, 1e-12);
  EXPECT_NEAR(squared({1.1, 0, 0.2}), 1, 1e-9) << "one standard deviation";
  EXPECT_NEAR(squared({0.9, 0, 0.2}), 1, 1e-9);
  EXPECT_NEAR(squared({1, 0.2, 0.2}), 1, 1e-9) << "in the frame of the first pose";
  EXPECT_NEAR(squared({1, 0, 0.2 - 0.5}), 1, 1e-9);
  EXPECT_NEAR(squared({1.1, 0.2, 0.7}), 3, 1e-9);
}

TEST(NormalizedError, OfTwoRelations) {
  const std::vector<PlacedRelation> relations{{{1, 0, 0}, {{0, 0, 0}}, {{4, 0, 0}}}, {{}, {}, {}}};
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  const NormalizedErrors errors = normalizedErrors(relations, {one, one});
  EXPECT_EQ(errors.pairs, 2u);
  EXPECT_NEAR(errors.mean, 4.5, 1e-12);
  EXPECT_NEAR(errors.inside95, 0.5, 1e-12) << "9 is outside";
  EXPECT_EQ(test::errorOf([&] {
              normalizedErrors(relations, {one, Eigen::Matrix3d::Zero()});
            }),
            "covariance without inverse: used relation 2; expected a positive definite matrix");
}

TEST(NormalizedError, ReadsAFile) {
  const files::TemporaryFolder folder;
  const std::string head = "timestamp,xx,xy,yy,xphi,yphi,phiphi\n";
  const auto all = loadCovariances(folder.write("c.csv", head + "1,2,0.5,3,0.25,0.125,4\n"));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0](0, 0), 2);
  EXPECT_EQ(all[0](1, 0), 0.5);
  EXPECT_EQ(all[0](2, 1), 0.125);
  EXPECT_EQ(all[0](2, 2), 4);
  EXPECT_THROW(loadCovariances(folder.write("short.csv", head + "1,2,3\n")), InputError);
  EXPECT_THROW(loadCovariances(folder.write("word.csv", head + "1,2,0.5,3,x,0.125,4\n")), InputError);
  EXPECT_THROW(loadCovariances(folder.write("headless.csv", "1,2,0.5,3,0.25,0.125,4\n")), InputError);
  EXPECT_THROW(loadCovariances(folder.path("none.csv")), InputError);
}

}  // namespace
}  // namespace hybrid_slam::evaluation
