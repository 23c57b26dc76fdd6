#include "study/evaluation/NormalizedError.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include "base/Errors.h"
#include "files/NumberTable.h"
#include "study/evaluation/Association.h"
#include "study/evaluation/StampIndex.h"

namespace hybrid_slam::evaluation {

using mrpt::math::TPose2D;

namespace {

constexpr double kChiSquare95 = 7.815;         // three degrees of freedom
constexpr double kLargestCovariance = 1e14;    // m^2: of coordinates up to 1e7 m, as files::checkPose
constexpr double kLargestSquaredError = 1e30;  // the sum of all must be a number

}  // namespace

std::vector<Eigen::Matrix3d> loadCovariances(const std::string& file) {
  std::vector<Eigen::Matrix3d> all;
  for (const files::NumberRow& row : files::readNumberTable(file, "timestamp,xx,xy,yy,xphi,yphi,phiphi")) {
    for (size_t i = 1; i < row.values.size(); ++i)
      if (!(std::abs(row.values[i]) <= kLargestCovariance))
        throw InputError("broken line", "file `" + file + "`, line " + std::to_string(row.line),
                         "expected covariances in -1e14..1e14 (m, rad)");
    const double xx = row.values[1], xy = row.values[2], yy = row.values[3];
    const double xphi = row.values[4], yphi = row.values[5], phiphi = row.values[6];
    all.emplace_back() << xx, xy, xphi, xy, yy, yphi, xphi, yphi, phiphi;
  }
  return all;
}

NormalizedErrors normalizedErrors(const files::Trajectory& estimate,
                                  const std::vector<Eigen::Matrix3d>& covariances,
                                  const files::Trajectory& reference, double tolerance) {
  if (covariances.size() != estimate.size())
    throw InputError("wrong number of covariances", std::to_string(covariances.size()) + " rows",
                     "expected " + std::to_string(estimate.size()) + ", one for each pose");
  NormalizedErrors result;
  const PosePair first = associate(estimate, reference, tolerance).front();
  const StampIndex index(reference);
  for (size_t i = 0; i < estimate.size(); ++i) {
    const auto row = index.nearest(estimate[i].timestamp, tolerance);
    if (!row) continue;
    const TPose2D pose = estimate[i].pose - first.estimate, truth = reference[*row].pose - first.reference;
    const Eigen::Vector3d error(pose.x - truth.x, pose.y - truth.y,
                                mrpt::math::wrapToPi(pose.phi - truth.phi));
    const Eigen::LLT<Eigen::Matrix3d> factor(covariances[i]);
    if (factor.info() != Eigen::Success)
      throw InputError("covariance without inverse", "row " + std::to_string(i + 1),
                       "expected a positive definite matrix");
    const double squared = error.dot(factor.solve(error));
    if (!(squared < kLargestSquaredError))
      throw InputError("covariance too small", "row " + std::to_string(i + 1),
                       "expected an error below 1e15 standard deviations");
    ++result.pairs;
    result.mean += squared;
    result.inside95 += squared < kChiSquare95 ? 1 : 0;
  }
  result.mean /= static_cast<double>(result.pairs);
  result.inside95 /= static_cast<double>(result.pairs);
  return result;
}

}  // namespace hybrid_slam::evaluation
