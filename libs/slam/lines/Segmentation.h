/// @file Segmentation.h
/// @brief Splits a scan into runs of points that may be straight (Sec. III-B, step 1).
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <vector>

#include "base/LaserScan.h"
#include "base/Options.h"

namespace hybrid_slam {

/// Section [segmentation].
struct SegmentationOptions : Options {
  double gapAbsolute = 0.1;    ///< m
  double gapRelative = 0.15;   ///< m of gap per m of range
  bool split = true;           ///< iterative end-point fit
  double splitDistance = 0.1;  ///< m
  int minPoints = 6;
  double minLength = 1.0;  ///< m

  void describe(OptionTable& table) override;
};

/// Consecutive points of a scan, in the sensor frame (m). Does not own them.
struct PointRange {
  const mrpt::math::TPoint2D* first = nullptr;
  const mrpt::math::TPoint2D* last = nullptr;  ///< one past the end

  const mrpt::math::TPoint2D* begin() const { return first; }
  const mrpt::math::TPoint2D* end() const { return last; }
  size_t size() const { return static_cast<size_t>(last - first); }
  const mrpt::math::TPoint2D& front() const { return *first; }
  const mrpt::math::TPoint2D& back() const { return *(last - 1); }
};

/// The beam end points in the sensor frame, split into runs. A run ends at an invalid beam and at a gap
/// between neighbours larger than gapAbsolute + gapRelative * (range of the nearer one). The last beam and
/// the first of a scan all round are neighbours.
class SegmentedScan {
 public:
  SegmentedScan(const LaserScan& scan, const SegmentationOptions& options);

  /// The runs of at least minPoints points, in beam order, from the first gap of a scan all round.
  std::vector<PointRange> runs() const;

 private:
  /// Turns the points so that no run contains the seam of a scan all round.
  void beginAtGap();
  std::vector<mrpt::math::TPoint2D> points_;
  std::vector<size_t> starts_;  ///< index of each run's first point
  int minPoints_;
};

/// Iterative end-point fit: a run is split at the point farthest from the chord between its ends while that
/// distance exceeds splitDistance. The corner belongs to both pieces; pieces with fewer than minPoints points
/// are dropped. The pieces are appended to `pieces` in beam order.
void splitAtCorners(PointRange run, const SegmentationOptions& options, std::vector<PointRange>& pieces);

}  // namespace hybrid_slam
