#include "sensors/PioneerOdometry.h"

#include <mrpt/obs/CObservationOdometry.h>

#include <stdexcept>

#include "base/Clock.h"
#include "base/Errors.h"

IMPLEMENTS_GENERIC_SENSOR(PioneerOdometry, hybrid_slam::sensors)

namespace hybrid_slam::sensors {
namespace {

constexpr double kRobotConnectTimeout = 3, kRobotAnswerTimeout = 0.5, kSilence = 3, kPulseInterval = 1;  // s
constexpr int kAttempts = 5;

}  // namespace

void PioneerOptions::describe(OptionTable& t) {
  describeCommon(t, "PioneerOdometry", "the robot sends 10 packets per second");
  t.add("serial_port", serialPort, "serial device, such as ttyUSB0; empty: TCP");
  t.add("baud_rate", baudRate, 1200, 230400, "baud rate of the serial line");
  t.add("host", host, "host of a serial-to-TCP bridge or of a simulator");
  t.add("tcp_port", tcpPort, 1, 65535, "TCP port of the host");
  t.add("mm_per_unit", millimetresPerUnit, 0.01, 100, "mm",
        "unit of the position counters: DistConvFactor of the robot's parameter file "
        "(P3-DX with ARCOS: 1; with an older controller: 0.485)");
}

PioneerOdometry::~PioneerOdometry() {
  if (!isOpen_) return;
  try {
    command(live::arcos::close);
  } catch (const std::exception&) {  // it is gone anyway
  }
}

void PioneerOdometry::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config,
                                                const std::string& section) {
  options_.loadFromConfigFile(config, section);
  if (options_.serialPort.empty() == options_.host.empty())
    throw InputError("no robot, or two robots", "section [" + section + "], keys `serial_port` and `host`",
                     "expected exactly one of the two");
  m_sensorLabel = options_.sensorLabel;
  m_process_rate = options_.processRate;
}

void PioneerOdometry::initialize() {
  m_state = ssInitializing;
  odometry_.emplace(options_.millimetresPerUnit / 1000);
  decoder_ = {};
  connect();
  shakeHands();
  command(live::arcos::open);
  isOpen_ = true;
  command(live::arcos::pulse);
  lastPulse_ = lastSip_ = Clock::now();
}

void PioneerOdometry::connect() {
  if (options_.serialPort.empty()) {
    socket_ = live::TcpSocket::connectTo(options_.host, static_cast<uint16_t>(options_.tcpPort),
                                         kRobotConnectTimeout);
    return;
  }
  serial_ = std::make_unique<mrpt::comms::CSerialPort>(options_.serialPort);
  serial_->setConfig(options_.baudRate);
  serial_->setTimeouts(1, 0, 20, 1, 20);
}

/// Connects. The robot echoes each SYNC; the last answer also holds its name, type and subtype.
void PioneerOdometry::shakeHands() {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    uint8_t step = live::arcos::sync0;
    for (; step <= live::arcos::sync2; ++step) {
      command(step);
      if (!isAnswered(step)) break;
    }
    if (step > live::arcos::sync2) return;
    command(live::arcos::close);  // it may still be open from a program that was killed
  }
  throw std::runtime_error("no answer to SYNC: no Pioneer, or wrong baud rate");
}

bool PioneerOdometry::isAnswered(uint8_t step) {
  for (const auto start = Clock::now(); secondsSince(start) < kRobotAnswerTimeout;) {
    decoder_.feed(receive(0.05));
    while (const auto payload = decoder_.next())
      if (payload->front() == step && !live::arcos::decodeSip(*payload)) return true;
  }
  return false;
}

void PioneerOdometry::doProcess() {
  if (secondsSince(lastPulse_) >= kPulseInterval) {
    command(live::arcos::pulse);
    lastPulse_ = Clock::now();
  }
  const size_t damagedBefore = decoder_.damaged();
  decoder_.feed(receive(0.01));
  while (const auto payload = decoder_.next()) {
    const auto sip = live::arcos::decodeSip(*payload);
    if (!sip) continue;
    auto observation = mrpt::obs::CObservationOdometry::Create();
    observation->timestamp = mrpt::Clock::now();
    observation->sensorLabel = m_sensorLabel;
    observation->odometry = mrpt::poses::CPose2D((*odometry_)(*sip));
    appendObservation(observation);
    lastSip_ = Clock::now();
    m_state = ssWorking;
  }
  tellOfDamage(damagedBefore);
  if (secondsSince(lastSip_) > kSilence) throw std::runtime_error("the robot is silent");
}

/// Reports the 1st, 2nd, 4th, 8th ... damaged packet, so that a noisy line does not flood the log.
void PioneerOdometry::tellOfDamage(size_t before) {
  for (size_t n = before + 1; n <= decoder_.damaged(); ++n)
    if ((n & (n - 1)) == 0) MRPT_LOG_WARN_STREAM("damaged packets skipped: " << n << " so far");
}

void PioneerOdometry::command(uint8_t number) { send(live::arcos::encode({number})); }

std::string PioneerOdometry::receive(double timeout) {
  if (socket_.isOpen()) return socket_.receive(timeout);
  std::string bytes(256, '\0');
  bytes.resize(serial_->Read(bytes.data(), bytes.size()));
  return bytes;
}

void PioneerOdometry::send(const std::string& bytes) {
  if (socket_.isOpen()) return socket_.send(bytes, kRobotAnswerTimeout);
  if (serial_->Write(bytes.data(), bytes.size()) != bytes.size())
    throw std::runtime_error("serial port lost");
}

}  // namespace hybrid_slam::sensors
