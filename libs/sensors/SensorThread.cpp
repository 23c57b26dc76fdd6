#include "sensors/SensorThread.h"

#include <arpa/inet.h>
#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/system/COutputLogger.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "base/Clock.h"
#include "base/Errors.h"
#include "base/Options.h"
#include "files/ObjectReader.h"
#include "live/OdometryContinuity.h"
#include "sensors/Lms100.h"
#include "sensors/PioneerOdometry.h"

namespace hybrid_slam::sensors {
namespace {

using Clock = std::chrono::steady_clock;
using mrpt::hwdrivers::CGenericSensor;
using mrpt::obs::CObservation;

constexpr double kShortestPause = 0.2, kLongestPause = 10;  // s
std::atomic<size_t> countLeftBehind{0};

/// Detects the scans without beams that CLMS100Eth returns once its connection is lost.
bool isEmptyScan(const CObservation& observation) {
  const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation);
  return scan && scan->getScanSize() == 0;
}

/// Returns whether an IPv4 address is this machine's, or reachable only from the local network (RFC 1918,
/// link-local).
bool isPrivate(const std::string& address) {
  in_addr ip{};
  if (::inet_pton(AF_INET, address.c_str(), &ip) != 1) return false;
  const uint32_t bits = ntohl(ip.s_addr);
  return bits >> 24 == 127 || bits >> 24 == 10 || bits >> 20 == 0xAC1 || bits >> 16 == 0xC0A8 ||
         bits >> 16 == 0xA9FE;
}

/// Rejects public addresses: MRPT's driver reads past its buffer if the device sends noise (doc/security.md).
void checkLaserAddress(const mrpt::config::CConfigFileMemory& config, const std::string& section) {
  const std::string address = config.read_string(section, "ip_address", "192.168.0.1");
  if (isPrivate(address) || config.read_bool(section, "trust_address", false)) return;
  throw InputError(
      "`" + address + "` is not a private address", "section [" + section + "], key `ip_address`",
      "expected the laser in the robot's own network, such as 192.168.0.1, or trust_address = true");
}

/// The keys that are read here, of a sensor of any driver. The others are the driver's.
struct CommonOptions : Options {
  double timeOffset = 0;  ///< s
  bool isRightToLeft = false;

  void describe(OptionTable& t) override {
    t.add("time_offset", timeOffset, -10, 10, "s", "added to the observations' timestamps");
    t.add("right_to_left", isRightToLeft, "beam order as seen from its upper side");
  }
  void load(const mrpt::config::CConfigFileMemory& config, const std::string& section) {
    mrpt::config::CConfigFileMemory known;
    for (const Option& option : table())
      if (config.keyExists(section, option.key))
        known.write(section, option.key, config.read_string(section, option.key, ""));
    loadFromConfigFile(known, section);
  }
};

std::string oneLine(std::string text) {
  text.erase(text.find_last_not_of(" \n") + 1);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

void ObservationInbox::put(const std::vector<CObservation::Ptr>& observations) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.insert(waiting_.end(), observations.begin(), observations.end());
  }
  changed_.notify_one();
}

std::deque<CObservation::Ptr> ObservationInbox::take(double timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(timeout), [this] { return !waiting_.empty(); });
  return std::exchange(waiting_, {});
}

/// State of the thread.
struct SensorThread::Work {
  mrpt::config::CConfigFileMemory config;
  std::string section, driver;
  double timeout = 0;     ///< s
  double timeOffset = 0;  ///< s
  std::optional<bool> rightToLeft;
  std::shared_ptr<ObservationInbox> inbox;
  std::shared_ptr<live::EventLog> log;
  live::OdometryContinuity odometry{};

  std::mutex mutex{};
  std::condition_variable changed{};
  bool stop = false, hasStopped = false;

  bool mustStop() {
    const std::lock_guard<std::mutex> lock(mutex);
    return stop;
  }
  void pause(double seconds) {
    std::unique_lock<std::mutex> lock(mutex);
    changed.wait_for(lock, std::chrono::duration<double>(std::max(0., seconds)), [this] { return stop; });
  }
  void report(const std::string& event) const { log->report("sensor " + section, event); }

  CGenericSensor::Ptr make() const;
  void correct(CObservation& observation);
  void grab(double& nextPause);
  void run();
};

CGenericSensor::Ptr SensorThread::Work::make() const {
  CGenericSensor::Ptr sensor = CGenericSensor::createSensorPtr(driver);
  if (auto* output = dynamic_cast<mrpt::system::COutputLogger*>(sensor.get())) {
    // Drivers are verbose: only their warnings and errors become events.
    output->logging_enable_console_output = false;
    output->setMinLoggingLevel(mrpt::system::LVL_WARN);
    output->logRegisterCallback([log = log, subject = "sensor " + section](
                                    std::string_view text, const mrpt::system::VerbosityLevel level,
                                    std::string_view, const mrpt::Clock::time_point) {
      if (level >= mrpt::system::LVL_WARN) log->report(subject + " (driver)", oneLine(std::string(text)));
    });
  }
  sensor->loadConfig(config, section);
  return sensor;
}

void SensorThread::Work::correct(CObservation& observation) {
  if (timeOffset != 0 && observation.timestamp != INVALID_TIMESTAMP)
    observation.timestamp +=
        std::chrono::duration_cast<mrpt::Clock::duration>(std::chrono::duration<double>(timeOffset));
  if (auto* scan = dynamic_cast<mrpt::obs::CObservation2DRangeScan*>(&observation); scan && rightToLeft)
    scan->rightToLeft = *rightToLeft;
  live::rebase(observation, odometry);
}

/// Runs until an error, then throws.
void SensorThread::Work::grab(double& nextPause) {
  const CGenericSensor::Ptr sensor = make();
  sensor->initialize();
  odometry.restart();
  const double period = 1 / sensor->getProcessRate();
  auto lastObservation = Clock::now();
  bool isFirst = true;
  std::set<std::string> unreadable;  // classes
  while (!mustStop()) {
    const auto start = Clock::now();
    sensor->doProcess();
    std::vector<CObservation::Ptr> observations;
    for (const auto& [time, object] : sensor->getObservations()) {
      const auto observation = std::dynamic_pointer_cast<CObservation>(object);
      if (!observation || isEmptyScan(*observation)) continue;
      if (!files::isReadable(*observation)) {
        if (unreadable.insert(observation->GetRuntimeClass()->className).second)
          report(std::string("observations of class ") + observation->GetRuntimeClass()->className +
                 " are not read");
        continue;
      }
      observations.push_back(observation);
    }
    for (const auto& observation : observations) correct(*observation);
    if (!observations.empty()) {
      lastObservation = Clock::now();
      if (isFirst) report("works");
      isFirst = false;
      nextPause = kShortestPause;
      inbox->put(observations);
    } else if (secondsSince(lastObservation) > timeout) {
      throw std::runtime_error("no data");
    }
    pause(period - secondsSince(start));
  }
}

void SensorThread::Work::run() {
  double nextPause = kShortestPause;
  while (!mustStop()) {
    try {
      grab(nextPause);
    } catch (const std::exception& e) {
      report("fault (" + messageOf(e) + "); restarting");
      pause(nextPause);
      nextPause = std::min(2 * nextPause, kLongestPause);
    }
  }
  const std::lock_guard<std::mutex> lock(mutex);
  hasStopped = true;
  changed.notify_all();
}

SensorThread::SensorThread(const mrpt::config::CConfigFileMemory& config, const std::string& section,
                           double timeout, std::shared_ptr<ObservationInbox> inbox,
                           std::shared_ptr<live::EventLog> log)
    : work_(std::make_shared<Work>()) {
  Lms100::doRegister();
  PioneerOdometry::doRegister();
  const std::string where = "section [" + section + "]";
  work_->config.setContent(config.getContent());  // copies would share the content between threads
  work_->section = section;
  work_->timeout = timeout;
  work_->inbox = std::move(inbox);
  work_->log = std::move(log);
  work_->driver = config.read_string(section, "driver", "");
  if (!CGenericSensor::createSensorPtr(work_->driver))
    throw InputError(
        "unknown driver `" + work_->driver + "`", where + ", key `driver`",
        "expected Lms100, PioneerOdometry or one of MRPT's, such as CHokuyoURG, CSickLaserSerial");
  if (work_->driver == "CLMS100Eth") checkLaserAddress(config, section);
  try {
    CommonOptions common;
    common.load(config, section);
    work_->timeOffset = common.timeOffset;
    if (config.keyExists(section, "right_to_left")) work_->rightToLeft = common.isRightToLeft;
    if (!(work_->make()->getProcessRate() > 0))
      throw InputError("no rate", where + ", key `process_rate`", "expected a rate above 0 Hz");
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError("wrong settings for the driver " + work_->driver, where, messageOf(e));
  }
}

void SensorThread::start() {
  thread_ = std::thread([work = work_] { work->run(); });
}

SensorThread::~SensorThread() {
  if (!thread_.joinable()) return;
  bool hasStopped = false;
  {
    std::unique_lock<std::mutex> lock(work_->mutex);
    work_->stop = true;
    work_->changed.notify_all();
    hasStopped = work_->changed.wait_for(lock, std::chrono::seconds(3), [this] { return work_->hasStopped; });
  }
  if (hasStopped) {
    thread_.join();
  } else {
    ++countLeftBehind;
    thread_.detach();
  }
}

size_t SensorThread::leftBehind() { return countLeftBehind; }

}  // namespace hybrid_slam::sensors
