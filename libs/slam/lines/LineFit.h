/// @file LineFit.h
/// @brief Least-squares line fitting (Sec. III-B, step 2): eq. (2)-(6), and orthogonal least squares.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "base/Options.h"
#include "slam/lines/Segmentation.h"

namespace hybrid_slam {

/// Section [line_fit].
struct LineFitOptions : Options {
  enum class Method {
    orthogonal,  ///< total least squares; error: root mean square distance from the line
    paper        ///< eq. (2)-(4); error: eq. (5)
  };
  Method method = Method::orthogonal;
  double maxRms = 0.03;   ///< m
  double maxError = 0.1;  ///< m^2

  void describe(OptionTable& table) override;
};

/// x cos(theta) + y sin(theta) = rho, rho >= 0, in the frame of the points.
struct FittedLine {
  double rho = 0;    ///< m
  double theta = 0;  ///< rad, in (-pi, pi]
};

/// Tests whether a point is within `near` (m) of a line.
class IsNear {
 public:
  IsNear(const FittedLine& line, double near)
      : c_(std::cos(line.theta)), s_(std::sin(line.theta)), rho_(line.rho), near_(near) {}
  bool operator()(const mrpt::math::TPoint2D& p) const {
    return std::abs(p.x * c_ + p.y * s_ - rho_) <= near_;
  }

 private:
  double c_, s_, rho_, near_;
};

/// Orthogonal least squares. Empty for fewer than two distinct points.
std::optional<FittedLine> fitOrthogonal(PointRange points);
/// The same with a weight for each point, 0 or more.
std::optional<FittedLine> fitOrthogonal(PointRange points, const std::vector<double>& weights);
/// Root mean square orthogonal distance of the points from the line, m.
double rmsDistance(PointRange points, const FittedLine& line);

/// a x + b y + c = 0.
struct LineCoefficients {
  double a = 0, b = 0, c = 0;
};
/// Eq. (2)-(4). All three are 0 (no line) if the points lie on a line through the origin.
LineCoefficients fitCoefficients(PointRange points);
/// Eq. (5): sum of the squared residuals along y, m^2; infinite if b = 0.
double verticalError(PointRange points, const LineCoefficients& line);
/// Eq. (6) with the signs of the Hesse normal form (doc/paper-notes.md); empty if a = b = 0.
std::optional<FittedLine> toHesse(const LineCoefficients& line);

/// The fit by the chosen method; empty if there is none or its error exceeds the method's limit.
std::optional<FittedLine> fitLine(PointRange points, const LineFitOptions& options);

}  // namespace hybrid_slam
