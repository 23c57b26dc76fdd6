/// @file Lms100.h
/// @brief SICK's LMS-1xx laser scanners on Ethernet as an MRPT sensor.
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/system/COutputLogger.h>

#include <chrono>
#include <string>

#include "live/ColaTelegram.h"
#include "live/TcpSocket.h"
#include "sensors/SensorOptions.h"

namespace hybrid_slam::sensors {

/// The keys of the sensor's INI section.
struct Lms100Options : SensorOptions {
  Lms100Options() { sensorLabel = "LASER", processRate = 100; }
  std::string address = "192.168.0.1";
  int port = 2111;
  double maxRange = 20;                 // m
  double x = 0, y = 0, z = 0;           // m
  double yaw = 0, pitch = 0, roll = 0;  // deg
  bool isRightToLeft = true;
  void describe(OptionTable& table) override;
};

/// Returns a scan as MRPT has it, which is symmetric about the x axis: the direction of the middle beam goes
/// into the sensor pose. Not stamped.
mrpt::obs::CObservation2DRangeScan::Ptr observationOf(const live::cola::Scan& scan,
                                                      const Lms100Options& options);

/// `driver = Lms100`: logs in, asks for distances of 16 bits, starts the laser, and lets the device send each
/// scan. It changes neither the rate nor the resolution of the scans. Each scan becomes a
/// CObservation2DRangeScan, timestamped on arrival; damaged ones are skipped and reported. Any other fault
/// throws; the caller recreates the sensor.
///
/// In place of MRPT's CLMS100Eth, which reads past its buffer, takes 15 s to start and asks for single scans.
class Lms100 : public mrpt::hwdrivers::CGenericSensor, public mrpt::system::COutputLogger {
  DEFINE_GENERIC_SENSOR(Lms100)
 public:
  Lms100() : COutputLogger("Lms100") {}

  /// Connects and logs in. @throws std::runtime_error if the device does not answer, or refuses
  void initialize() override;
  /// Takes the received scans; until the laser is ready, asks for its state.
  /// @throws std::runtime_error if the connection is lost
  void doProcess() override;

 protected:
  /// @throws InputError for an unknown key or a wrong value
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config,
                                 const std::string& section) override;

 private:
  using Clock = std::chrono::steady_clock;

  std::string ask(const std::string& telegram, const std::string& answer);
  bool isReady();

  Lms100Options options_;
  live::TcpSocket socket_;
  live::cola::Decoder decoder_;
  bool isSending_ = false;
  Clock::time_point lastAsked_{};  ///< for the state
  size_t damaged_ = 0;
};

}  // namespace hybrid_slam::sensors
