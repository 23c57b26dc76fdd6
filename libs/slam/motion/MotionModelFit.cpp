#include "slam/motion/MotionModelFit.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// One of D, C, T of a sample, with its odometry.
struct Row {
  MotionStep odometry;
  double value, weight;
};

/// The rows of D, C and T.
struct Rows {
  explicit Rows(const std::vector<MotionSample>& samples) {
    for (const MotionSample& sample : samples) {
      const MotionStep odometry(sample.odometry);
      mrpt::math::TPose2D increment = sample.motion;
      // Modulo 2 pi, so that a turn by pi keeps its sign.
      increment.phi = odometry.turn + mrpt::math::wrapToPi(increment.phi - odometry.turn);
      const MotionStep motion(increment);
      distance.push_back({odometry, motion.distance, sample.weight});
      drift.push_back({odometry, motion.drift - odometry.drift, sample.weight});
      turn.push_back({odometry, motion.turn, sample.weight});
    }
  }
  std::vector<Row> distance, drift, turn;
};

/// Least variance, (1 um)^2 or (1 urad)^2: a noise-free model has no likelihood.
constexpr double kLeastVariance = 1e-12;

double varianceOf(const MotionTerm& term, const Row& row, double minStd) {
  return term.variance(row.odometry, minStd) + kLeastVariance;
}

double logLikelihood(const std::vector<Row>& rows, const MotionTerm& term, double minStd) {
  double sum = 0, weights = 0;
  for (const Row& row : rows) {
    const double v = varianceOf(term, row, minStd), r = row.value - term.mean(row.odometry);
    sum -= row.weight / 2 * (std::log(2 * M_PI * v) + r * r / v);
    weights += row.weight;
  }
  return sum / weights;
}

/// Quadratic model of the likelihood around the current parameters x:  gradient^T dx - dx^T information dx /
/// 2.
struct Quadratic {
  double value(const Vector2d& dx) const { return gradient.dot(dx) - dx.dot(information * dx) / 2; }
  /// Fixes a parameter.
  void hold(int i) {
    isHeld[i] = true;
    gradient[i] = information(i, 1 - i) = information(1 - i, i) = 0;
    information(i, i) = 1;
  }
  Vector2d top() const { return information.ldlt().solve(gradient); }
  /// The maximum subject to x + dx >= 0: the unconstrained one, or on one of the two borders.
  Vector2d topAbove(const Vector2d& x) const {
    Vector2d free = top();
    if ((x + free).minCoeff() >= 0) return free;
    Vector2d best = Vector2d::Zero();
    for (const int i : {0, 1}) {
      if (isHeld[i]) continue;
      const int j = 1 - i;
      Vector2d onBorder;
      onBorder[i] = -x[i];
      onBorder[j] = std::max(-x[j], (gradient[j] + information(j, i) * x[i]) / information(j, j));
      if (value(onBorder) > value(best)) best = onBorder;
    }
    return best;
  }
  Vector2d gradient = Vector2d::Zero();
  Matrix2d information = Matrix2d::Zero();
  bool isHeld[2] = {false, false};
};

/// Sets the means to their maximum, which is exact: the likelihood is quadratic in the means.
void fitMeans(MotionTerm& term, const std::vector<Row>& rows, double minStd,
              const Determination& determined) {
  Quadratic q;
  for (const Row& row : rows) {
    const Vector2d x(row.odometry.distance, row.odometry.turn);
    const double w = row.weight / varianceOf(term, row, minStd);
    q.gradient += w * (row.value - term.mean(row.odometry)) * x;
    q.information += w * x * x.transpose();
  }
  if (!determined.meanD) q.hold(0);
  if (!determined.meanT) q.hold(1);
  const Vector2d dx = q.top();
  term.meanD += dx[0];
  term.meanT += dx[1];
}

/// One step of Fisher scoring, halved until the likelihood does not decrease.
void improveVariances(MotionTerm& term, const std::vector<Row>& rows, double minStd,
                      const Determination& determined) {
  Quadratic q;
  for (const Row& row : rows) {
    const double d = distanceOfVariance(row.odometry);
    const Vector2d x(d * d, row.odometry.turn * row.odometry.turn);
    const double v = varianceOf(term, row, minStd), w = row.weight / (2 * v * v);
    const double r = row.value - term.mean(row.odometry);
    q.gradient += w * (r * r - v) * x;
    q.information += w * x * x.transpose();
  }
  if (!determined.varianceD) q.hold(0);
  if (!determined.varianceT) q.hold(1);
  const Vector2d present(term.varianceD, term.varianceT);
  const double before = logLikelihood(rows, term, minStd);
  Vector2d dx = q.topAbove(present);
  for (int halvings = 0; halvings < 30; ++halvings, dx /= 2) {
    MotionTerm next = term;
    next.varianceD = std::max(0.0, present[0] + dx[0]);  // max: the INI reader rejects values below 0
    next.varianceT = std::max(0.0, present[1] + dx[1]);
    if (logLikelihood(rows, next, minStd) < before) continue;
    term = next;
    return;
  }
}

MotionTerm fit(MotionTerm term, const std::vector<Row>& rows, double minStd,
               const Determination& determined) {
  constexpr int kMostSweeps = 100;
  constexpr double kLeastGain = 1e-12;  // nats per step
  double before = logLikelihood(rows, term, minStd);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    fitMeans(term, rows, minStd, determined);
    improveVariances(term, rows, minStd, determined);
    const double now = logLikelihood(rows, term, minStd);
    if (now - before < kLeastGain) break;
    before = now;
  }
  return term;
}

}  // namespace

double logLikelihood(const std::vector<MotionSample>& samples, const MotionModelOptions& model) {
  const Rows rows(samples);
  return logLikelihood(rows.distance, model.distance, model.minStdXY) +
         logLikelihood(rows.drift, model.drift, model.minStdXY) +
         logLikelihood(rows.turn, model.turn, model.minStdPhi);
}

MotionModelOptions fitMotionModel(const std::vector<MotionSample>& samples, const MotionModelOptions& present,
                                  const Determination& determined) {
  const Rows rows(samples);
  MotionModelOptions model = present;
  model.distance = fit(present.distance, rows.distance, present.minStdXY, determined);
  model.drift = fit(present.drift, rows.drift, present.minStdXY, determined);
  model.turn = fit(present.turn, rows.turn, present.minStdPhi, determined);
  return model;
}

}  // namespace hybrid_slam
