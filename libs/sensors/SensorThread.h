/// @file SensorThread.h
/// @brief One sensor of MRPT's, or ours, kept going.
#pragma once

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/obs/CObservation.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "live/EventLog.h"

namespace hybrid_slam::sensors {

/// Observations on their way from the sensors' threads to the one that groups them.
class ObservationInbox {
 public:
  void put(const std::vector<mrpt::obs::CObservation::Ptr>& observations);
  /// Waits at most `timeout` s. @return what has come, in its order
  std::deque<mrpt::obs::CObservation::Ptr> take(double timeout);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<mrpt::obs::CObservation::Ptr> waiting_;
};

/// Runs the mrpt::hwdrivers::CGenericSensor of an INI section as rawlog-grabber does: driver, process_rate
/// and the driver's own keys. A driver that throws, or that gives nothing for some time, is made anew, after
/// pauses of 0.5 s growing to 10 s; its odometry goes on from the last pose.
///
/// Two keys correct what a driver says of its observations: `time_offset` (s) is added to their times, and
/// `right_to_left` (true or false) is the order of a laser's beams seen from above.
class SensorThread {
 public:
  /// @param timeout  s without an observation after which the driver is made anew
  /// @throws InputError for a driver that there is not, or that does not take the section's settings
  SensorThread(const mrpt::config::CConfigFileMemory& config, const std::string& section, double timeout,
               std::shared_ptr<ObservationInbox> inbox, std::shared_ptr<live::EventLog> log);
  void start();
  /// Waits at most 3 s for the driver; one that does not come back is left behind.
  ~SensorThread();
  SensorThread(const SensorThread&) = delete;
  SensorThread& operator=(const SensorThread&) = delete;

  /// Drivers left behind so far. While there are some, static objects must not be destroyed: the program is
  /// to leave by std::_Exit.
  static size_t leftBehind();

 private:
  struct Work;
  std::shared_ptr<Work> work_;  ///< shared with the thread, which may stay when this goes
  std::thread thread_;
};

}  // namespace hybrid_slam::sensors
