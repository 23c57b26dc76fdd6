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

/// What a log holds, found in one pass before the filter runs.
struct RawlogSummary {
  std::string sensorLabel;  ///< of the laser to be used
  size_t scans = 0, emptyScans = 0, unstampedScans = 0, stepsBack = 0;
  size_t firstEmpty = 0, firstUnstamped = 0, firstStepBack = 0;  ///< entry numbers
  bool hasOdometry = false;
  double duration = 0;  ///< s, from the earliest scan to the latest
  size_t entries = 0;
  std::string defect;  ///< how the log is cut off; empty if it is whole
};

/// @throws InputError if there is no laser (or none of the wanted label), no scan with beams, or no odometry
///         where the options require it
RawlogSummary summarise(const std::string& file, const InputOptions& options);

/// Reads a log of action-observation pairs, or one of observations only, where odometry and scans interleave:
/// there the odometry at a scan's own time is interpolated between the readings around it; where timestamps
/// step back or the readings are too far apart, the reading before it in the log's order holds.
/// Scans without beams are left out.
class RawlogSource {
 public:
  RawlogSource(const std::string& file, const InputOptions& options, const RawlogSummary& summary);

  std::optional<Reading> next();  ///< nothing at the end of the log
  size_t entry() const { return reader_.entry(); }

 private:
  void take(const mrpt::serialization::CSerializable::Ptr& object);
  void takeScan(const mrpt::obs::CObservation2DRangeScan::Ptr& scan);
  void takeOdometry(const mrpt::obs::CObservationOdometry& odometry);
  void finish(const mrpt::obs::CObservation2DRangeScan::Ptr& scan, const mrpt::math::TPose2D& odometry);

  RawlogReader reader_;
  InputOptions options_;
  std::string sensorLabel_;
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
