/// @file CycleSource.h
/// @brief Source of observation cycles: sensors, a rawlog or a server.
#pragma once

#include <mrpt/obs/CSensoryFrame.h>

#include <functional>

namespace hybrid_slam::live {

/// Receives the observations of a cycle, in order of time.
using CycleSink = std::function<void(const mrpt::obs::CSensoryFrame::Ptr&)>;
/// Called at least every 0.1 s; true stops the source.
using StopCheck = std::function<bool()>;

/// Where cycles come from.
class CycleSource {
 public:
  virtual ~CycleSource() = default;
  /// Delivers cycles until the end or a stop. Reports faults and retries.
  virtual void run(const CycleSink& sink, const StopCheck& stop) = 0;
};

}  // namespace hybrid_slam::live
