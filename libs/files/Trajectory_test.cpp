#include "files/Trajectory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "base/Errors.h"
#include "base/RandomStream.h"
#include "testing/ErrorOf.h"

namespace hybrid_slam::files {
namespace {

struct TrajectoryFile : testing::Test {
  const std::string file = testing::TempDir() + "trajectory_" + std::to_string(getpid()) + ".txt";
  ~TrajectoryFile() override { std::remove(file.c_str()); }

  const std::string& fileWith(const std::string& text) const {
    std::ofstream(file) << text;
    return file;
  }
};

TEST_F(TrajectoryFile, TumYawOfAKnownQuaternion) {
  // 90 deg about z; then the quaternion with all signs reversed, which is the same rotation.
  const Trajectory t =
      loadTum(fileWith("1.5 2 3 9 0 0 0.7071067811865476 0.7071067811865476\n"
                       "2.5 0 0 0 0 0 -0.7071067811865476 -0.7071067811865476\n"
                       "3.5 0 0 0 0 0 1 0\n"));
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].timestamp, 1.5);
  EXPECT_EQ(t[0].pose.x, 2);
  EXPECT_EQ(t[0].pose.y, 3);
  EXPECT_NEAR(t[0].pose.phi, M_PI / 2, 1e-15);
  EXPECT_NEAR(t[1].pose.phi, M_PI / 2, 1e-15);
  EXPECT_NEAR(std::abs(t[2].pose.phi), M_PI, 1e-15);
}

TEST_F(TrajectoryFile, TumTiltDoesNotChangeTheYaw) {
  // Yaw 0.7, then pitch -0.1, then roll 0.2 (z-y-x): q = qz * qy * qx.
  const double cz = std::cos(0.35), sz = std::sin(0.35), cy = std::cos(-0.05), sy = std::sin(-0.05),
               cx = std::cos(0.1), sx = std::sin(0.1);
  std::ostringstream row;
  row.precision(17);
  row << "0 0 0 0 " << cz * cy * sx - sz * sy * cx << ' ' << cz * sy * cx + sz * cy * sx << ' '
      << sz * cy * cx - cz * sy * sx << ' ' << cz * cy * cx + sz * sy * sx << '\n';
  EXPECT_NEAR(loadTum(fileWith(row.str())).at(0).pose.phi, 0.7, 1e-14);
}

TEST_F(TrajectoryFile, TumRoundedQuaternionIsAcceptedAndABrokenOneIsNot) {
  EXPECT_NEAR(loadTum(fileWith("0 0 0 0 0 0 0.71 0.71\n")).at(0).pose.phi, M_PI / 2, 1e-12);
  for (const char* quaternion : {"0 0 0 0", "0 0 1 1", "0 0 0 0.5"}) {
    fileWith("0 0 0 0 0 0 0 1\n1 0 0 0 " + std::string(quaternion) + "\n");
    EXPECT_EQ(test::errorOf([&] { loadTum(file); }),
              "broken line: file `" + file + "`, line 2; expected a quaternion `qx qy qz qw` of length 1")
        << quaternion;
  }
}

TEST_F(TrajectoryFile, CoordinatesBeyondTheEarthAreNamed) {
  const std::string error = "broken line: file `" + file + "`, line 2; expected coordinates in -1e7..1e7 m";
  for (const char* xyz : {"1e200 0 0", "0 -10000001 0", "0 0 1e8"}) {
    fileWith("0 0 0 0 0 0 0 1\n1 " + std::string(xyz) + " 0 0 0 1\n");
    EXPECT_EQ(test::errorOf([&] { loadTum(file); }), error) << xyz;
  }
  for (const char* xy : {"-1e200 0", "0 10000001"}) {
    fileWith("0 0 0 0\n1 " + std::string(xy) + " 0\n");
    EXPECT_EQ(test::errorOf([&] { loadOdometry(file); }), error) << xy;
  }
  EXPECT_EQ(test::errorOf([&] { loadOdometry(fileWith("0 0 0 0\n1 0 0 1e200\n")); }),
            "broken line: file `" + file + "`, line 2; expected angles in -1e7..1e7 rad");
  EXPECT_EQ(loadTum(fileWith("0 500000 -10000000 0 0 0 0 1\n")).at(0).pose.y, -1e7);
}

TEST_F(TrajectoryFile, SaveAndLoadRoundTripKeepsTheOrder) {
  RandomStream random(1, 0, 0);
  Trajectory saved;
  for (int i = 0; i < 1000; ++i) {  // timestamps as in real logs: they step back and repeat
    const double t = 1134864629.895182 + std::round(random.uniform() * 100) / 10;
    saved.push_back(
        {t, {100 * random.gaussian(), 100 * random.gaussian(), M_PI * (2 * random.uniform() - 1)}});
  }
  std::ostringstream text;
  saveTum(saved, text);
  const Trajectory loaded = loadTum(fileWith(text.str()));
  ASSERT_EQ(loaded.size(), saved.size());
  for (size_t i = 0; i < saved.size(); ++i) {
    EXPECT_NEAR(loaded[i].timestamp, saved[i].timestamp, 1e-6);
    EXPECT_NEAR(loaded[i].pose.x, saved[i].pose.x, 1e-9);
    EXPECT_NEAR(loaded[i].pose.y, saved[i].pose.y, 1e-9);
    EXPECT_NEAR(loaded[i].pose.phi, saved[i].pose.phi, 4e-9);
  }
}

TEST_F(TrajectoryFile, SavingKeepsTheStreamsFormat) {
  std::ostringstream text;
  saveTum({{12.5, {1, -2, 0}}}, text);
  text << 0.5;
  EXPECT_EQ(text.str(), "12.500000 1.000000000 -2.000000000 0 0 0 0.000000000 1.000000000\n0.5");
}

TEST_F(TrajectoryFile, OdometryKeepsTheOrderOfItsRows) {
  const Trajectory odometry = loadOdometry(fileWith("2 0.5 -1 4\n1 0 0 0\n"));
  ASSERT_EQ(odometry.size(), 2u);
  EXPECT_EQ(odometry[0].timestamp, 2);
  EXPECT_EQ(odometry[0].pose.x, 0.5);
  EXPECT_EQ(odometry[0].pose.y, -1);
  EXPECT_EQ(odometry[0].pose.phi, 4);
  EXPECT_EQ(odometry[1].timestamp, 1);
}

TEST_F(TrajectoryFile, OdometryIsNotMistakenForATrajectory) {
  EXPECT_THROW(loadTum(fileWith("0 0 0 0\n")), InputError);
  EXPECT_THROW(loadOdometry(fileWith("0 0 0 0 0 0 0 1\n")), InputError);
}

}  // namespace
}  // namespace hybrid_slam::files
