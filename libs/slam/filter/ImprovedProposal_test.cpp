#include "slam/filter/ImprovedProposal.h"

#include <gtest/gtest.h>

#include "base/PoseOffset.h"
#include "slam/filter/LineLikelihood.h"
#include "testing/MappedRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

const TPose2D kStart(0.4, 0.3, 0.5), kOdometry(0.25, 0.01, 0.05);
/// The robot's motion in addition to its odometry.
const TPose2D kMore(0.01, -0.008, 0.01);
const StepMotion kMotion{kOdometry, kOdometry, false};

FilterConfiguration matchedRoom(bool useLines) {
  FilterConfiguration c = test::roomConfiguration();
  c.useLines = useLines;
  c.matcher.sigma = 2;  // broad enough to integrate over a lattice of poses
  c.improved.lineSigma = 3 * kDegree;
  c.improved.minFit = 0;
  return c;
}

ImprovedProposal proposalOf(const FilterConfiguration& c) {
  return {c.improved, c.motion, c.matcher, WeightTerms(c)};
}

/// A scan whose true pose differs slightly from the odometry.
PreparedScan scanAfterwards(const test::Walls& walls, const TPose2D& start) {
  RandomStream random(2, 0, 0);
  return test::prepared(walls, start + kOdometry + kMore, random);
}

struct Moments {
  double mass = 0;  ///< or mean weight
  double massError = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< from the motion model's mean
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// p(scan | x, grid) p(lines | x, database) p(x | x', odometry) over a lattice that spans 4.5 deviations of
/// the motion model.
Moments integrated(const FilterConfiguration& c, const Particle& particle, const PreparedScan& scan) {
  const MotionDistribution motion =
      motionDistribution(particle.path.back(), kOdometry, MotionBelief().model(c.motion));
  const Eigen::Matrix3d root = motion.covariance.llt().matrixL();
  ScanLikelihood likelihood = ScanMatcher(c.matcher).likelihood(scan.matchedBeams, particle.grid);
  const LineLikelihoodOptions options(c.lineWeight, c.association, c.database.minCount, c.improved);
  const LineLikelihood lines(scan.lines, motion.mean, *particle.lines, options);
  constexpr int kHalf = 18;
  constexpr double kStep = 0.25;
  Moments all;
  for (int i = -kHalf; i <= kHalf; ++i)
    for (int j = -kHalf; j <= kHalf; ++j)
      for (int k = -kHalf; k <= kHalf; ++k) {
        const Eigen::Vector3d normal = kStep * Eigen::Vector3d(i, j, k), off = root * normal;
        const TPose2D pose(motion.mean.x + off.x(), motion.mean.y + off.y(), motion.mean.phi + off.z());
        double density = std::exp(likelihood.value(pose) - 0.5 * normal.squaredNorm()) *
                         std::pow(kStep / std::sqrt(2 * M_PI), 3);
        if (c.useLines) density *= std::exp(lines(pose).value);
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
  const TPose2D centre =
      motionDistribution(particle.path.back(), kOdometry, MotionBelief().model(c.motion)).mean;
  const ImprovedProposal proposal = proposalOf(c);
  Moments all;
  double squares = 0;
  for (int i = 0; i < streams; ++i) {
    RandomStream random(3, 0, static_cast<uint64_t>(i));
    const Proposed p = proposal.propose(particle, kMotion, scan, random);
    EXPECT_EQ(p.isMatched, p.fit >= c.improved.minFit);
    const double weight = std::exp(p.logWeight);
    all.mass += weight / streams, squares += weight * weight / streams;
    const Eigen::Vector3d off = offsetOf(p.pose, centre);
    all.mean += off / streams;
    all.covariance += off * off.transpose() / streams;
  }
  all.covariance -= all.mean * all.mean.transpose();
  all.massError = std::sqrt((squares - all.mass * all.mass) / streams);
  return all;
}

class ImprovedProposals : public testing::TestWithParam<bool> {};

TEST_P(ImprovedProposals, TheWeightIsTheIntegralOfTheTarget) {
  const FilterConfiguration c = matchedRoom(GetParam());
  for (const TPose2D& start : {kStart, TPose2D(-0.5, 0.1, -2), TPose2D(0.4, 0.33, 0.53)}) {
    const Particle particle = test::particleAt(test::room(), start);
    const PreparedScan scan = scanAfterwards(test::room(), start);
    const double expected = integrated(c, particle, scan).mass;
    const Moments matched = proposed(c, particle, scan, 300);
    EXPECT_NEAR(matched.mass / expected, 1, 5 * matched.massError / expected + 0.005);
    EXPECT_LT(matched.massError / expected, 0.05);  // the bound is not trivial
  }
}

/// Poses of the motion model give the same integral, so both kinds of particles are comparable.
TEST_P(ImprovedProposals, WithoutAMatchTheWeightsMeanIsTheSameIntegral) {
  FilterConfiguration c = matchedRoom(GetParam());
  c.improved.minFit = 1;
  const Particle particle = test::particleAt(test::room(), kStart);
  const PreparedScan scan = scanAfterwards(test::room(), kStart);
  const double expected = integrated(c, particle, scan).mass;
  const Moments unmatched = proposed(c, particle, scan, 20000);
  EXPECT_NEAR(unmatched.mass / expected, 1, 5 * unmatched.massError / expected + 0.01);
  EXPECT_LT(unmatched.massError / expected, 0.05);
  const MotionDistribution motion = motionDistribution(kStart, kOdometry, MotionBelief().model(c.motion));
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(unmatched.covariance(k, k) / motion.covariance(k, k), 1, 5 * std::sqrt(2.0 / 20000) + 0.01);
}

TEST_P(ImprovedProposals, ThePosesAreThoseOfTheTarget) {
  FilterConfiguration c = matchedRoom(GetParam());
  c.improved.samples = 100;
  constexpr int kStreams = 1000;
  const Particle particle = test::particleAt(test::room(), kStart);
  const PreparedScan scan = scanAfterwards(test::room(), kStart);
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
  FilterConfiguration c = matchedRoom(GetParam());
  c.matcher.sigma = 0.35;              // the default, 0.3, keeps only 0.6 of the spread along the corridor
  c.motion.distance.varianceD = 0.04;  // 5 cm
  const TPose2D start(-0.3, 0.1, 0);
  const Particle particle = test::particleAt(kCorridor, start);
  const Moments drawn = proposed(c, particle, scanAfterwards(kCorridor, start), 500);
  const Eigen::Matrix3d motion =
      motionDistribution(start, kOdometry, MotionBelief().model(c.motion)).covariance;
  EXPECT_GT(std::sqrt(drawn.covariance(0, 0) / motion(0, 0)), 0.7);
  EXPECT_LT(std::sqrt(drawn.covariance(1, 1) / motion(1, 1)), 0.5);
}

TEST_P(ImprovedProposals, AnEmptyScanOrMapLeavesTheMotionModel) {
  FilterConfiguration c = matchedRoom(GetParam());
  c.improved.minFit = 0.01;
  Particle particle = test::particleAt(test::room(), kStart);
  PreparedScan scan = scanAfterwards(test::room(), kStart);
  Particle blank;
  blank.path.push(kStart);
  RandomStream random(5, 0, 0);
  EXPECT_FALSE(proposalOf(c).propose(blank, kMotion, scan, random).isMatched);
  scan.matchedBeams.rays.clear(), scan.lines.clear();
  const Proposed p = proposalOf(c).propose(particle, kMotion, scan, random);
  EXPECT_FALSE(p.isMatched);
  EXPECT_EQ(p.fit, 0);
  EXPECT_EQ(p.logWeight, 0);

  // The poses are those of the motion model.
  const MotionDistribution motion = motionDistribution(kStart, kOdometry, MotionBelief().model(c.motion));
  constexpr int kDraws = 4000;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), variance = Eigen::Vector3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d off =
        offsetOf(proposalOf(c).propose(particle, kMotion, scan, random).pose, motion.mean);
    mean += off / kDraws;
    variance += off.cwiseAbs2() / kDraws;
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(mean[i], 0, 5 * std::sqrt(motion.covariance(i, i) / kDraws)) << i;
    EXPECT_NEAR(variance[i] / motion.covariance(i, i), 1, 0.15) << i;
  }
}

TEST_P(ImprovedProposals, AMotionModelWithoutNoiseIsFollowed) {
  FilterConfiguration c = matchedRoom(GetParam());
  for (MotionTerm* term : {&c.motion.distance, &c.motion.drift, &c.motion.turn})
    term->varianceD = term->varianceT = term->meanStd = 0;
  c.motion.minStdXY = c.motion.minStdPhi = 0;
  const Particle particle = test::particleAt(test::room(), kStart);
  RandomStream random(6, 0, 0);
  const Proposed p = proposalOf(c).propose(particle, kMotion, scanAfterwards(test::room(), kStart), random);
  EXPECT_TRUE(std::isfinite(p.logWeight));
  EXPECT_LT(offsetOf(p.pose, kStart + kOdometry).norm(), 1e-3);
}

/// At the odometry's pose no line is near its wall; at the search result all are.
TEST(ImprovedProposal, AfterASlipLinesKeepTheDistanceToTheirWalls) {
  FilterConfiguration c;
  c.improved.minFit = 0;
  const StepMotion slipped{kOdometry, kOdometry + TPose2D(0, 0, 30 * kDegree), true};
  const TPose2D truth = kStart + slipped.start;
  const std::vector<LineSegment> walls = {makeSegment({2, -3}, {2, 3}), makeSegment({-4, 3}, {2, 3})};
  Particle particle;  // no grid and no beams: only the lines constrain the pose
  particle.path.push(kStart);
  for (int i = 0; i < c.database.minCount; ++i)
    particle.lines.write().update(walls, c.database, c.association);
  const ScanBeams none{LaserScan()};
  PreparedScan scan{{}, none, none, none, {}};
  scan.lines = transformed(walls, TPose2D() - truth);

  constexpr int kDraws = 500;
  RandomStream random(8, 0, 0);
  double square = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Proposed p = proposalOf(c).propose(particle, slipped, scan, random);
    square += offsetOf(p.pose, truth).head<2>().squaredNorm() / kDraws;
  }
  // Each wall has half of the weight: 2 sigma for both directions together, and a margin for the tails.
  EXPECT_LT(std::sqrt(square), 2.5 * c.improved.lineSigmaRho);
}

/// The paper's Fig. 5: lines do not narrow the spread along a corridor.
TEST(ImprovedProposal, AKnownPillarNarrowsTheSpreadAlongACorridor) {
  FilterConfiguration c;
  c.matcher.sigma = 0.35;
  c.motion.distance.varianceD = 0.04;
  c.features.enabled = true;
  const TPose2D start(-0.3, 0.1, 0), truth = start + kOdometry + kMore;
  PreparedScan scan = scanAfterwards(kCorridor, start);
  PointFeature pillar;
  pillar.kind = FeatureKind::pillar;
  pillar.radius = 0.2;
  pillar.covariance = 0.01 * 0.01 * Eigen::Matrix2d::Identity();
  pillar.position = truth.inverseComposePoint({3, 0.9});
  scan.features = {pillar};
  Particle particle = test::particleAt(kCorridor, start);
  const double without = proposed(c, particle, scan, 300).covariance(0, 0);
  for (int i = 0; i < 10; ++i) particle.features.write().update({transformed(pillar, truth)}, c.features);
  const Moments with = proposed(c, particle, scan, 300);
  EXPECT_GT(std::sqrt(without), 0.03);
  EXPECT_LT(std::sqrt(with.covariance(0, 0)), 0.015);
  const TPose2D centre = motionDistribution(start, kOdometry, MotionBelief().model(c.motion)).mean;
  EXPECT_NEAR(with.mean.x(), truth.x - centre.x, 0.015);
}

INSTANTIATE_TEST_SUITE_P(All, ImprovedProposals, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "WithLines" : "WithoutLines"; });

}  // namespace
}  // namespace hybrid_slam
