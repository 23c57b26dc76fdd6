/// @file SensorThread.h
/// @brief Runs one sensor driver, MRPT's or ours, and restarts it after faults.
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

/// Queue of observations from the sensor threads to the grouping thread.
class ObservationInbox {
 public:
  void put(const std::vector<mrpt::obs::CObservation::Ptr>& observations);
  /// Waits at most `timeout` s. @return the received observations, in order of arrival
  std::deque<mrpt::obs::CObservation::Ptr> take(double timeout);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<mrpt::obs::CObservation::Ptr> waiting_;
};

/// Runs the mrpt::hwdrivers::CGenericSensor of an INI section as rawlog-grabber does: driver, process_rate
/// and the driver's own keys. A driver that throws or falls silent is recreated, after pauses of 0.2 s
/// growing to 10 s; its odometry continues from the last pose.
///
/// Two keys correct a driver's observations: `time_offset` (s) is added to their timestamps, and
/// `right_to_left` (true or false) sets the order of a laser's beams seen from above.
class SensorThread {
 public:
  /// @param timeout  s without an observation until the driver is recreated
  /// @throws InputError for an unknown driver, or if the driver rejects the section's settings
  SensorThread(const mrpt::config::CConfigFileMemory& config, const std::string& section, double timeout,
               std::shared_ptr<ObservationInbox> inbox, std::shared_ptr<live::EventLog> log);
  void start();
  /// Waits at most 3 s for the driver; a driver that does not return is abandoned.
  ~SensorThread();
  SensorThread(const SensorThread&) = delete;
  SensorThread& operator=(const SensorThread&) = delete;

  /// Number of abandoned drivers. If there are any, static objects must not be destroyed: exit with
  /// std::_Exit.
  static size_t leftBehind();

 private:
  struct Work;
  std::shared_ptr<Work> work_;  ///< shared with the thread, which may outlive this object
  std::thread thread_;
};

}  // namespace hybrid_slam::sensors
