/// @file RawlogPlayer.h
/// @brief Replays a rawlog instead of sensors, in real time or at a given rate.
#pragma once

#include <string>
#include <vector>

#include "live/CycleSource.h"

namespace hybrid_slam::live {

/// A rawlog as a source of cycles.
class RawlogPlayer : public CycleSource {
 public:
  /// @param cycleRate   cycles per second of log time; 0: one cycle per scan
  /// @param replayRate  cycles/s delivered; 0: real time
  /// @param stop        ends the first pass over the log
  /// @throws InputError if the log is missing or has no scan; std::runtime_error if stopped
  RawlogPlayer(
      const std::string& file, double cycleRate, double replayRate,
      const StopCheck& stop = [] { return false; });

  /// Returns the defects of the log, one per line.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Plays the log to its end. Converts the odometry of action-observation pairs to CObservationOdometry,
  /// unless the log has such readings.
  /// @throws std::runtime_error at its end if the log is truncated or damaged, or has been written to or
  /// replaced since
  ///         it was opened
  void run(const CycleSink& sink, const StopCheck& stop) override;

 private:
  std::string file_, state_;  ///< files::stateOf, before the first pass
  std::string defect_;        ///< how the log is truncated; empty if complete
  std::vector<std::string> warnings_;
  double cycleRate_, replayRate_;
  bool hasOdometryReadings_ = false;  ///< the actions are not used
};

}  // namespace hybrid_slam::live
