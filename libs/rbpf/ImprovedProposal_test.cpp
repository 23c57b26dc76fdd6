#include "rbpf/ImprovedProposal.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include "rbpf/TestRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

const TPose2D kStart(0.4, 0.3, 0.5), kOdometry(0.25, 0.01, 0.05);
const Walls kCorridor{{{-1000, -1.2}, {1000, -1.2}}, {{-1000, 1.2}, {1000, 1.2}}};

FilterConfiguration configuration(bool useLines) {
  FilterConfiguration c = roomConfiguration();
  c.useLines = useLines;
  c.matcher.sigma = 2;  // broad enough to integrate over a lattice of poses
  c.lineWeight.sigma = 3 * kDegree;
  c.improved.minFit = 0;
  return c;
}

PreparedScan prepared(const Walls& walls, const TPose2D& robot, RandomStream& random) {
  const LaserScan scan = scanOf(walls, robot, {0.2, 0, 0}, 181, M_PI, 0.01, random);
  const FilterConfiguration c;
  return {scan, ScanBeams(scan, 1), ScanBeams(scan, 1), ScanBeams(scan, 1),
          LineExtractor(c.segmentation, c.lineFit, c.hough).extract(scan)};
}

/// A particle at `start` that has mapped the walls around.
Particle particleAt(const Walls& walls, const TPose2D& start) {
  RandomStream random(1, 0, 0);
  Particle particle;
  particle.path.push(start);
  for (int i = 0; i < 40; ++i) {
    const TPose2D robot(uniform(random, -1, 1), uniform(random, -0.5, 0.5), uniform(random, -M_PI, M_PI));
    const PreparedScan scan = prepared(walls, robot, random);
    particle.grid.insert(scan.beams, robot, GridOptions());
    std::vector<LineSegment> lines;
    for (const LineSegment& line : scan.lines) lines.push_back(transformed(line, robot));
    particle.lines.write().update(lines, LineDatabaseOptions(), AssociationOptions());
  }
  return particle;
}

/// The scan, a little beside where the odometry says.
PreparedScan scanAfterwards(const Walls& walls, const TPose2D& start) {
  RandomStream random(2, 0, 0);
  return prepared(walls, start + kOdometry + TPose2D(0.01, -0.008, 0.01), random);
}

Eigen::Vector3d offset(const TPose2D& pose, const TPose2D& from) {
  return {pose.x - from.x, pose.y - from.y, mrpt::math::wrapToPi(pose.phi - from.phi)};
}

struct Moments {
  double mass = 0;  ///< or mean weight
  double massError = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< from the motion model's mean
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// p(scan | x, grid) w_line(x) p(x | x', odometry) over a lattice that spans 4.5 deviations of the motion
/// model.
Moments integrated(const FilterConfiguration& c, const Particle& particle, const PreparedScan& scan) {
  const MotionDistribution motion = motionDistribution(particle.path.back(), kOdometry, c.motion);
  const Eigen::Matrix3d root = motion.covariance.llt().matrixL();
  const ScanMatcher matcher(c.matcher);
  constexpr int kHalf = 18;
  constexpr double kStep = 0.25;
  Moments all;
  for (int i = -kHalf; i <= kHalf; ++i)
    for (int j = -kHalf; j <= kHalf; ++j)
      for (int k = -kHalf; k <= kHalf; ++k) {
        const Eigen::Vector3d normal = kStep * Eigen::Vector3d(i, j, k), off = root * normal;
        const TPose2D pose(motion.mean.x + off.x(), motion.mean.y + off.y(), motion.mean.phi + off.z());
        double density = std::exp(matcher.logLikelihoodValue(scan.matchedBeams, pose, particle.grid) -
                                  0.5 * normal.squaredNorm()) *
                         std::pow(kStep / std::sqrt(2 * M_PI), 3);
        if (c.useLines) density *= lineWeight(scan.lines, pose.phi, *particle.lines, c.lineWeight).value;
        all.mass += density;
        all.mean += density * off;
        all.covariance += density * off * off.transpose();
      }
  all.mean /= all.mass;
  all.covariance = (all.covariance / all.mass - all.mean * all.mean.transpose()).eval();
  return all;
}

Moments proposed(const FilterConfiguration& c, const Particle& particle, const PreparedScan& scan,
                 int streams) {
  const TPose2D centre = motionDistribution(particle.path.back(), kOdometry, c.motion).mean;
  const ImprovedProposal proposal(c);
  Moments all;
  double squares = 0;
  for (int i = 0; i < streams; ++i) {
    RandomStream random(3, 0, static_cast<uint64_t>(i));
    const Proposed p = proposal.propose(particle, kOdometry, scan, random);
    EXPECT_EQ(p.isMatched, p.fit >= c.improved.minFit);
    const double weight = std::exp(p.logWeight);
    all.mass += weight / streams, squares += weight * weight / streams;
    const Eigen::Vector3d off = offset(p.pose, centre);
    all.mean += off / streams;
    all.covariance += off * off.transpose() / streams;
  }
  all.covariance -= all.mean * all.mean.transpose();
  all.massError = std::sqrt((squares - all.mass * all.mass) / streams);
  return all;
}

class ImprovedProposals : public testing::TestWithParam<bool> {};

TEST_P(ImprovedProposals, TheWeightIsTheIntegralOfTheTarget) {
  const FilterConfiguration c = configuration(GetParam());
  for (const TPose2D& start : {kStart, TPose2D(-0.5, 0.1, -2), TPose2D(0.4, 0.33, 0.53)}) {
    const Particle particle = particleAt(room(), start);
    const PreparedScan scan = scanAfterwards(room(), start);
    const double expected = integrated(c, particle, scan).mass;
    const Moments matched = proposed(c, particle, scan, 300);
    EXPECT_NEAR(matched.mass / expected, 1, 5 * matched.massError / expected + 0.005);
    EXPECT_LT(matched.massError / expected, 0.05);  // the bound says something
  }
}

/// The same integral from poses of the motion model: what lets both kinds of particles be compared.
TEST_P(ImprovedProposals, WithoutAMatchTheWeightsMeanIsTheSameIntegral) {
  FilterConfiguration c = configuration(GetParam());
  c.improved.minFit = 1;
  const Particle particle = particleAt(room(), kStart);
  const PreparedScan scan = scanAfterwards(room(), kStart);
  const double expected = integrated(c, particle, scan).mass;
  const Moments unmatched = proposed(c, particle, scan, 20000);
  EXPECT_NEAR(unmatched.mass / expected, 1, 5 * unmatched.massError / expected + 0.01);
  EXPECT_LT(unmatched.massError / expected, 0.05);
  const MotionDistribution motion = motionDistribution(kStart, kOdometry, c.motion);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(unmatched.covariance(k, k) / motion.covariance(k, k), 1, 5 * std::sqrt(2.0 / 20000) + 0.01);
}

TEST_P(ImprovedProposals, ThePosesAreThoseOfTheTarget) {
  FilterConfiguration c = configuration(GetParam());
  c.improved.samples = 100;
  constexpr int kStreams = 1000;
  const Particle particle = particleAt(room(), kStart);
  const PreparedScan scan = scanAfterwards(room(), kStart);
  const Moments expected = integrated(c, particle, scan), drawn = proposed(c, particle, scan, kStreams);
  const Eigen::Vector3d sigma = expected.covariance.diagonal().cwiseSqrt();
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(drawn.mean[i], expected.mean[i], 5 * sigma[i] / std::sqrt(kStreams));
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(drawn.covariance(i, j), expected.covariance(i, j),
                  5 * std::sqrt(2.0 / kStreams) * sigma[i] * sigma[j]);
  }
}

TEST_P(ImprovedProposals, ACorridorKeepsTheSpreadAlongIt) {
  FilterConfiguration c = configuration(GetParam());
  c.matcher.sigma = 0.5;
  c.motion.distance.varianceD = 0.04;  // 5 cm
  const TPose2D start(-0.3, 0.1, 0);
  const Particle particle = particleAt(kCorridor, start);
  const Moments drawn = proposed(c, particle, scanAfterwards(kCorridor, start), 500);
  const Eigen::Matrix3d motion = motionDistribution(start, kOdometry, c.motion).covariance;
  EXPECT_GT(std::sqrt(drawn.covariance(0, 0) / motion(0, 0)), 0.7);
  EXPECT_LT(std::sqrt(drawn.covariance(1, 1) / motion(1, 1)), 0.5);
}

TEST_P(ImprovedProposals, NothingSeenOrMappedLeavesTheMotionModel) {
  FilterConfiguration c = configuration(GetParam());
  c.improved.minFit = 0.01;
  Particle particle = particleAt(room(), kStart);
  PreparedScan scan = scanAfterwards(room(), kStart);
  Particle blank;
  blank.path.push(kStart);
  RandomStream random(5, 0, 0);
  EXPECT_FALSE(ImprovedProposal(c).propose(blank, kOdometry, scan, random).isMatched);
  scan.matchedBeams.rays.clear(), scan.lines.clear();
  const Proposed p = ImprovedProposal(c).propose(particle, kOdometry, scan, random);
  EXPECT_FALSE(p.isMatched);
  EXPECT_EQ(p.fit, 0);
  EXPECT_EQ(p.logWeight, 0);
}

TEST_P(ImprovedProposals, AMotionModelWithoutNoiseIsFollowed) {
  FilterConfiguration c = configuration(GetParam());
  for (MotionTerm* term : {&c.motion.distance, &c.motion.drift, &c.motion.turn})
    term->varianceD = term->varianceT = 0;
  c.motion.minStdXY = c.motion.minStdPhi = 0;
  const Particle particle = particleAt(room(), kStart);
  RandomStream random(6, 0, 0);
  const Proposed p = ImprovedProposal(c).propose(particle, kOdometry, scanAfterwards(room(), kStart), random);
  EXPECT_TRUE(std::isfinite(p.logWeight));
  EXPECT_LT(offset(p.pose, kStart + kOdometry).norm(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(All, ImprovedProposals, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "WithLines" : "WithoutLines"; });

TEST(LineLogDensity, IsTheLogarithmOfTheWeightWithItsGradient) {
  const Particle particle = particleAt(room(), kStart);
  const PreparedScan scan = scanAfterwards(room(), kStart);
  ASSERT_TRUE(particle.lines->dominatingDirection());
  RandomStream random(7, 0, 0);
  LineWeightOptions options;
  int sloped = 0;
  for (int i = 0; i < 500; ++i) {
    const double heading = kStart.phi + 0.06 * random.gaussian();
    const auto ln = [&](double at) {
      return std::log(lineWeight(scan.lines, at, *particle.lines, options).value);
    };
    const LogDensity density = lineLogDensity(scan.lines, heading, *particle.lines, options);
    EXPECT_EQ(density.value, ln(heading));
    EXPECT_EQ(density.gradient.x(), 0);
    EXPECT_EQ(density.gradient.y(), 0);
    EXPECT_GE(density.information(2, 2), 0);
    const double below = ln(heading - 1e-6), above = ln(heading + 1e-6), floor = std::log(options.floor);
    if ((below == floor) != (above == floor)) continue;  // the edge of the floor has no slope
    EXPECT_NEAR(density.gradient.z(), (above - below) / 2e-6, 1e-4 * (1 + std::abs(density.gradient.z())));
    sloped += density.gradient.z() != 0;
  }
  EXPECT_GT(sloped, 100);
}

TEST(LineLogDensity, EqNinesStepsHaveNoSlope) {
  const Particle particle = particleAt(room(), kStart);
  const PreparedScan scan = scanAfterwards(room(), kStart);
  LineWeightOptions options;
  options.method = LineWeightOptions::Method::paper;
  const LogDensity density = lineLogDensity(scan.lines, kStart.phi + 0.2, *particle.lines, options);
  EXPECT_EQ(density.value,
            std::log(lineWeight(scan.lines, kStart.phi + 0.2, *particle.lines, options).value));
  EXPECT_EQ(density.gradient, Eigen::Vector3d::Zero());
  EXPECT_EQ(density.information, Eigen::Matrix3d::Zero());
}

}  // namespace
}  // namespace hybrid_slam
