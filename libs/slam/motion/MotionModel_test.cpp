#include "slam/motion/MotionModel.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <vector>

#include "base/Degree.h"
#include "base/PoseOffset.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

constexpr int kDraws = 100000;
// Standard errors of the mean (sigma / sqrt n) and the variance (sigma^2 sqrt(2 / n)) of normal numbers.
constexpr double kDeviations = 5;

/// D, C and T of each draw, recovered from the pose increments.
struct Samples {
  std::vector<double> distance, drift, turn;
};

Samples sample(const TPose2D& odometry, const MotionModelOptions& options) {
  Samples all;
  RandomStream random(1, 2, 3);
  for (int i = 0; i < kDraws; ++i) {
    const TPose2D p = sampleMotion(odometry, options, random);
    const double c = std::cos(p.phi / 2), s = std::sin(p.phi / 2);
    all.distance.push_back(c * p.x + s * p.y);
    all.drift.push_back(-s * p.x + c * p.y);
    all.turn.push_back(p.phi);
  }
  return all;
}

void expectNormal(const std::vector<double>& values, double mean, double variance, const char* name) {
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += std::pow(v - sum / n, 2);
  EXPECT_NEAR(sum / n, mean, kDeviations * std::sqrt(variance / n)) << name;
  EXPECT_NEAR(squares / (n - 1), variance, kDeviations * variance * std::sqrt(2 / n)) << name;
}

/// The formulas of MotionTerm, with d along the odometry's mean heading; its sideways motion is kept.
void expectMoments(const TPose2D& odometry, const MotionModelOptions& o) {
  const double c = std::cos(odometry.phi / 2), s = std::sin(odometry.phi / 2);
  const double d = c * odometry.x + s * odometry.y, sideways = -s * odometry.x + c * odometry.y;
  const double t = odometry.phi;
  const auto mean = [&](const MotionTerm& term) { return term.meanD * d + term.meanT * t; };
  const auto variance = [&](const MotionTerm& term, double minStd) {
    return term.varianceD * d * d + term.varianceT * t * t + minStd * minStd;
  };
  const Samples all = sample(odometry, o);
  expectNormal(all.distance, mean(o.distance), variance(o.distance, o.minStdXY), "distance");
  expectNormal(all.drift, sideways + mean(o.drift), variance(o.drift, o.minStdXY), "drift");
  expectNormal(all.turn, mean(o.turn), variance(o.turn, o.minStdPhi), "turn");
}

MotionModelOptions biased() {
  MotionModelOptions o;
  o.distance = {0.97, 0.02, 0.004, 0.0009};
  o.drift = {0.01, -0.03, 0.0016, 0.0001};
  o.turn = {0.05, 1.04, 0.01, 0.0025};
  return o;
}

TEST(MotionModel, SampledMomentsFollowTheFormulas) {
  for (const MotionModelOptions& options : {MotionModelOptions(), biased()})
    for (const TPose2D& odometry :
         {TPose2D(0.5, 0, 0), TPose2D(-0.3, 0, 0), TPose2D(0.4, 0.05, 0.2), TPose2D(0.1, -0.02, -0.6)}) {
      SCOPED_TRACE(odometry.asString());
      expectMoments(odometry, options);
    }
}

TEST(MotionModel, TheVarianceOfALongStepIsThatOfSeveralShortOnes) {
  const MotionTerm term{1, 0, 0.004, 0.006};
  const double one = term.variance(MotionStep(kLongestStep, 0, 0), 0);
  EXPECT_DOUBLE_EQ(one, 0.004 * kLongestStep * kLongestStep);
  for (const int steps : {2, 7, 20}) {
    EXPECT_NEAR(term.variance(MotionStep(steps * kLongestStep, 0, 0), 0), steps * one, 1e-12);
    EXPECT_NEAR(term.variance(MotionStep(-steps * kLongestStep, 0, 0), 0), steps * one, 1e-12);
  }
}

TEST(MotionModel, TheVarianceOfSidewaysMotionIsThatOfItsLength) {
  const MotionTerm term{1, 0, 0.004, 0.001};
  const auto variance = [&term](double distance, double drift) {
    return term.variance(MotionStep(distance, drift, 0), 0);
  };
  EXPECT_NEAR(variance(0, 0.5), 0.004 * 0.48 * 0.48, 1e-12);
  EXPECT_EQ(variance(0, -0.5), variance(0, 0.5));
  EXPECT_NEAR(variance(0, 3), 0.004 * kLongestStep * 2.98, 1e-12) << "several short ones";
  EXPECT_NEAR(variance(0.3, 0.5), 0.004 * (0.3 * 0.3 + 0.2 * 0.2), 1e-12);
  for (const double drift : {0.02, 0.1, 0.3}) EXPECT_EQ(variance(0.3, drift), variance(0.3, 0)) << "an arc";
  EXPECT_EQ(variance(0, 0.02), 0) << "an error";
}

TEST(MotionModel, NoVarianceIsNegativeWhereTheMeansAreCorrelated) {
  MotionTerm term{1, 0, 0.004, 0.006};
  term.covariance = std::sqrt(0.004 * 0.006);
  for (const double distance : {-30., -1., 1., 30.})
    for (double turn = -3; turn <= 3; turn += 0.01)
      EXPECT_GE(term.variance(MotionStep(distance, 0, turn), 0), -1e-12);
}

TEST(MotionModel, PureRotationMovesTheRobotOnlyByWhatTheTurnAllows) {
  expectMoments({0, 0, 0.8}, MotionModelOptions());
  MotionModelOptions exact = biased();  // no noise: D = mu_Dt t, C = mu_Ct t, T = mu_Tt t
  exact.minStdXY = exact.minStdPhi = 0;
  for (MotionTerm* term : {&exact.distance, &exact.drift, &exact.turn}) term->varianceD = term->varianceT = 0;
  RandomStream random(1, 0, 0);
  const TPose2D p = sampleMotion({0, 0, 0.8}, exact, random);
  EXPECT_NEAR(p.phi, 1.04 * 0.8, 1e-12);
  const double heading = p.phi / 2, d = 0.02 * 0.8, c = -0.03 * 0.8;
  EXPECT_NEAR(p.x, std::cos(heading) * d - std::sin(heading) * c, 1e-12);
  EXPECT_NEAR(p.y, std::sin(heading) * d + std::cos(heading) * c, 1e-12);
}

TEST(MotionModel, ZeroMotionGivesOnlyTheMinimumDeviations) {
  const MotionModelOptions options = biased();
  const Samples all = sample({0, 0, 0}, options);
  expectNormal(all.distance, 0, options.minStdXY * options.minStdXY, "distance");
  expectNormal(all.drift, 0, options.minStdXY * options.minStdXY, "drift");
  expectNormal(all.turn, 0, options.minStdPhi * options.minStdPhi, "turn");
}

TEST(MotionModel, WithoutNoiseTheMotionIsTheOdometry) {
  MotionModelOptions exact;
  exact.minStdXY = exact.minStdPhi = 0;
  for (MotionTerm* term : {&exact.distance, &exact.drift, &exact.turn}) term->varianceD = term->varianceT = 0;
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    // Sideways as well: the origin of the robot frame is not always between the wheels.
    const TPose2D odometry(2 * random.uniform() - 1, 2 * random.uniform() - 1, 6 * random.uniform() - 3);
    const TPose2D p = sampleMotion(odometry, exact, random);
    ASSERT_NEAR(p.x, odometry.x, 1e-12);
    ASSERT_NEAR(p.y, odometry.y, 1e-12);
    ASSERT_NEAR(p.phi, odometry.phi, 1e-12);
  }
}

TEST(MotionModel, DistanceDriftAndTurnAreDrawnIndependently) {
  const Samples all = sample({0.5, 0, 0.3}, biased());
  const auto correlation = [](const std::vector<double>& a, const std::vector<double>& b) {
    double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
    for (size_t i = 0; i < a.size(); ++i) ma += a[i] / kDraws, mb += b[i] / kDraws;
    for (size_t i = 0; i < a.size(); ++i) {
      ab += (a[i] - ma) * (b[i] - mb), aa += (a[i] - ma) * (a[i] - ma), bb += (b[i] - mb) * (b[i] - mb);
    }
    return ab / std::sqrt(aa * bb);
  };
  const double bound = kDeviations / std::sqrt(kDraws);
  EXPECT_NEAR(correlation(all.distance, all.drift), 0, bound);
  EXPECT_NEAR(correlation(all.distance, all.turn), 0, bound);
  EXPECT_NEAR(correlation(all.drift, all.turn), 0, bound);
}

/// The approximation is linear, so its error is of second order: |D| sigma_T^2 / 8 in the position, and that
/// times the standard deviation in the covariance. The rest of the bound is the sampling error of mean and
/// covariance.
TEST(MotionModel, TheDistributionMatchesTheSamples) {
  for (const MotionModelOptions& options : {MotionModelOptions(), biased()})
    for (const double heading : {0.0, 1.2, -2.5, 3.1})
      for (const TPose2D& odometry : {TPose2D(0.5, 0, 0), TPose2D(0.4, 0.05, 0.3), TPose2D(0, 0, 0.8),
                                      TPose2D(0.3, -0.02, -0.9), TPose2D(0, 0, 0)}) {
        SCOPED_TRACE(odometry.asString() + " from " + std::to_string(heading));
        const TPose2D start(3, -2, heading);
        const MotionDistribution normal = motionDistribution(start, odometry, options);
        RandomStream random(4, 0, 0);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
        for (int i = 0; i < kDraws; ++i) {
          const TPose2D pose = start + sampleMotion(odometry, options, random);
          const Eigen::Vector3d off = offsetOf(pose, normal.mean);
          sum += off, squares += off * off.transpose();
        }
        const Eigen::Vector3d mean = sum / kDraws, sigma = normal.covariance.diagonal().cwiseSqrt();
        const Eigen::Matrix3d covariance = squares / kDraws - mean * mean.transpose();
        const double bend = sigma.z() * sigma.z() / 8 * (odometry.norm() + 5 * sigma.head<2>().norm());
        for (int i = 0; i < 3; ++i) {
          EXPECT_NEAR(mean[i], 0, kDeviations * sigma[i] / std::sqrt(kDraws) + (i < 2 ? bend : 0)) << i;
          for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(covariance(i, j), normal.covariance(i, j),
                        kDeviations * sigma[i] * sigma[j] * std::sqrt(2.0 / kDraws) +
                            2 * bend * (sigma[i] + sigma[j]))
                << i << j;
        }
      }
}

TEST(MotionModel, AStepAndItsIncrementAreEquivalent) {
  // A quarter turn to the left, seen along 45 deg.
  const MotionStep quarter(TPose2D(1, 1, M_PI / 2));
  EXPECT_NEAR(quarter.distance, std::sqrt(2), 1e-12);
  EXPECT_NEAR(quarter.drift, 0, 1e-12);
  EXPECT_EQ(quarter.turn, M_PI / 2);
  const TPose2D p(0.3, -0.2, -0.7), back = MotionStep(p).increment();
  EXPECT_NEAR(back.x, p.x, 1e-12);
  EXPECT_NEAR(back.y, p.y, 1e-12);
  EXPECT_EQ(back.phi, p.phi);
}

TEST(MotionModel, MrptsGaussianModelGetsTheDeviations) {
  MotionModelOptions o;
  o.distance = {1, 0, 0.04, 0.0016};
  o.drift = {0, 0, 0.02, 0.0004};
  o.turn = {0, 1, 0.0025, 0.01};
  o.minStdXY = 0.007, o.minStdPhi = 0.3 * kDegree;
  const auto mrptModel = toMrpt(o);
  EXPECT_EQ(mrptModel.modelSelection, mrpt::obs::CActionRobotMovement2D::mmGaussian);
  EXPECT_DOUBLE_EQ(mrptModel.gaussianModel.a1, std::sqrt(0.03));   // m/m, both axes alike
  EXPECT_DOUBLE_EQ(mrptModel.gaussianModel.a2, std::sqrt(0.001));  // m/rad
  EXPECT_DOUBLE_EQ(mrptModel.gaussianModel.a3, 0.05);              // rad/m
  EXPECT_DOUBLE_EQ(mrptModel.gaussianModel.a4, 0.1);               // rad/rad
  EXPECT_DOUBLE_EQ(mrptModel.gaussianModel.minStdXY, 0.007);
  EXPECT_DOUBLE_EQ(mrptModel.gaussianModel.minStdPHI, 0.3 * kDegree);
  o.turn.meanStd = 0.2;  // MRPT's model does not learn: it treats this as noise
  EXPECT_DOUBLE_EQ(toMrpt(o).gaussianModel.a3, std::sqrt(0.0025 + 0.04));
}

TEST(MotionModel, AnActionKeepsTheRawIncrementAndHasItAsItsMean) {
  const TPose2D odometry(0.4, -0.03, 0.25);
  const MotionModelOptions options;
  const auto action = toAction(odometry, options);
  EXPECT_EQ(action.estimationMethod, mrpt::obs::CActionRobotMovement2D::emOdometry);
  EXPECT_EQ(action.rawOdometryIncrementReading.asTPose(), odometry);
  const TPose2D mean = action.poseChange->getMeanVal().asTPose();
  EXPECT_NEAR(mean.x, odometry.x, 1e-9);
  EXPECT_NEAR(mean.y, odometry.y, 1e-9);
  EXPECT_NEAR(mean.phi, odometry.phi, 1e-9);
  // MRPT adds the deviations up where ours adds the variances: never less than ours.
  const auto g = toMrpt(options).gaussianModel;
  const double std = g.minStdPHI + g.a3 * odometry.norm() + g.a4 * odometry.phi;
  EXPECT_NEAR(action.poseChange->getCovariance()(2, 2), std * std, 1e-9);
}

}  // namespace
}  // namespace hybrid_slam
