#include "slam/filter/LineLikelihood.h"

#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

LineLikelihoodOptions::LineLikelihoodOptions(const LineWeightOptions& lineWeight,
                                             const AssociationOptions& lineAssociation, int leastCount,
                                             const ImprovedProposalOptions& improved)
    : weight(lineWeight),
      sigmaRho(improved.lineSigmaRho),
      association(lineAssociation),
      minCount(leastCount) {
  weight.sigma = improved.lineSigma;
}

LineLikelihood::LineLikelihood(const std::vector<LineSegment>& seen, const TPose2D& predicted,
                               const LineDatabase& database, const LineLikelihoodOptions& options)
    : compared_(comparedLines(database, TPoint2D(predicted.x, predicted.y), options.weight)),
      weight_(options.weight),
      sigmaRho_(options.sigmaRho) {
  double total = 0;
  for (const LineSegment& line : seen) {
    total += line.length;
    const DatabaseLine* const wall = database.closestMatch(transformed(line, predicted), options.association);
    if (wall && wall->count >= options.minCount)
      walls_.push_back({middle(line), line.theta, wall->rho, wall->theta, std::cos(wall->theta),
                        std::sin(wall->theta), line.length});
    else
      newLines_.push_back(line);
  }
  for (KnownWall& wall : walls_) wall.share /= total;
}

LogDensity LineLikelihood::operator()(const TPose2D& pose) const {
  constexpr double kMostSquares = 9;  // three standard deviations: beyond, it is another wall
  LogDensity density = lineLogDensity(newLines_, pose.phi, *compared_, weight_);
  const double perAngle = 1 / (weight_.sigma * weight_.sigma), perDistance = 1 / (sigmaRho_ * sigmaRho_);
  for (const KnownWall& wall : walls_) {
    const double angle = std::remainder(wall.theta + pose.phi - wall.knownTheta, M_PI);
    const TPoint2D at = pose.composePoint(wall.middle);
    const double distance = at.x * wall.normalX + at.y * wall.normalY - wall.knownRho;
    const double squares = angle * angle * perAngle + distance * distance * perDistance;
    density.value -= 0.5 * wall.share * std::min(squares, kMostSquares);
    if (squares > kMostSquares) continue;
    const Eigen::Vector3d byAngle(0, 0, 1);
    const Eigen::Vector3d byDistance(wall.normalX, wall.normalY,
                                     (at.x - pose.x) * wall.normalY - (at.y - pose.y) * wall.normalX);
    density.gradient -= wall.share * (angle * perAngle * byAngle + distance * perDistance * byDistance);
    density.information += wall.share * (perAngle * byAngle * byAngle.transpose() +
                                         perDistance * byDistance * byDistance.transpose());
  }
  return density;
}

LogDensity lineLogDensity(const std::vector<LineSegment>& seen, double heading, const LineDatabase& database,
                          const LineWeightOptions& options) {
  LogDensity density;
  const LineWeight weight = lineWeight(seen, heading, database, options);
  density.value = std::log(weight.value);
  if (weight.slope == 0) return density;
  density.gradient.z() = weight.slope / weight.value;
  density.information(2, 2) = 1 / (options.sigma * options.sigma);
  return density;
}

}  // namespace hybrid_slam
