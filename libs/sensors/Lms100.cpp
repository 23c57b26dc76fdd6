#include "sensors/Lms100.h"

#include <mrpt/core/bits_math.h>

#include <stdexcept>

#include "base/Clock.h"
#include "base/Memory.h"

IMPLEMENTS_GENERIC_SENSOR(Lms100, hybrid_slam::sensors)

namespace hybrid_slam::sensors {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose3D;

constexpr double kLaserConnectTimeout = 3, kLaserAnswerTimeout = 2, kAskAgain = 0.3;  // s
constexpr float kNoise = 0.012F;  // m, one sigma (data sheet)
const char* const kMeasuring = "sRA STlms 7";

bool startsWith(const std::string& text, const std::string& head) {
  return text.compare(0, head.size(), head) == 0;
}

}  // namespace

void Lms100Options::describe(OptionTable& t) {
  describeCommon(t, "Lms100", "the laser sends 25 or 50 scans per second");
  t.add("ip_address", address, "host of the laser");
  t.add("TCP_port", port, 1, 65535, "TCP port of the laser");
  t.add("max_range", maxRange, 1, 65, "m", "range of the laser: 20 m for an LMS-100 or 111, 50 m for a 151");
  t.add("pose_x", x, -100, 100, "m", "place of the laser on the robot, x forwards");
  t.add("pose_y", y, -100, 100, "m", "y to the left");
  t.add("pose_z", z, -100, 100, "m", "z upwards");
  t.add("pose_yaw", yaw, -360, 360, "deg", "its direction on the robot");
  t.add("pose_pitch", pitch, -360, 360, "deg", "its inclination");
  t.add("pose_roll", roll, -360, 360, "deg", "180: it is mounted upside down");
  t.add("right_to_left", isRightToLeft, "beam order as seen from its upper side; true: as the device has it");
}

CObservation2DRangeScan::Ptr observationOf(const live::cola::Scan& scan, const Lms100Options& options) {
  auto observation = CObservation2DRangeScan::Create();
  observation->sensorLabel = options.sensorLabel;
  observation->rightToLeft = options.isRightToLeft;
  observation->maxRange = static_cast<float>(options.maxRange);
  observation->stdError = kNoise;
  const double span = scan.step * static_cast<double>(scan.ranges.size() - 1);
  observation->aperture = static_cast<float>(span);
  const double middle = scan.first + span / 2 - M_PI / 2;
  const CPose3D pose(options.x, options.y, options.z, mrpt::DEG2RAD(options.yaw),
                     mrpt::DEG2RAD(options.pitch), mrpt::DEG2RAD(options.roll));
  observation->sensorPose = pose + CPose3D(0, 0, 0, options.isRightToLeft ? middle : -middle, 0, 0);
  resizeScan(*observation, scan.ranges.size());
  for (size_t i = 0; i < scan.ranges.size(); ++i) {
    observation->setScanRange(i, scan.ranges[i]);
    observation->setScanRangeValidity(i, scan.ranges[i] > 0 && scan.ranges[i] < observation->maxRange);
  }
  return observation;
}

void Lms100::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config,
                                       const std::string& section) {
  options_.loadFromConfigFile(config, section);
  m_sensorLabel = options_.sensorLabel;
  m_process_rate = options_.processRate;
}

void Lms100::initialize() {
  m_state = ssInitializing;
  decoder_ = {};
  isSending_ = false;
  lastAsked_ = {};
  socket_ = live::TcpSocket::connectTo(options_.address, static_cast<uint16_t>(options_.port),
                                       kLaserConnectTimeout);
  if (!startsWith(ask("sMN SetAccessMode 03 F4724744", "sAN SetAccessMode"), "sAN SetAccessMode 1"))
    throw std::runtime_error("the laser refuses the login");
  ask("sWN LMDscandatacfg 01 00 0 1 0 00 00 0 0 0 0 +1", "sWA LMDscandatacfg");
  ask("sMN LMCstartmeas", "sAN LMCstartmeas");
}

/// Returns whether the laser measures; it needs some seconds after it was switched on.
bool Lms100::isReady() {
  if (!startsWith(ask("sRN STlms", "sRA STlms"), kMeasuring)) return false;
  ask("sMN Run", "sAN Run");
  ask("sEN LMDscandata 1", "sEA LMDscandata");
  return true;
}

void Lms100::doProcess() {
  if (!isSending_ && secondsSince(lastAsked_) > kAskAgain) {
    isSending_ = isReady();
    lastAsked_ = Clock::now();
  }
  if (!isSending_) return;
  decoder_.feed(socket_.receive(0.01));
  while (const auto telegram = decoder_.next()) {
    if (!live::cola::isScan(*telegram)) continue;
    if (const auto scan = live::cola::decodeScan(*telegram)) {
      const auto observation = observationOf(*scan, options_);
      observation->timestamp = mrpt::Clock::now();
      appendObservation(observation);
      m_state = ssWorking;
    } else if (++damaged_; (damaged_ & (damaged_ - 1)) == 0) {  // the 1st, 2nd, 4th, 8th ...
      MRPT_LOG_WARN_STREAM("damaged scans skipped: " << damaged_ << " so far");
    }
  }
}

/// Sends a telegram and waits for its answer; skips others, such as scans.
std::string Lms100::ask(const std::string& telegram, const std::string& answer) {
  socket_.send(live::cola::encode(telegram), kLaserAnswerTimeout);
  const auto start = Clock::now();
  do {
    while (const auto received = decoder_.next()) {
      if (startsWith(*received, answer)) return *received;
      if (startsWith(*received, "sFA")) throw std::runtime_error("the laser refuses `" + telegram + "`");
    }
    decoder_.feed(socket_.receive(0.05));
  } while (secondsSince(start) < kLaserAnswerTimeout);
  throw std::runtime_error("no answer to `" + telegram + "`: not an LMS-1xx");
}

}  // namespace hybrid_slam::sensors
