#include "run/FilteredMotions.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/InputFile.h"
#include "run/Progress.h"
#include "slam/filter/HybridFilter.h"

namespace hybrid_slam::run {
namespace {

void addSamples(std::vector<MotionSample>& samples, const FilterStep& step) {
  const auto weight = [&step](size_t i) { return std::exp(step.poses[i].logWeight); };  // maximum 1
  double sum = 0;
  for (size_t i = 0; i < step.poses.size(); ++i) sum += weight(i);
  for (size_t i = 0; i < step.poses.size(); ++i)
    samples.push_back({step.odometry, step.motions[i], weight(i) / sum});
}

/// Rejects MRPT's auxiliary filters, which resample before moving the particles and do not weight by p(scan).
void checkFilter(const Configuration& configuration) {
  using Proposal = ParticleFilterOptions::Proposal;
  const Proposal proposal = configuration.filter.filter.proposal;
  if (proposal != Proposal::standard && proposal != Proposal::improved)
    throw InputError("filter not suited for learning", "section [particle_filter], key `proposal`",
                     "expected standard or improved");
  using Method = RunOptions::Method;
  if (configuration.run.method == Method::stock || configuration.run.method == Method::ortho)
    throw InputError("filter not suited for learning", "section [run], key `method`",
                     "expected hybrid or general");
}

}  // namespace

Expectation filteredMotions(const Configuration& configuration, const readings::RawlogSummary& log,
                            bool isQuiet, const std::string& progressNote, const std::atomic<bool>& stop) {
  checkFilter(configuration);
  const std::string& file = configuration.run.rawlog;
  readings::RawlogSource source(file, configuration.input, log);
  FilterConfiguration filter = configuration.filter;
  filter.improved.exponent = 1;  // EM is about the likelihood itself
  // With walls between hits, the likelihood varies more from run to run than from model to model.
  filter.grid = hitsAlone(filter.grid);
  const auto hybrid = std::make_unique<HybridFilter>(filter);  // large for a stack

  Expectation expectation;
  size_t scans = 0, updates = 0;
  double logLikelihoods = 0;
  Progress progress(log.scans, isQuiet);
  while (const auto reading = source.next()) {
    if (stop) throw std::runtime_error("interrupted: " + source.place());
    const size_t before = hybrid->updates();
    hybrid->process(reading->motion, reading->scans);
    progress.update(++scans, progressNote);
    const FilterStep& step = hybrid->lastStep();
    if (hybrid->updates() == before || step.motions.empty()) continue;  // the first update moves nothing
    addSamples(expectation.samples, step);
    logLikelihoods += step.logLikelihood;
    ++updates;
  }
  if (scans < log.scans)
    throw InputError("log has become shorter while it was read", source.place(),
                     "expected " + counted(log.scans, "scan(s)"));
  if (files::stateOf(file) != log.state)
    throw InputError("log has changed while it was read", file, "expected the same log in all iterations");
  expectation.logLikelihood = logLikelihoods / static_cast<double>(std::max<size_t>(updates, 1));
  return expectation;
}

}  // namespace hybrid_slam::run
