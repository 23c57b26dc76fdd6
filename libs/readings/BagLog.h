/// @file BagLog.h
/// @brief Reads a ROS recording as the objects of a rawlog, one at a time.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <variant>

#include "bags/Bag.h"
#include "readings/BagPlan.h"
#include "readings/TextLog.h"

namespace hybrid_slam::readings {

/// Reads a bag as a stream. A scan is labelled by its topic and has the time of its header, or the recording
/// time if that is zero. Messages are recorded with a delay that differs between topics, so objects are
/// sorted by time within one second. Where the clock of a topic is set back by more, recorded order is kept.
class BagLog {
 public:
  /// Uses `maxRange`, `sweep`, `actionObservation`, `laserX` (for a laser of unknown pose) and `strict` of
  /// the options.
  /// @throws InputError if the file cannot be read
  BagLog(const std::string& file, BagPlan plan, const LogConversionOptions& options, BrokenLineReport report);

  /// Returns the next object; null at the end, or where the file is cut or damaged (see `defect`).
  /// @throws InputError for a broken message if `strict`
  mrpt::serialization::CSerializable::Ptr next();

  size_t message() const { return number_; }                      ///< number of the last one read, from 1
  const std::string& defect() const { return bag_->defect(); }    ///< empty for an intact file
  const LogSummary& summary() const { return objects_.summary; }  ///< of what has been read
  const BagPlan& plan() const { return plan_; }

 private:
  using Record = std::variant<OdometryRecord, LaserRecord>;

  void read(const bags::StoredMessage& message);
  void hold(const bags::ScanMessage& scan, double recorded, const BagPlan::Laser& laser);
  void hold(const bags::OdometryMessage& odometry, double recorded);
  void hold(const std::vector<bags::TransformMessage>& transforms, double recorded);
  void hold(double time, double recorded, Record record, size_t beams);
  /// Passes on the objects that no later message can precede.
  void release(bool isAtEnd);

  std::string file_;
  std::unique_ptr<bags::Bag> bag_;
  BagPlan plan_;
  LogConversionOptions options_;
  BrokenLineReport report_;
  LogObjects objects_;
  /// Sorted by time, then order of recording; but the first odometry of a time is before the scans, which
  /// it belongs to. Stamps of whole seconds have several.
  std::map<std::tuple<double, bool, size_t>, Record> held_;
  std::map<size_t, double> latest_;  ///< s, of the latest object of each topic
  size_t topic_ = 0;                 ///< of the message that is being read
  double odometryTime_ = -1;         ///< s, of the latest odometry
  size_t heldBeams_ = 0, number_ = 0;
};

}  // namespace hybrid_slam::readings
