#include "slam/filter/ImprovedProposal.h"

#include <algorithm>
#include <cmath>

#include "base/PoseOffset.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

Eigen::Vector3d standardNormal(RandomStream& random) {
  const double x = random.gaussian(), y = random.gaussian();
  return {x, y, random.gaussian()};
}

/// Of weighted samples.
struct Moments {
  double logMeanWeight;
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;
};

Moments momentsOf(const std::vector<Eigen::Vector3d>& samples, std::vector<double> logWeights) {
  const double highest = *std::max_element(logWeights.begin(), logWeights.end());
  double sum = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (size_t k = 0; k < samples.size(); ++k) {
    logWeights[k] = std::exp(logWeights[k] - highest);
    sum += logWeights[k];
    mean += logWeights[k] * samples[k];
  }
  mean /= sum;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (size_t k = 0; k < samples.size(); ++k)
    covariance += logWeights[k] / sum * (samples[k] - mean) * (samples[k] - mean).transpose();
  return {highest + std::log(sum / static_cast<double>(samples.size())), mean, covariance};
}

/// Draws from N(0, covariance). The covariance of few samples may be singular; LDLT also works for
/// semi-definite matrices.
Eigen::Vector3d drawnFrom(const Eigen::Matrix3d& covariance, RandomStream& random) {
  const Eigen::LDLT<Eigen::Matrix3d> spread(covariance);
  const Eigen::Vector3d deviations = spread.vectorD().cwiseMax(0).cwiseSqrt();
  return spread.transpositionsP().transpose() *
         Eigen::Vector3d(Eigen::Matrix3d(spread.matrixL()) * deviations.cwiseProduct(standardNormal(random)));
}

}  // namespace

ImprovedProposal::ImprovedProposal(const ImprovedProposalOptions& options, const MotionModelOptions& motion,
                                   const ScanMatcherOptions& matcher, const WeightTerms& terms)
    : options_(options), motion_(motion), terms_(terms), matcher_(matcher) {}

Proposed ImprovedProposal::propose(const Particle& particle, const StepMotion& stepMotion,
                                   const PreparedScan& scan, RandomStream& random) const {
  const MotionDistribution motion = motionAfter(particle, stepMotion, motion_, options_);
  const Eigen::Matrix3d motionInformation = motion.covariance.inverse();
  const TPose2D start = particle.path.back() + stepMotion.start;
  const TPose2D predicted = stepMotion.hasSlipped ? start : motion.mean;
  const WeightTerms::Density terms(terms_, particle, scan, predicted, motion.covariance);
  const Prior prior = [&](const TPose2D& pose) {
    LogDensity density = gaussianLogDensity(pose, motion.mean, motionInformation);
    density += terms(pose);
    return density;
  };
  ScanLikelihood likelihood = matcher_.likelihood(scan.matchedBeams, particle.grid);
  const ScanMatch match = matcher_.match(likelihood, start, prior);

  Proposed proposed;
  proposed.fit = match.fit;
  proposed.isMatched = match.fit >= options_.minFit;
  if (!proposed.isMatched) {
    const TPose2D drawn = stepMotion.hasSlipped
                              ? sampleMotion(stepMotion.start, motion_, random)
                              : sampleMotion(stepMotion.odometry, particle.motion.model(motion_), random);
    proposed.pose = particle.path.back() + drawn;
    proposed.logWeight = likelihood.value(proposed.pose) + terms(proposed.pose).value;
    proposed.lineWeight = terms_.lineWeight(particle, proposed.pose, scan);
    return proposed;
  }

  // Normal approximation at the maximum and its square root for sampling: covariance = root root^T.
  const Eigen::LLT<Eigen::Matrix3d> factor(scanInformation(likelihood, match.pose) +
                                           prior(match.pose).information);
  const Eigen::Matrix3d root = factor.matrixU().solve(Eigen::Matrix3d::Identity());
  const double logVolume = root.diagonal().array().abs().log().sum();

  const auto samples = static_cast<size_t>(options_.samples);
  std::vector<Eigen::Vector3d> offsets(samples);
  std::vector<double> logRatios(samples);  // ln of p over the sampling density
  for (size_t k = 0; k < samples; ++k) {
    const Eigen::Vector3d normal = standardNormal(random);
    offsets[k] = root * normal;
    const TPose2D pose = displaced(match.pose, offsets[k]);
    logRatios[k] = likelihood.value(pose) + prior(pose).value + 0.5 * normal.squaredNorm() + logVolume;
  }
  const Moments moments = momentsOf(offsets, logRatios);
  proposed.logWeight = moments.logMeanWeight - 0.5 * std::log(motion.covariance.determinant());
  proposed.pose = displaced(match.pose, moments.mean + drawnFrom(moments.covariance, random));
  proposed.lineWeight = terms_.lineWeight(particle, proposed.pose, scan);
  return proposed;
}

}  // namespace hybrid_slam
