/// @file RawlogPlayer.h
/// @brief A rawlog in place of sensors, at its own pace or at a given rate.
#pragma once

#include <string>

#include "live/CycleSource.h"

namespace hybrid_slam::live {

class RawlogPlayer : public CycleSource {
 public:
  /// @param cycleRate   cycles/s of the log's time that are made of its observations; 0: each scan is one
  /// @param replayRate  cycles/s at which they are given away; 0: the log's own pace
  /// @throws InputError if the log is missing, or holds no scan
  RawlogPlayer(const std::string& file, double cycleRate, double replayRate);

  /// Ends with the log. The odometry of action-observation pairs becomes CObservationOdometry.
  void run(const CycleSink& sink, const StopCheck& stop) override;

 private:
  std::string file_;
  double cycleRate_, replayRate_;
};

}  // namespace hybrid_slam::live
