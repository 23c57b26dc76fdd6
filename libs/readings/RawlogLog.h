/// @file RawlogLog.h
/// @brief Reads a rawlog of either form as one of the form asked for.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CSerializable.h>

#include <optional>
#include <string>

#include "files/RawlogReader.h"
#include "readings/LogObjects.h"
#include "readings/SweepTimes.h"
#include "readings/TextLog.h"

namespace hybrid_slam::readings {

/// Reads a rawlog as a stream in its order. Timestamps, scans and odometry are kept; an object that has the
/// form asked for is kept as it is, except for its scan times, `maxRange`, and odometry that is not finite.
///
/// Action-observation pairs as single observations: the sum of the increments is the odometry at the time of
/// the frame, unless the log has odometry readings, which are then used alone. Single observations as pairs:
/// as of other logs (LogObjects); observations other than scans and odometry are left out and counted.
class RawlogLog {
 public:
  /// Uses `maxRange`, `sweep` and `actionObservation` of the options.
  /// @throws InputError if the file is not a rawlog
  RawlogLog(const std::string& file, const LogConversionOptions& options);

  /// Returns the next object; null at the end, or where the file is cut or damaged (see `defect`).
  /// @throws InputError at the end of a log without scans
  mrpt::serialization::CSerializable::Ptr next();

  const std::string& defect() const { return reader_.defect(); }  ///< empty for an intact file
  const LogSummary& summary() const { return objects_.summary; }  ///< of what has been read
  /// Returns a line on the observations that could not be read so far; empty without any.
  std::vector<std::string> notes() const;

 private:
  void take(const mrpt::serialization::CSerializable::Ptr& object);
  void takeFrame(const mrpt::obs::CSensoryFrame& frame);
  /// Takes what a scan depends on: the scan times stated with it, and the maximum range.
  void prepare(const mrpt::obs::CObservation::Ptr& observation);
  /// Takes an observation. @param frame  to keep it in; null: on its own
  void take(const mrpt::obs::CObservation::Ptr& observation, mrpt::obs::CSensoryFrame* frame);

  LogObjects objects_;
  std::string file_;
  std::optional<mrpt::math::TPose2D> travelled_;  ///< sum of the actions
  SweepTimes sweeps_;                             ///< as stated
  LogConversionOptions options_;
  files::RawlogReader reader_;
  bool hasOdometryReadings_;  ///< the actions are not used
};

}  // namespace hybrid_slam::readings
