#include "rbpf/FilterOptions.h"

namespace hybrid_slam {

void ParticleFilterOptions::describe(OptionTable& t) {
  using mrpt::bayes::CParticleFilter;
  t.add("particles", particles, 1, 100000, "number of particles");
  t.add("proposal", proposal,
        {{Proposal::standard, "standard"},
         {Proposal::improved, "improved"},
         {Proposal::auxiliaryStandard, "auxiliary_standard"},
         {Proposal::auxiliaryOptimal, "auxiliary_optimal"}},
        "standard: the paper's, samples from the motion model; improved: samples around a scan match; "
        "the others are MRPT's auxiliary filters");
  t.add("resampling", resampling,
        {{CParticleFilter::prMultinomial, "multinomial"},
         {CParticleFilter::prResidual, "residual"},
         {CParticleFilter::prStratified, "stratified"},
         {CParticleFilter::prSystematic, "systematic"}},
        "MRPT's scheme for drawing the next generation");
  t.add("ess_threshold", essThreshold, 0, 1, "",
        "resamples when the effective sample size, as a share of the particles, is below");
  t.add("update_distance", updateDistance, 0, 100, "m", "the filter runs when the robot has moved this far");
  t.addAngle("update_angle_deg", updateAngle, 0, 360, "or has turned this far");
  t.add("seed", seed, 0, 2147483647, "same seed, same bytes, for any number of threads");
  t.add("threads", threads, 0, 1024, "threads over particles; 0: all cores");
}

void ImprovedProposalOptions::describe(OptionTable& t) {
  t.add("samples", samples, 2, 10000,
        "poses around the scan match that make out the proposal and the weight");
  t.add(
      "min_fit", minFit, 0, 1, "",
      "a match that fits the map less is not used: the motion model is sampled; a map of one scan fits 0.04");
}

}  // namespace hybrid_slam
