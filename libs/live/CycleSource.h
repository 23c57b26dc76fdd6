/// @file CycleSource.h
/// @brief Where the observations of one cycle after the other come from: sensors, a rawlog, a server.
#pragma once

#include <mrpt/obs/CSensoryFrame.h>

#include <functional>

namespace hybrid_slam::live {

/// Takes the observations of a cycle, in order of time.
using CycleSink = std::function<void(const mrpt::obs::CSensoryFrame::Ptr&)>;
/// Asked at least every 0.1 s; true ends the source.
using StopCheck = std::function<bool()>;

class CycleSource {
 public:
  virtual ~CycleSource() = default;
  /// Gives cycles until there are no more, or it is to stop. Faults are reported, waited for and mended.
  virtual void run(const CycleSink& sink, const StopCheck& stop) = 0;
};

}  // namespace hybrid_slam::live
