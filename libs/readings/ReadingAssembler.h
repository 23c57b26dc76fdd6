/// @file ReadingAssembler.h
/// @brief Pairs scans with odometry, object by object, from a rawlog or a robot.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/LaserScan.h"
#include "readings/FrozenLasers.h"
#include "readings/OdometryClock.h"
#include "readings/OdometryJumps.h"
#include "readings/OdometryTrack.h"
#include "readings/ScanGrouper.h"
#include "readings/SweepTimes.h"

namespace hybrid_slam::readings {

/// The scans taken at one time, and the odometry motion since the previous reading.
struct Reading {
  /// At most one scan per laser, the latest last. The sensor poses of earlier ones are corrected by the
  /// odometry motion since. Empty if all lasers repeat their last scan.
  Scans scans;
  double timestamp = 0;        ///< s, of the latest scan; without one, that of the previous reading
  mrpt::math::TPose2D motion;  ///< m, rad
  double way = 0;              ///< m, along the odometry, since the previous reading
  std::optional<std::string> repeating = {};  ///< label of a laser that repeats its last scan: not used
};

/// Where the odometry of a log is.
enum class OdometrySource {
  none,      ///< odometry is ignored: no motion
  actions,   ///< the action of each action-observation pair; observations of odometry are ignored
  readings,  ///< observations, which scans wait for; actions are ignored
};

/// Largest number of readings that are used before the first odometry reading: sensors do not start at the
/// same time, but a robot may have moved since an earlier scan.
constexpr size_t kMostEarly = 5;

/// What is known of the sensors besides their observations.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding)
struct SensorSettings {
  SweepTimes sweeps = {};                         ///< durations of the scans; default: as the log states
  std::optional<mrpt::poses::CPose3D> pose = {};  ///< of the only laser; default: as the scans state
  double minRange = 0;                            ///< m; shorter ranges are not used
  double odometryTimeOffset = 0;                  ///< s, added to the timestamps of the odometry
};

/// Takes the objects of a log in either form: action-observation pairs, or single observations in which
/// odometry and scans interleave. For single observations, the odometry at a scan's time is interpolated
/// between the odometry readings around it, after the time offset is added to their times (OdometryClock). If
/// timestamps step back or these readings are too far apart, the previous odometry reading is used. Odometry
/// readings of one sensor (by its label) are used, since each sensor has its own frame. The last five
/// readings before the first odometry reading use that one, and earlier ones are dropped. Impossible odometry
/// readings (isPossible) are skipped. A jump of the odometry (OdometryJumps) counts as no motion; the
/// odometry continues from the new value. Scans taken over 10 m apart never form one reading. Scans without
/// beams or with a sensor pose that is not finite are dropped, and those of frozen lasers (FrozenLasers).
/// Beams that are NaN, infinite, not positive, below the smallest range of the settings, or at or beyond the
/// scan's maximum range are marked invalid. ScanGrouper decides which scans are used and which of them form
/// one reading.
///
/// Where the time of a laser's sweep is known (SweepTimes), the beams are corrected for the robot's motion
/// since the scan's timestamp (DeskewedScan), by the odometry. Such a scan waits for the odometry up to its
/// last beam; if none comes in time, the last velocity holds. In action-observation pairs the velocity is
/// that up to the next pair. Scans that the odometry does not reach are not corrected.
///
/// The same objects in the same order give bit-identical readings, from a file or a robot: the replay of a
/// recording equals the live run.
class ReadingAssembler {  // NOLINT(clang-analyzer-optin.performance.Padding): there is one of it
 public:
  /// @param lasers          labels of the lasers to use; none: all
  /// @param maxOdometryGap  s; odometry is interpolated between readings no farther apart
  /// @param odometryLabel   of the sensor whose odometry readings are used; empty: that of the first one
  ReadingAssembler(const std::vector<std::string>& lasers, OdometrySource odometry, double maxOdometryGap,
                   SensorSettings settings = {}, const std::string& odometryLabel = {});

  void take(const mrpt::serialization::CSerializable::Ptr& object);
  /// Returns whether a scan is used, or the reason why not.
  ScanGrouper::Use useOf(const mrpt::obs::CObservation2DRangeScan& scan) const {
    return grouper_.useOf(scan);
  }
  size_t jumps() const { return jumps_; }  ///< of the odometry so far
  /// Readings before the first odometry that were dropped so far.
  size_t dropped() const { return dropped_; }
  /// End of input: scans that still wait for odometry take the last odometry reading. Without any, there are
  /// no readings.
  void finish();
  /// Returns the next complete reading; empty until more objects arrive.
  std::optional<Reading> next();

 private:
  void takeInOrder(const mrpt::obs::CObservation::Ptr& observation);
  /// Adds to the way, once the odometry is 5 cm farther.
  void travel();
  void takeScan(mrpt::obs::CObservation2DRangeScan::Ptr scan);
  bool hasOdometryReadings() const { return source_ == OdometrySource::readings; }
  bool hasManyBeams() const;
  bool isOfUsedSensor(const mrpt::obs::CObservationOdometry& odometry);
  void takeOdometry(const mrpt::obs::CObservationOdometry& odometry);
  /// Transforms a reading to the frame of those before the first jump.
  mrpt::math::TPose2D withoutJumps(const mrpt::obs::CObservationOdometry& odometry);
  void finishWaiting();
  struct Waiting {
    mrpt::obs::CObservation2DRangeScan::Ptr scan;
    size_t reading;  ///< number of the reading it belongs to
    bool endsReading;
    double sweep;                                      ///< s; 0: not corrected
    std::optional<mrpt::math::TPose2D> odometry = {};  ///< at the scan's time, as soon as it is known
  };
  /// Returns whether the odometry is known up to the scan's last beam, or never will be.
  bool isReady(const Waiting& scan) const;
  void completeReady();
  /// Returns whether only the first beams are older than the first odometry.
  bool isEarly(const Waiting& scan) const;
  /// Corrects the scan for the motion during its sweep, if that is known.
  mrpt::obs::CObservation2DRangeScan::Ptr corrected(const Waiting& scan) const;
  void complete(const Waiting& scan);
  void endReading();

  ScanGrouper grouper_;
  SensorSettings settings_;
  OdometryClock odometryClock_;
  struct Place {
    size_t reading;  ///< number
    bool endsReading;
  };
  std::deque<Place> places_;  ///< of the scans that the clock holds back
  OdometryTrack track_;
  double maxOdometryGap_;
  std::deque<Reading> ready_;
  std::deque<Waiting> waiting_;  ///< until odometry after them arrives
  size_t current_ = 0;           ///< number of the reading that `collected_` belongs to
  using ScanAt = std::pair<mrpt::obs::CObservation2DRangeScan::Ptr, mrpt::math::TPose2D>;  ///< with odometry
  std::vector<ScanAt> collected_;
  FrozenLasers frozenLasers_;
  std::optional<ScanAt> repeated_;                   ///< the last one of the current reading
  std::optional<mrpt::math::TPose2D> lastOdometry_;  ///< without the jumps
  std::optional<mrpt::math::TPose2D> lastReading_;   ///< as read
  std::optional<std::string> odometryLabel_;         ///< of the sensor whose odometry is used
  OdometryJumps odometryJumps_;
  size_t jumps_ = 0, dropped_ = 0;
  double lastOdometryTime_ = 0;
  mrpt::math::TPose2D travelled_;      ///< odometry pose, observation-only or summed actions
  mrpt::math::TPose2D atLastReading_;  ///< odometry pose of the previous reading
  mrpt::math::TPose2D travelledTo_;    ///< odometry pose up to which `way_` counts
  double way_ = 0;                     ///< m, since the last reading
  double lastTimestamp_ = 0;
  bool isInTrack_ = false;  ///< the odometry of this pair
  OdometrySource source_;
  bool first_ = true;  ///< reading
};

/// Calls visit(mrpt::obs::CObservation::Ptr) for every observation in a rawlog object.
template <class Visit>
void forEachObservation(const mrpt::serialization::CSerializable::Ptr& object, const Visit& visit) {
  if (const auto single = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object)) visit(single);
  if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
    for (const auto& observation : *frame) visit(observation);
}

/// Returns the increment (m, rad) of an action; empty for other objects, and actions without odometry.
std::optional<mrpt::math::TPose2D> incrementOf(const mrpt::serialization::CSerializable::Ptr& object);

/// Returns whether an object is an action that should have odometry.
bool isAction(const mrpt::serialization::CSerializable::Ptr& object);

/// Returns whether all coordinates are finite.
bool isFinite(const mrpt::math::TPose2D& pose);
/// Returns whether a beam has a valid range: finite, above 0 and below the scan's maximum.
bool isReturn(const mrpt::obs::CObservation2DRangeScan& scan, size_t beam);
/// Returns whether a scan has beams and a finite sensor pose.
bool hasBeams(const mrpt::obs::CObservation2DRangeScan& scan);

}  // namespace hybrid_slam::readings
