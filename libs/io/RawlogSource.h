/// @file RawlogSource.h
/// @brief Scans with their odometry from a rawlog of either form.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <deque>
#include <optional>
#include <string>

#include "base/Options.h"
#include "io/RawlogReader.h"

namespace hybrid_slam {

/// Section [input].
struct InputOptions : Options {
  std::string sensorLabel;
  bool requireOdometry = true;
  double maxOdometryGap = 1;
  void describe(OptionTable& table) override;
};

/// One scan, and how the robot moved since the scan before by its odometry (m, rad).
struct Reading {
  mrpt::obs::CObservation2DRangeScan::Ptr scan;
  double timestamp = 0;  ///< s; that of the scan before where the scan has none
  mrpt::math::TPose2D motion;
};

/// How often something odd is in a log, and the entry (from 1) where it is first.
struct Oddity {
  size_t count = 0, first = 0;
};

/// What a log holds, found in one pass before the filter runs.
struct RawlogSummary {
  std::string sensorLabel;                             ///< of the laser to be used
  size_t scans = 0;                                    ///< of that laser, with beams
  Oddity empty, unstamped, repeatedStamps, stepsBack;  ///< scans of that laser
  Oddity wrongOdometry;                                ///< NaN or infinite
  bool hasActions = false, hasOdometryReadings = false;
  double duration = 0;  ///< s, from the earliest scan to the latest
  size_t entries = 0;
  std::string defect;  ///< how the log is cut off; empty if it is whole
};

/// @throws InputError if there is no laser (or none of the wanted label), no scan with beams, or no odometry
///         where the options require it
RawlogSummary summarise(const std::string& file, const InputOptions& options);

/// Reads a log of action-observation pairs, or one of observations only, where odometry and scans interleave:
/// there the odometry at a scan's own time is interpolated between the readings around it; where timestamps
/// step back or the readings are too far apart, the reading before it in the log's order holds, and the first
/// one for the scans before it. Scans without beams and whatever is placed at no number are left out; beams
/// that are NaN, infinite, not positive, or at or beyond the scan's maximum range are marked invalid.
class RawlogSource {
 public:
  RawlogSource(const std::string& file, const InputOptions& options, const RawlogSummary& summary);

  /// Nothing at the end of the log.
  /// @throws InputError where the odometry jumps by more than 100 m between two scans
  std::optional<Reading> next();
  size_t entry() const { return reader_.entry(); }

 private:
  void take(const mrpt::serialization::CSerializable::Ptr& object);
  void takeScan(const mrpt::obs::CObservation2DRangeScan::Ptr& scan);
  void takeOdometry(const mrpt::obs::CObservationOdometry& odometry);
  void finishWaiting(const mrpt::math::TPose2D& odometry);
  void finish(const mrpt::obs::CObservation2DRangeScan::Ptr& scan, const mrpt::math::TPose2D& odometry);

  std::string file_;
  RawlogReader reader_;
  double maxOdometryGap_;
  std::string sensorLabel_;
  bool hasOdometryReadings_;
  std::deque<Reading> ready_;
  std::deque<mrpt::obs::CObservation2DRangeScan::Ptr> waiting_;  ///< for the odometry reading after them
  std::optional<mrpt::math::TPose2D> lastOdometry_;
  double lastOdometryTime_ = 0;
  mrpt::math::TPose2D travelled_;   ///< odometry pose, observation-only or summed actions
  mrpt::math::TPose2D atLastScan_;  ///< odometry pose of the scan before
  bool first_ = true;
  double lastTimestamp_ = 0;
};

}  // namespace hybrid_slam
