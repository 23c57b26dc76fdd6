/// @file ReadingAssembler.h
/// @brief Pairs scans with odometry, object by object, from a rawlog or a robot.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "base/LaserScan.h"
#include "readings/ScanGrouper.h"

namespace hybrid_slam::readings {

/// What the lasers see at one time, and how the robot moved since the reading before by its odometry.
struct Reading {
  /// One of each laser at most, the latest last. Those before it were taken where the robot was then: their
  /// sensor pose is moved by the odometry since.
  Scans scans;
  double timestamp = 0;        ///< s, of the latest scan; that of the reading before where it has none
  mrpt::math::TPose2D motion;  ///< m, rad
};

/// Takes the objects of action-observation pairs, or observations, where odometry and scans interleave: there
/// the odometry at a scan's own time is interpolated between the readings around it; where timestamps step
/// back or the readings are too far apart, the reading before it in the order given holds, and the first one
/// for the scans before it. Scans without beams or with a sensor pose that is not finite are left out; beams
/// that are NaN, infinite, not positive, or at or beyond the scan's maximum range are marked invalid.
/// ScanGrouper says which scans are used and which of them make one reading.
///
/// The same objects in the same order give bit-identical readings, from a file or a robot: the replay of a
/// recording equals the live run.
class ReadingAssembler {
 public:
  /// @param lasers               labels of the lasers to use; none: all
  /// @param hasOdometryReadings  whether odometry comes as observations: scans then wait for it
  /// @param maxOdometryGap       s; odometry is interpolated between readings no farther apart
  ReadingAssembler(const std::vector<std::string>& lasers, bool hasOdometryReadings, double maxOdometryGap);

  void take(const mrpt::serialization::CSerializable::Ptr& object);
  /// Whether a scan is used, and why not.
  ScanGrouper::Use useOf(const mrpt::obs::CObservation2DRangeScan& scan) const {
    return grouper_.useOf(scan);
  }
  /// No more objects come: the scans that still wait for odometry keep the last there was.
  void finish();
  /// The next complete reading; nothing until more objects come.
  std::optional<Reading> next();

 private:
  void takeScan(const mrpt::obs::CObservation2DRangeScan::Ptr& scan);
  void takeOdometry(const mrpt::obs::CObservationOdometry& odometry);
  void finishWaiting(const mrpt::math::TPose2D& odometry);
  struct Waiting {
    mrpt::obs::CObservation2DRangeScan::Ptr scan;
    size_t reading;  ///< number of the reading it belongs to
    bool endsReading;
  };
  void complete(const Waiting& scan, const mrpt::math::TPose2D& odometry);
  void endReading();

  ScanGrouper grouper_;
  bool hasOdometryReadings_;
  double maxOdometryGap_;
  std::deque<Reading> ready_;
  std::deque<Waiting> waiting_;  ///< for the odometry reading after them
  size_t current_ = 0;           ///< number of the reading that `collected_` belongs to
  std::vector<std::pair<mrpt::obs::CObservation2DRangeScan::Ptr, mrpt::math::TPose2D>>
      collected_;  ///< with odometry
  std::optional<mrpt::math::TPose2D> lastOdometry_;
  double lastOdometryTime_ = 0;
  mrpt::math::TPose2D travelled_;      ///< odometry pose, observation-only or summed actions
  mrpt::math::TPose2D atLastReading_;  ///< odometry pose of the reading before
  bool first_ = true;
  double lastTimestamp_ = 0;
};

/// Calls visit(mrpt::obs::CObservation::Ptr) for every observation in a rawlog object.
template <class Visit>
void forEachObservation(const mrpt::serialization::CSerializable::Ptr& object, const Visit& visit) {
  if (const auto single = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object)) visit(single);
  if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
    for (const auto& observation : *frame) visit(observation);
}

/// The increment (m, rad) of an action; empty for other objects or empty actions.
std::optional<mrpt::math::TPose2D> incrementOf(const mrpt::serialization::CSerializable::Ptr& object);

bool isFinite(const mrpt::math::TPose2D& pose);
/// Whether a scan has beams and a finite sensor pose.
bool hasBeams(const mrpt::obs::CObservation2DRangeScan& scan);

/// m between two readings; farther apart are two logs in one file, or odometry that was set back.
constexpr double kMaxStep = 100;

}  // namespace hybrid_slam::readings
