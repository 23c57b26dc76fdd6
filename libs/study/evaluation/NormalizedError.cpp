#include "study/evaluation/NormalizedError.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include "base/Errors.h"
#include "base/PoseRotation.h"
#include "files/NumberTable.h"
#include "study/evaluation/Association.h"
#include "study/evaluation/ErrorStatistics.h"

namespace hybrid_slam::evaluation {

using mrpt::math::TPose2D;

namespace {

constexpr double kChiSquare95 = 7.815;         // three degrees of freedom
constexpr double kChiSquare95OfAxis = 3.841;   // one
constexpr double kLargestCovariance = 1e14;    // m^2: of coordinates up to 1e7 m, as files::checkPose
constexpr double kLargestSquaredError = 1e30;  // the sum of all must be a number

/// Collects the squared errors of the pairs.
class SquaredErrors {
 public:
  /// @param where  of the covariance, for errors
  void add(const TPose2D& estimate, const TPose2D& truth, const Eigen::Matrix3d& covariance,
           const std::string& where) {
    const Eigen::Vector3d error(estimate.x - truth.x, estimate.y - truth.y,
                                mrpt::math::wrapToPi(estimate.phi - truth.phi));
    const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
    if (factor.info() != Eigen::Success)
      throw InputError("covariance without inverse", where, "expected a positive definite matrix");
    const double squared = error.dot(factor.solve(error));
    if (!(squared < kLargestSquaredError))
      throw InputError("covariance too small", where, "expected an error below 1e15 standard deviations");
    all_.push_back(squared);
    for (int axis = 0; axis < 3; ++axis)
      insideAxes_[axis] += mrpt::square(error[axis]) < kChiSquare95OfAxis * covariance(axis, axis) ? 1 : 0;
  }

  NormalizedErrors result() const {
    const auto count = static_cast<double>(all_.size());
    NormalizedErrors result{all_.size(), 0, errorStatistics(all_).median, 0, insideAxes_ / count};
    for (const double squared : all_) {
      result.mean += squared;
      result.inside95 += squared < kChiSquare95 ? 1 : 0;
    }
    result.mean /= count;
    result.inside95 /= count;
    return result;
  }

 private:
  std::vector<double> all_;
  Eigen::Vector3d insideAxes_ = Eigen::Vector3d::Zero();
};

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
  const std::vector<PosePair> pairs = associate(estimate, reference, tolerance);
  const PosePair& first = pairs.front();
  SquaredErrors errors;
  for (const PosePair& pair : pairs)
    errors.add(pair.estimate - first.estimate, pair.reference - first.reference,
               rotated(covariances[pair.estimateRow], -first.estimate.phi),
               "row " + std::to_string(pair.estimateRow + 1));
  return errors.result();
}

NormalizedErrors normalizedErrors(const std::vector<PlacedRelation>& relations,
                                  const std::vector<Eigen::Matrix3d>& covariances) {
  SquaredErrors errors;
  for (size_t i = 0; i < relations.size(); ++i) {
    const auto& [motion, first, second] = relations[i];
    errors.add(second.pose - first.pose, motion, covariances[i], "used relation " + std::to_string(i + 1));
  }
  return errors.result();
}

}  // namespace hybrid_slam::evaluation
