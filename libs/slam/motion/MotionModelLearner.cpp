#include "slam/motion/MotionModelLearner.h"

#include <array>

#include "base/Errors.h"

namespace hybrid_slam {

namespace {

constexpr std::array<MotionTerm MotionModelOptions::*, 3> kTerms{
    &MotionModelOptions::distance, &MotionModelOptions::drift, &MotionModelOptions::turn};

}  // namespace

LearntMotionModel learnMotionModel(const MotionModelOptions& prior, const EStep& eStep, int maxIterations,
                                   const std::string& where,
                                   const std::function<void(const EmIteration&)>& report) {
  constexpr double kLeastGain = 1e-4;
  EmIteration present{0, prior, 0};
  for (const auto term : kTerms) (present.model.*term).meanStd = 0;
  Expectation expectation = eStep(present.model);
  present.logLikelihood = expectation.logLikelihood;
  LearntMotionModel learnt;
  learnt.determined = determine(expectation.samples);
  if (learnt.determined.nothing()) {
    std::string lacks;
    for (const Undetermined& lack : learnt.determined.lacks)
      lacks += (lacks.empty() ? "" : "; ") + lack.keys + ": " + lack.why;
    throw InputError("log too short or too uniform to learn from", where, lacks);
  }
  learnt.best = present;
  report(present);
  int withoutGain = 0;
  while (!learnt.isConverged && present.number < maxIterations) {
    present.model = fitMotionModel(expectation.samples, present.model, learnt.determined);
    ++present.number;
    expectation = eStep(present.model);
    present.logLikelihood = expectation.logLikelihood;
    report(present);
    const double gain = present.logLikelihood - learnt.best.logLikelihood;
    withoutGain = gain < kLeastGain ? withoutGain + 1 : 0;
    learnt.isConverged = withoutGain == 2;
    if (gain > 0) learnt.best = present;
  }
  // Means that were not learnt are as uncertain as before.
  if (learnt.best.number == 0 || !learnt.determined.meanD || !learnt.determined.meanT)
    for (const auto term : kTerms) (learnt.best.model.*term).meanStd = (prior.*term).meanStd;
  return learnt;
}

}  // namespace hybrid_slam
