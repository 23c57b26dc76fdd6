#include "study/simulation/WheelOdometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <cmath>

#include "base/Errors.h"
#include "base/RandomStream.h"
#include "testing/CommaLocale.h"

namespace hybrid_slam::simulation {
namespace {

OdometryOptions perfect() {
  OdometryOptions o;
  o.meanDd = o.meanTt = 1;
  o.meanDt = o.meanCd = o.meanCt = o.meanTd = 0;
  o.sigmaDd = o.sigmaDt = o.sigmaCd = o.sigmaCt = o.sigmaTd = o.sigmaTt = 0;
  return o;
}

/// Mean and standard deviation of many draws, with their own standard errors.
struct Statistics {
  double sum = 0, squares = 0, n = 0;
  void add(double v) {
    sum += v;
    squares += v * v;
    ++n;
  }
  double mean() const { return sum / n; }
  double sigma() const { return std::sqrt(squares / n - mean() * mean()); }
};

void expectNormal(const Statistics& s, double mean, double sigma) {
  EXPECT_NEAR(s.mean(), mean, 4 * sigma / std::sqrt(s.n) + 1e-12);
  EXPECT_NEAR(s.sigma(), sigma, 4 * sigma / std::sqrt(2 * s.n) + 1e-7);
}

TEST(WheelOdometry, PerfectWheelsAreExactOnStraightsCurvesAndTurns) {
  WheelOdometry wheels(perfect());
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 40; ++i) wheels.move(0.05, 0, random);              // 2 m ahead
  for (int i = 0; i < 7; ++i) wheels.move(M_PI / 14, M_PI / 14, random);  // a quarter circle of 1 m
  for (int i = 0; i < 3; ++i) wheels.move(0, -M_PI / 6, random);          // and back on the spot
  EXPECT_NEAR(wheels.pose().x, 3, 1e-12);
  EXPECT_NEAR(wheels.pose().y, 1, 1e-12);
  EXPECT_NEAR(wheels.pose().phi, 0, 1e-12);
}

TEST(WheelOdometry, OneMotionHasTheMeansAndSigmasOfItsParameters) {
  OdometryOptions o = perfect();
  o.meanDd = 1.1;
  o.meanDt = 0.02;
  o.meanCd = -0.03;
  o.meanCt = 0.04;
  o.meanTd = 0.05;
  o.meanTt = 0.9;
  o.sigmaDd = 0.02;
  o.sigmaDt = 0.03;
  o.sigmaCd = 0.01;
  o.sigmaCt = 0.015;
  o.sigmaTd = 0.01;
  o.sigmaTt = 0.02;
  for (const double d : {0.0, 0.3, -0.2})
    for (const double t : {0.0, 0.4, -0.25}) {
      Statistics forwards, sideways, rotation;
      for (uint64_t k = 0; k < 20000; ++k) {
        WheelOdometry wheels(o);
        RandomStream random(2, k, 0);
        wheels.move(d, t, random);
        // Back from the pose to D, C, T along the middle heading.
        const auto& p = wheels.pose();
        const double half = p.phi / 2, chord = half == 0 ? 1 : std::sin(half) / half;
        forwards.add((p.x * std::cos(half) + p.y * std::sin(half)) / chord);
        sideways.add((-p.x * std::sin(half) + p.y * std::cos(half)) / chord);
        rotation.add(p.phi);
      }
      const auto sigma = [&](double perD, double perT) {
        return std::sqrt(std::abs(d) * perD * perD + std::abs(t) * perT * perT);
      };
      expectNormal(forwards, d * o.meanDd + t * o.meanDt, sigma(o.sigmaDd, o.sigmaDt));
      expectNormal(sideways, d * o.meanCd + t * o.meanCt, sigma(o.sigmaCd, o.sigmaCt));
      expectNormal(rotation, d * o.meanTd + t * o.meanTt, sigma(o.sigmaTd, o.sigmaTt));
    }
}

TEST(WheelOdometry, TheErrorOfAPathDoesNotDependOnTheNumberOfReadings) {
  for (const int steps : {1, 10, 100}) {
    OdometryOptions o = perfect();
    o.sigmaDd = 0.03;
    o.sigmaTt = 0.02;
    Statistics distance, rotation;
    for (uint64_t k = 0; k < 4000; ++k) {
      WheelOdometry straight(o), turning(o);
      RandomStream random(3, k, static_cast<uint64_t>(steps));
      for (int i = 0; i < steps; ++i) straight.move(4.0 / steps, 0, random);
      for (int i = 0; i < steps; ++i) turning.move(0, 1.0 / steps, random);
      distance.add(straight.pose().x);
      rotation.add(turning.pose().phi);
    }
    expectNormal(distance, 4, 0.03 * 2);
    expectNormal(rotation, 1, 0.02);
  }
}

TEST(WheelOdometry, StandingStillReadsNothing) {
  WheelOdometry wheels(OdometryOptions{});
  RandomStream random(4, 0, 0);
  for (int i = 0; i < 100; ++i) wheels.move(0, 0, random);
  EXPECT_EQ(wheels.pose(), mrpt::math::TPose2D(0, 0, 0));
}

TEST(WheelOdometry, ReadingsAreRoundedAsTheControllerDoes) {
  WheelOdometry wheels(perfect());
  RandomStream random(5, 0, 0);
  wheels.move(1.23456, 0, random);
  wheels.move(0, 0.1, random);
  EXPECT_NEAR(wheels.reading().x, 1.235, 1e-12);
  EXPECT_NEAR(wheels.reading().phi, 65 * 2 * M_PI / 4096, 1e-12);
}

TEST(WheelOdometry, ASlipMovesOnlyTheOdometry) {
  WheelOdometry wheels(perfect());
  wheels.slip({0, mrpt::DEG2RAD(30.0), 0.2});
  const double half = mrpt::DEG2RAD(15.0), chord = 0.2 * std::sin(half) / half;
  EXPECT_NEAR(wheels.pose().x, chord * std::cos(half), 1e-12);
  EXPECT_NEAR(wheels.pose().y, chord * std::sin(half), 1e-12);
  EXPECT_NEAR(wheels.pose().phi, mrpt::DEG2RAD(30.0), 1e-12);
}

TEST(ParseSlips, TakesAListAndNamesWhatIsWrong) {
  EXPECT_TRUE(parseSlips("").empty());
  const auto slips = parseSlips("10 30 0.2, 20.5 -5 0");
  ASSERT_EQ(slips.size(), 2u);
  EXPECT_EQ(slips[0].time, 10);
  EXPECT_NEAR(slips[0].rotation, mrpt::DEG2RAD(30.0), 1e-12);
  EXPECT_EQ(slips[0].distance, 0.2);
  EXPECT_EQ(slips[1].time, 20.5);
  for (const char* wrong : {"10", "10 30", "10 30 x", "10 30 0.2 1", "-1 30 0.2", "10 30 0.2,,20 1 1", "a"})
    EXPECT_THROW(parseSlips(wrong), InputError) << wrong;
}

TEST(ParseSlips, IsTheSameInEveryLocale) {
  const test::CommaLocale german;
  const auto slips = parseSlips("20.5 -5 0.25");
  ASSERT_EQ(slips.size(), 1u);
  EXPECT_EQ(slips[0].time, 20.5);
  EXPECT_EQ(slips[0].distance, 0.25);
}

}  // namespace
}  // namespace hybrid_slam::simulation
