/// @file ReadingAssembler.h
/// @brief Pairs scans with their odometry, object by object: of a rawlog, or as they come from a robot.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <deque>
#include <optional>
#include <string>

namespace hybrid_slam::readings {

/// One scan, and how the robot moved since the scan before by its odometry (m, rad).
struct Reading {
  mrpt::obs::CObservation2DRangeScan::Ptr scan;
  double timestamp = 0;  ///< s; that of the scan before where the scan has none
  mrpt::math::TPose2D motion;
};

/// Takes the objects of action-observation pairs, or observations, where odometry and scans interleave: there
/// the odometry at a scan's own time is interpolated between the readings around it; where timestamps step
/// back or the readings are too far apart, the reading before it in the order given holds, and the first one
/// for the scans before it. Scans without beams and whatever is placed at no number are left out; beams that
/// are NaN, infinite, not positive, or at or beyond the scan's maximum range are marked invalid.
///
/// The same objects in the same order give the same readings to the bit, whether they come from a file or
/// from a robot: this is what makes the replay of a recording the same as the live run.
class ReadingAssembler {
 public:
  /// @param sensorLabel          laser to use; empty: that of the first scan
  /// @param hasOdometryReadings  whether odometry comes as observations: scans then wait for it
  /// @param maxOdometryGap       s; odometry is interpolated between readings no farther apart
  ReadingAssembler(const std::string& sensorLabel, bool hasOdometryReadings, double maxOdometryGap);

  void take(const mrpt::serialization::CSerializable::Ptr& object);
  /// No more objects come: the scans that still wait for odometry keep the last there was.
  void finish() { finishWaiting(travelled_); }
  /// The next complete reading; nothing until more objects come.
  std::optional<Reading> next();

 private:
  void takeScan(const mrpt::obs::CObservation2DRangeScan::Ptr& scan);
  void takeOdometry(const mrpt::obs::CObservationOdometry& odometry);
  void finishWaiting(const mrpt::math::TPose2D& odometry);
  void complete(const mrpt::obs::CObservation2DRangeScan::Ptr& scan, const mrpt::math::TPose2D& odometry);

  std::optional<std::string> sensorLabel_;  ///< nothing until the first scan names it
  bool hasOdometryReadings_;
  double maxOdometryGap_;
  std::deque<Reading> ready_;
  std::deque<mrpt::obs::CObservation2DRangeScan::Ptr> waiting_;  ///< for the odometry reading after them
  std::optional<mrpt::math::TPose2D> lastOdometry_;
  double lastOdometryTime_ = 0;
  mrpt::math::TPose2D travelled_;   ///< odometry pose, observation-only or summed actions
  mrpt::math::TPose2D atLastScan_;  ///< odometry pose of the scan before
  bool first_ = true;
  double lastTimestamp_ = 0;
};

/// Calls visit(mrpt::obs::CObservation::Ptr) for every observation in an object of a rawlog.
template <class Visit>
void forEachObservation(const mrpt::serialization::CSerializable::Ptr& object, const Visit& visit) {
  if (const auto single = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object)) visit(single);
  if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
    for (const auto& observation : *frame) visit(observation);
}

/// The increment (m, rad) of an action; nothing for an object that is none, or an empty one.
std::optional<mrpt::math::TPose2D> incrementOf(const mrpt::serialization::CSerializable::Ptr& object);

bool isFinite(const mrpt::math::TPose2D& pose);
/// Whether a scan has beams, and a place for them.
bool hasBeams(const mrpt::obs::CObservation2DRangeScan& scan);

/// m between two scans; farther apart are two logs in one file, or odometry that was set back.
constexpr double kMaxStep = 100;

}  // namespace hybrid_slam::readings
