/// @file PioneerOdometry.h
/// @brief Odometry of a Pioneer robot as an MRPT sensor; it never moves the robot.
#pragma once

#include <mrpt/comms/CSerialPort.h>
#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/system/COutputLogger.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "live/SipOdometry.h"
#include "live/TcpSocket.h"
#include "sensors/SensorOptions.h"

namespace hybrid_slam::sensors {

/// The keys of the sensor's INI section.
struct PioneerOptions : SensorOptions {
  PioneerOptions() { sensorLabel = "ODOMETRY", processRate = 20; }
  std::string serialPort, host;
  int baudRate = 9600, tcpPort = 8101;
  double millimetresPerUnit = 1;
  void describe(OptionTable& table) override;
};

/// `driver = PioneerOdometry`: a Pioneer 2/3, AmigoBot or PowerBot on a serial port or TCP.
///
/// Sends SYNC0, SYNC1, SYNC2, OPEN, then PULSE every second (the robot's watchdog allows two), and CLOSE at
/// the end. Each server information packet (ten per second) becomes a CObservationOdometry, timestamped on
/// arrival. Any connection fault throws; the caller recreates the sensor.
class PioneerOdometry : public mrpt::hwdrivers::CGenericSensor, public mrpt::system::COutputLogger {
  DEFINE_GENERIC_SENSOR(PioneerOdometry)
 public:
  PioneerOdometry() : COutputLogger("PioneerOdometry") {}
  ~PioneerOdometry() override;

  /// Connects and performs the handshake. @throws std::runtime_error if the robot does not answer
  void initialize() override;
  /// Processes the received packets. @throws std::runtime_error if the connection is lost, or the robot
  /// silent for 3 s
  void doProcess() override;

 protected:
  /// @throws InputError for an unknown key or a wrong value
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config,
                                 const std::string& section) override;

 private:
  using Clock = std::chrono::steady_clock;

  void connect();
  void tellOfDamage(size_t before);
  void shakeHands();
  bool isAnswered(uint8_t step);
  void command(uint8_t number);
  std::string receive(double timeout);
  void send(const std::string& bytes);

  PioneerOptions options_;
  std::unique_ptr<mrpt::comms::CSerialPort> serial_;
  live::TcpSocket socket_;
  live::arcos::Decoder decoder_;
  std::optional<live::SipOdometry> odometry_;
  Clock::time_point lastPulse_{}, lastSip_{};
  bool isOpen_ = false;
};

}  // namespace hybrid_slam::sensors
