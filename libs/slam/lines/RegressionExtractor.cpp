/// @file RegressionExtractor.cpp
/// @brief Line regression: a line is fitted to each window of neighbouring points, and windows that agree
/// within their covariances are merged. K. O. Arras and R. Siegwart, "Feature extraction and scene
/// interpretation for map-based navigation and map building", Proc. SPIE 3210, 1997.
#include <algorithm>
#include <cmath>

#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr size_t kWindow = 7;       // points, as Nguyen et al. 2007
constexpr double kMostChi2 = 9.21;  // 99 % of the squared Mahalanobis distances of two parameters
constexpr double kNoise = 0.4;      // sigma of the points, of the largest RMS distance of a line's points

/// Least-squares line of consecutive points.
struct Regression {
  double n = 0;
  TPoint2D centre;
  double theta = 0;   ///< rad, of the normal
  double spread = 0;  ///< m^2: sum of the squared distances from the centre along the line
};

/// Sums over consecutive points, which give their least-squares line without another pass.
class Sums {
 public:
  explicit Sums(const TPoint2D& origin) : origin_(origin) {}
  void add(PointRange points) {
    for (const TPoint2D& point : points) {
      const double x = point.x - origin_.x, y = point.y - origin_.y;
      n_ += 1, x_ += x, y_ += y, xx_ += x * x, xy_ += x * y, yy_ += y * y;
    }
  }
  Regression line() const {
    const double xx = xx_ - x_ * x_ / n_, xy = xy_ - x_ * y_ / n_, yy = yy_ - y_ * y_ / n_;
    return {n_,
            {origin_.x + x_ / n_, origin_.y + y_ / n_},
            0.5 * std::atan2(2 * xy, xx - yy) + M_PI / 2,
            0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy)};
  }

 private:
  TPoint2D origin_;
  double n_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
};

/// Returns whether two lines are the same, by the Mahalanobis distance of their (r, alpha) at the centre of
/// `a`, where the r and alpha of `a` are independent.
/// @param sigma  m, of a point across its line
bool agree(const Regression& a, const Regression& b, double sigma) {
  if (a.spread <= 0 || b.spread <= 0) return false;
  const double dx = a.centre.x - b.centre.x, dy = a.centre.y - b.centre.y, c = std::cos(b.theta),
               s = std::sin(b.theta);
  const double r = dx * c + dy * s, along = dy * c - dx * s, alpha = halfTurnDifference(a.theta, b.theta);
  // The alpha of `b` moves it at the centre of `a`.
  const double rr = 1 / a.n + 1 / b.n + along * along / b.spread, aa = 1 / a.spread + 1 / b.spread,
               ra = -along / b.spread;
  const double chi2 = (aa * r * r - 2 * ra * r * alpha + rr * alpha * alpha) / (rr * aa - ra * ra);
  return chi2 <= kMostChi2 * sigma * sigma;
}

Regression regressionOf(PointRange points) {
  Sums sums(points.front());
  sums.add(points);
  return sums.line();
}

/// Appends the lines of a run. A window represents the point in its middle; those at the ends of the run
/// represent half of their points. Pieces of fewer than `least` points are no lines.
void regress(PointRange run, double sigma, size_t least, std::vector<PointRange>& pieces) {
  if (run.size() < kWindow) return;
  const size_t first = pieces.size();
  const size_t windows = run.size() - kWindow + 1;
  const auto window = [&run](size_t i) { return PointRange{run.first + i, run.first + i + kWindow}; };
  for (size_t i = 0; i < windows;) {
    PointRange piece{run.first + (i == 0 ? 0 : i + kWindow / 2), window(i).last};
    Sums sums(piece.front());
    sums.add(piece);
    for (++i; i < windows && agree(regressionOf(window(i)), sums.line(), sigma); ++i) {
      sums.add({piece.last, window(i).last});
      piece.last = window(i).last;
    }
    if (i < windows) piece.last -= kWindow / 2;
    pieces.push_back(piece);
  }
  // Neighbours that a few wrong points have parted.
  size_t last = first;
  for (size_t i = first + 1; i < pieces.size(); ++i) {
    if (agree(regressionOf(pieces[i]), regressionOf(pieces[last]), sigma))
      pieces[last].last = pieces[i].last;
    else
      pieces[++last] = pieces[i];
  }
  pieces.resize(last + 1);
  const auto isShort = [least](const PointRange& piece) { return piece.size() < least; };
  pieces.erase(std::remove_if(pieces.begin() + static_cast<std::ptrdiff_t>(first), pieces.end(), isShort),
               pieces.end());
}

std::vector<LineSegment> extractByRegression(const LaserScan& scan, const LineExtractionOptions& options) {
  const SegmentedScan segmented(scan, options.segmentation);
  std::vector<PointRange> pieces;
  const auto least = static_cast<size_t>(options.segmentation.minPoints);
  for (const PointRange& run : segmented.runs()) regress(run, kNoise * options.fit.maxRms, least, pieces);
  return linesOf(pieces, scan, options);
}

}  // namespace

const LineExtractor kRegressionExtractor{
    "regression", "windows of 7 points merged while their lines agree within their covariances",
    extractByRegression};

}  // namespace hybrid_slam
