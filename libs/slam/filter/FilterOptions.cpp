#include "slam/filter/FilterOptions.h"

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
  t.add(
      "update_distance", updateDistance, 0, 100, "m",
      "instead of [particle_filter] update_distance: a match wants scans that overlap well, and has no need "
      "to spare the particles");
  t.addAngle("update_angle_deg", updateAngle, 0, 360, "instead of that of [particle_filter]");
  t.add("samples", samples, 2, 10000,
        "poses around the scan match that make out the proposal and the weight");
  t.add("exponent", exponent, 0, 1, "",
        "tempering: a particle's weight is what the scan says of it to this power, as the beams' errors are "
        "far from independent");
  t.add(
      "min_fit", minFit, 0, 1, "",
      "a match that fits the map less is not used: the motion model is sampled; a map of one scan fits 0.04");
  t.addAngle(
      "line_sigma_deg", lineSigma, 0.05, 22.5,
      "deviation of a line's direction, instead of that of [line_weight]: a matched heading is surer than "
      "an odometry's");
  t.add("line_sigma_rho", lineSigmaRho, 0.001, 10, "m",
        "deviation of a line's distance from its wall in the database");
  t.add("slip_distance", slipDistance, 0, 5, "m",
        "where a scan fits poorly, the motion is searched so far around the odometry's; 0: never");
  t.addAngle("slip_angle_deg", slipAngle, 1, 180, "and so far in heading");
  t.add("slip_probability", slipProbability, 1e-12, 1, "",
        "of a step in which the odometry says nothing; larger believes the search sooner");
}

}  // namespace hybrid_slam
