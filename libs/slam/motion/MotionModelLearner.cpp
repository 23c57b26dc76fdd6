#include "slam/motion/MotionModelLearner.h"

#include "base/Errors.h"

namespace hybrid_slam {

LearntMotionModel learnMotionModel(MotionModelOptions prior, const EStep& eStep, int maxIterations,
                                   const std::string& where,
                                   const std::function<void(const EmIteration&)>& report) {
  constexpr double kLeastGain = 1e-4;
  for (MotionTerm* term : {&prior.distance, &prior.drift, &prior.turn}) term->meanStd = 0;
  Expectation expectation = eStep(prior);
  LearntMotionModel learnt;
  learnt.determined = determine(expectation.samples);
  if (learnt.determined.nothing()) {
    std::string lacks;
    for (const Undetermined& lack : learnt.determined.lacks)
      lacks += (lacks.empty() ? "" : "; ") + lack.keys + ": " + lack.why;
    throw InputError("log too short or too uniform to learn from", where, lacks);
  }
  learnt.best = {0, prior, expectation.logLikelihood};
  report(learnt.best);
  EmIteration present = learnt.best;
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
  return learnt;
}

}  // namespace hybrid_slam
