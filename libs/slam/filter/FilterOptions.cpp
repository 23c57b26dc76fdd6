#include "slam/filter/FilterOptions.h"

#include "base/Errors.h"
#include "base/Numbers.h"

namespace hybrid_slam {

void ParticleFilterOptions::describe(OptionTable& t) {
  using mrpt::bayes::CParticleFilter;
  t.add("particles", particles, 0, 100000, "number of particles; 0: adaptive, as many as the spread needs");
  t.add("min_particles", minParticles, 1, 100000, "minimum number of particles, if adaptive");
  t.add("max_particles", maxParticles, 1, 100000, "maximum number of particles, if adaptive");
  t.add("proposal", proposal,
        {{Proposal::standard, "standard"},
         {Proposal::improved, "improved"},
         {Proposal::auxiliaryStandard, "auxiliary_standard"},
         {Proposal::auxiliaryOptimal, "auxiliary_optimal"}},
        "improved: around a scan match; standard: the motion model, as in the paper; the others: MRPT's "
        "auxiliary filters");
  t.add("resampling", resampling,
        {{CParticleFilter::prMultinomial, "multinomial"},
         {CParticleFilter::prResidual, "residual"},
         {CParticleFilter::prStratified, "stratified"},
         {CParticleFilter::prSystematic, "systematic"}},
        "MRPT's resampling scheme");
  t.add("ess_threshold", essThreshold, 0, 1, "",
        "resample when the effective sample size, as a fraction of the particles, falls below this");
  t.add("update_distance", updateDistance, 0, 100, "m", "update the filter after this distance");
  t.addAngle("update_angle_deg", updateAngle, 0, 360,
             "update the filter after this rotation, if it comes first; above 180: never");
  t.add("seed", seed, 0, 2147483647,
        "random seed; the same seed gives identical results for any number of threads");
  t.add("threads", threads, 0, 1024, "number of threads; 0: all cores");
}

void ImprovedProposalOptions::describe(OptionTable& t) {
  t.add("update_distance", updateDistance, 0, 100, "m",
        "update the filter after this distance, instead of [particle_filter] update_distance: scan matching "
        "needs overlapping scans");
  t.addAngle("update_angle_deg", updateAngle, 0, 360,
             "update the filter after this rotation, instead of [particle_filter] update_angle_deg; above "
             "180: never");
  t.add("samples", samples, 2, 10000, "poses sampled around the scan match to compute proposal and weight");
  t.add("exponent", exponent, 0, 1, "",
        "exponent of the scan likelihood in the particle weight; small, because beam errors are not "
        "independent");
  t.add("min_fit", minFit, 0, 1, "",
        "minimum fit of a match; below it, sample from the motion model; a map of one scan fits 0.04");
  t.addAngle("line_sigma_deg", lineSigma, 0.05, 22.5,
             "standard deviation of a line's direction, instead of [line_weight] sigma_deg: a matched "
             "heading is more certain than odometry");
  t.add("line_sigma_rho", lineSigmaRho, 0.001, 10, "m",
        "standard deviation of a line's distance from its wall in the database");
  t.add("slip_distance", slipDistance, 0, 5, "m",
        "search range around the odometry for a scan that fits poorly; 0: no search");
  t.addAngle("slip_angle_deg", slipAngle, 1, 180, "search range of the heading");
  t.add("slip_probability", slipProbability, 1e-12, 1, "",
        "prior probability of a slip in a step; a larger value accepts the search result sooner");
}

// The update of a scan needs a byte for each cell in its range. MRPT's weights need nine, for each particle.
void checkMemory(const GridOptions& grid, const GridWeightOptions& gridWeight) {
  const double most = gridWeight.method == GridWeightOptions::Method::penetration ? 10000 : 2000;  // cells
  if (grid.maxRange > (most + 0.5) * grid.resolution)
    throw InputError("range too long for this cell size", "section [grid], keys `max_range`, `resolution`",
                     "expected at most " + numberText(most) + " cells");
}

}  // namespace hybrid_slam
