/// @file LogObjects.h
/// @brief Converts the records of a log to the objects of a rawlog.
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/serialization/CSerializable.h>

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "readings/LogParser.h"
#include "readings/Oddity.h"
#include "readings/OdometryJumps.h"
#include "readings/SweepTimes.h"

namespace hybrid_slam::readings {

/// What a log contains, for the user.
struct LogSummary {
  std::string format;         ///< for the user
  std::string unit = "line";  ///< of the log: "line", "message" or "entry"
  size_t scans = 0, odometryReadings = 0, brokenLines = 0;
  /// Lasers not used; of a bag: what was assumed; of a rawlog: observations not read.
  std::vector<std::string> notes;
  std::string defect;                          ///< of a bag or rawlog: why it is incomplete; empty if intact
  std::map<std::string, size_t> otherRecords;  ///< number of skipped records by name, of 100 names
  double earliest = 0, latest = 0;             ///< s
  double pathLength = 0;                       ///< m, along the odometry in log order, without jumps
  float longestRange = 0;                      ///< m, among the valid readings
  size_t wrongSweeps = 0;                      ///< scans that state an impossible scan time
  size_t ranges = 0, rangesBeyond = 0;         ///< readings above 0, and those at or beyond the maximum range
  Oddity impossibleOdometry;                   ///< isPossible
  Oddity odometryJumps;                        ///< OdometryJumps
  Oddity timeJumps;                            ///< rows over a day apart
  /// Says where the oddities since the last call are: line, message or entry.
  void areAt(size_t entry) {
    for (Oddity* oddity : {&impossibleOdometry, &odometryJumps, &timeJumps}) oddity->isAt(entry);
  }
};

/// Returns odometry as an observation, labelled `ODOMETRY`.
mrpt::obs::CObservationOdometry::Ptr odometryAt(mrpt::Clock::time_point time,
                                                const mrpt::math::TPose2D& pose);

/// Turns records into rawlog objects of either form, and collects the summary. Odometry is labelled
/// `ODOMETRY`, a scan by its record's label. If the scan time of a laser is known, a comment precedes its
/// first scan, and each scan where it changes (SweepTimes.h).
///
/// MRPT's scans are symmetric about the sensor's x axis; the offset of an asymmetric fan goes into the yaw of
/// the sensor pose (-0.5 deg for 180 beams from -90 to +89 deg). Observations of a rawlog are kept as they
/// are.
class LogObjects {
 public:
  static constexpr double kAnyRange = 1e4;  ///< m, for logs whose scans state their own limit

  /// @param maxRange           m; readings at or beyond this are no returns
  /// @param actionObservation  (action, sensory frame) pairs instead of one observation per record
  /// @param sweep              scan times in place of those of the records
  LogObjects(double maxRange, bool actionObservation, const SweepSetting& sweep = {})
      : maxRange_(maxRange), actionObservation_(actionObservation), sweepSetting_(sweep) {}

  void operator()(std::monostate) {}
  void operator()(const OtherRecord& record);
  void operator()(const OdometryRecord& record);
  void operator()(const LaserRecord& record);

  /// Takes odometry that is an observation already. @param record  its time is NaN if it is not known
  void odometry(const OdometryRecord& record, const mrpt::obs::CObservationOdometry::Ptr& observation);
  /// Takes a scan that is an observation already.
  /// @param time   s; NaN: not known
  /// @param sweep  s, from the first beam to the last; 0: not known
  void scan(const mrpt::obs::CObservation2DRangeScan::Ptr& scan, double time, double sweep);
  /// Adds a scan to the summary alone. @return the comment to write before it; null if there is none
  mrpt::obs::CObservation::Ptr note(const mrpt::obs::CObservation2DRangeScan& scan, double time,
                                    double sweep);
  /// Takes an object as it is.
  void keep(const mrpt::serialization::CSerializable::Ptr& object) { ready_.push_back(object); }

  /// Returns the next object of the records so far; null if there is none.
  mrpt::serialization::CSerializable::Ptr take();

  LogSummary summary;

 private:
  void writeActionUpTo(mrpt::Clock::time_point time);
  void seenAt(double time);

  std::deque<mrpt::serialization::CSerializable::Ptr> ready_;
  double maxRange_;
  bool actionObservation_;
  SweepSetting sweepSetting_;
  std::map<std::string, double> sweeps_;  ///< s, last written for each laser, of 100 labels
  std::optional<OdometryRecord> last_;
  std::optional<mrpt::math::TPose2D> lastPossible_;  ///< of the odometry
  OdometryJumps jumps_;
  std::optional<double> lastTime_;                  ///< s, of the previous record
  std::optional<mrpt::poses::CPose2D> atLastScan_;  ///< odometry
};

}  // namespace hybrid_slam::readings
