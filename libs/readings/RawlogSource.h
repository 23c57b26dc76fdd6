/// @file RawlogSource.h
/// @brief Reads scans with odometry from a rawlog of either format, a text log, or a bag.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "base/Options.h"
#include "readings/LaserPose.h"
#include "readings/LogReader.h"
#include "readings/Oddity.h"
#include "readings/ReadingAssembler.h"

namespace hybrid_slam::readings {

struct BagPlan;

/// Section [input].
struct InputOptions : Options {
  std::string sensorLabel;         ///< list of labels, see labelsOf; of a bag: topics
  std::string laserPose = "auto";  ///< of the only laser, see laserPoseIn; auto: as the log states
  double minRange = 0;             ///< m, of all lasers
  std::string odometryTopic;       ///< of a bag
  bool requireOdometry = true;
  bool headingOdometry = false;
  bool replaceStuckOdometry = true;
  double maxOdometryGap = 1;
  double odometryTimeOffset = 0;   ///< s
  std::optional<double> scanTime;  ///< s, of all lasers; empty: what the log states
  std::optional<double> scanRate;  ///< Hz, of all lasers, instead of scanTime
  SweepSetting sweep() const { return {scanTime, scanRate}; }
  void describe(OptionTable& table) override;
  /// @throws InputError if both scanTime and scanRate are set, or laserPose is not a pose
  void check() const;
};

/// Returns what the options say of the sensors. Without odometry, which the correction of beams needs, sweeps
/// have no times.
SensorSettings sensorSettings(const InputOptions& options, bool hasOdometry);

/// Returns which odometry of a log is used, by whether it has observations of it.
OdometrySource odometrySource(const InputOptions& options, bool hasReadings);

/// Summary of a log, from one pass before the filter runs.
struct RawlogSummary {
  std::vector<std::string> lasers;   ///< labels of those used, in alphabetical order
  std::vector<std::string> ignored;  ///< one line for each other laser: label and reason
  std::string odometryLabel;         ///< of the sensor whose odometry readings are used
  size_t scans = 0;  ///< readings, without `early`: scans that several lasers take at one time count as one
  Oddity early;      ///< readings that ReadingAssembler drops before the first odometry
  Oddity empty, misplaced, tilted, unstamped, repeatedStamps, stepsBack;  ///< scans
  Oddity timeJumps;                                                       ///< over a day after the one before
  Oddity wrongOdometry;                                                   ///< impossible (isPossible)
  Oddity otherOdometry;                                                   ///< of another sensor, not used
  Oddity noOdometry;                                                      ///< actions
  Oddity wrongSweeps;                                                     ///< impossible scan times
  Oddity jumps;                                                           ///< of the odometry (OdometryJumps)
  Oddity brokenLines;                                     ///< of a text log; messages of a bag
  size_t beams = 0, returns = 0;                          ///< of the scans used; returns are of valid range
  Oddity passedOver;                                      ///< observations of classes that are not read
  std::string passedOverClasses;                          ///< a list
  std::map<std::string, double> sweeps;                   ///< s, last known of each laser
  std::map<std::string, mrpt::poses::CPose3D> mountings;  ///< of each laser used: pose on the robot at first
  std::set<std::string> spinning;                         ///< lasers that see all around, in an unknown time
  bool isDeskewed = false;  ///< beams are corrected by these where the robot moves
  bool hasActions = false, hasOdometryReadings = false;
  bool hasMotion = false;              ///< the odometry's position changes
  bool hasTurns = false;               ///< its heading changes
  double duration = 0;                 ///< s, of the scans; Duration
  size_t entries = 0;                  ///< lines of a text log, messages of a bag
  std::string unit;                    ///< of `entries` and `Oddity::first`: "entry", "line" or "message"
  std::shared_ptr<const BagPlan> bag;  ///< topics used of a bag; null for other logs
  std::string defect;                  ///< how the log is truncated; empty if complete
  std::string state;                   ///< files::stateOf, before it was read
  /// Number of scans and odometry readings that are skipped: impossible, or early (kMostEarly).
  size_t skippedReadings() const {
    return early.count + empty.count + misplaced.count + tilted.count + wrongOdometry.count + jumps.count;
  }
  /// Makes it the summary for options of the odometry that were set after the log was read: whether it is
  /// used, and its time offset.
  void adapt(const std::string& file, const InputOptions& options);
  /// Says where the defect is.
  std::string defectPlace(const std::string& file) const {
    return unit + " " + std::to_string(entries + 1) + " of " + file;
  }
};

/// Reads the whole log.
/// @throws InputError if there is no laser, a named one is missing, no scan has beams, or no laser is mounted
///         horizontally
/// @throws std::runtime_error if `isStopped`, which is called at each entry, returns true
RawlogSummary summarise(
    const std::string& file, const InputOptions& options,
    const std::function<bool()>& isStopped = [] { return false; });

/// The readings of a log, from ReadingAssembler.
class RawlogSource {
 public:
  RawlogSource(const std::string& file, const InputOptions& options, const RawlogSummary& summary);

  /// Returns the next reading; empty at the end of the log.
  std::optional<Reading> next();
  size_t entry() const { return reader_.entry(); }
  /// Readings dropped before the first odometry; final once `next` has returned a reading.
  size_t dropped() const { return assembler_.dropped(); }
  /// Names the last object read: `entry 12 of FILE`.
  std::string place() const;

 private:
  ReadingAssembler assembler_;
  std::string file_;
  LogReader reader_;
  bool isAtEnd_ = false;
};

}  // namespace hybrid_slam::readings
