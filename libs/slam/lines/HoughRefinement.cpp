#include "slam/lines/HoughRefinement.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "slam/lines/LineSegment.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;

void HoughOptions::describe(OptionTable& table) {
  table.add("enabled", enabled, "refine fitted lines by a local Hough transform");
  table.add("rho_window", rhoWindow, 0.001, 10, "m",
            "voting space: distance on either side of the fitted line");
  table.add("rho_resolution", rhoResolution, 0.001, 1, "m",
            "cell size; points within half a cell of a line vote for it: use 2 to 4 times the range noise");
  table.addAngle("theta_window_deg", thetaWindow, 0.01, 45,
                 "voting space: angle on either side of the fitted line");
  table.addAngle("theta_resolution_deg", thetaResolution, 0.01, 10, "cell size in the angle");
}

namespace {

/// Whole cells in a window, robust to rounding: 0.15 / 0.05 is slightly below 3.
int cellsIn(double window, double resolution) {
  return static_cast<int>(std::floor(window / resolution + 1e-6));
}

}  // namespace

// Sec. III-B, step 3. `fitted` has the initial Hough parameters of eq. (6).
FittedLine refineByHough(PointRange points, const FittedLine& fitted, const HoughOptions& options) {
  const TPoint2D pivot =
      projected({0.5 * (points.front().x + points.back().x), 0.5 * (points.front().y + points.back().y)},
                fitted.rho, fitted.theta);
  const int thetaCells = cellsIn(options.thetaWindow, options.thetaResolution);
  const int rhoCells = cellsIn(options.rhoWindow, options.rhoResolution);

  const int rhoSize = 2 * rhoCells + 1;
  std::vector<int> votes(static_cast<size_t>(rhoSize));
  int* const votesAt = votes.data() + rhoCells;  // index 0: line through the pivot
  int most = 0, bestTheta = 0, bestRho = 0;
  for (int i = -thetaCells; i <= thetaCells; ++i) {
    const double theta = fitted.theta + i * options.thetaResolution;
    const double c = std::cos(theta) / options.rhoResolution, s = std::sin(theta) / options.rhoResolution;
    std::fill(votes.begin(), votes.end(), 0);
    for (const TPoint2D& p : points) {
      // Round to the nearest cell: truncation is fast, and rounds nonnegative values down.
      const double cell = (p.x - pivot.x) * c + (p.y - pivot.y) * s + rhoCells + 0.5;
      if (cell >= 0 && cell < rhoSize) ++votes[static_cast<size_t>(cell)];
    }
    for (int j = -rhoCells; j <= rhoCells; ++j) {
      const int count = votesAt[j];
      // On a tie, the cell closest to the fitted line.
      if (count > most ||
          (count == most && std::abs(i) + std::abs(j) < std::abs(bestTheta) + std::abs(bestRho))) {
        most = count;
        bestTheta = i;
        bestRho = j;
      }
    }
  }

  FittedLine line;
  line.theta = fitted.theta + bestTheta * options.thetaResolution;
  line.rho = signedDistance(pivot, -bestRho * options.rhoResolution, line.theta);
  normalise(line.rho, line.theta);

  std::vector<TPoint2D> voters;
  for (const TPoint2D& p : points)
    if (std::abs(signedDistance(p, line.rho, line.theta)) <= 0.5 * options.rhoResolution) voters.push_back(p);
  return fitOrthogonal({voters.data(), voters.data() + voters.size()}).value_or(line);
}

}  // namespace hybrid_slam
