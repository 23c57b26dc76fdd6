/// Our drivers and MRPT's CLMS100Eth with simulated devices, up to the map.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "files/IniFile.h"
#include "files/TemporaryFolder.h"
#include "files/Trajectory.h"
#include "live/CycleGrouper.h"
#include "live_run/LiveRun.h"
#include "run/Replay.h"
#include "sensors/Lms100.h"
#include "sensors/PioneerOdometry.h"
#include "sensors/SensorSource.h"
#include "standins/LmsStandIn.h"
#include "standins/PioneerStandIn.h"
#include "testing/ErrorOf.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"

namespace hybrid_slam {
namespace {

using Fault = test::StandIn::Fault;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;
using test::happens;
using testing::HasSubstr;

std::string lmsSection(uint16_t port, const std::string& driver = "Lms100") {
  return "[LASER]\ndriver = " + driver +
         "\nprocess_rate = 100\nsensorLabel = LASER\nip_address = 127.0.0.1\nTCP_port = " +
         std::to_string(port) + "\npose_x = 0.15\nright_to_left = true\n";
}
std::string pioneerSection(uint16_t port) {
  return "[PIONEER]\ndriver = PioneerOdometry\nprocess_rate = 200\nhost = 127.0.0.1\ntcp_port = " +
         std::to_string(port) + "\n";
}

/// The sensors of an INI text and their observations. They are grouped into cycles only for a sink: grouping
/// delays odometry without scans by a second.
class Sensors {
 public:
  Sensors(const std::string& ini, test::Events& events, double timeout = 0.5, live::CycleSink sink = {}) {
    mrpt::config::CConfigFileMemory config(ini);
    std::vector<std::string> sections;
    config.getAllSections(sections);
    for (const std::string& section : sections)
      if (config.keyExists(section, "driver"))
        threads_.push_back(
            std::make_unique<sensors::SensorThread>(config, section, timeout, inbox_, events.shared()));
    for (const auto& sensor : threads_) sensor->start();
    thread_ = std::thread([this, sink = std::move(sink)] {
      live::CycleGrouper grouper(
          0, sink ? sink : [](const CSensoryFrame::Ptr&) {});
      while (!stop_)
        for (const auto& observation : inbox_->take(0.02)) {
          note(observation);
          grouper.add(observation);
        }
      grouper.finish();
    });
  }
  ~Sensors() { stop(); }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    threads_.clear();
  }
  std::vector<CObservation2DRangeScan::Ptr> scans() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return scans_;
  }
  std::vector<mrpt::math::TPose2D> odometry() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return odometry_;
  }

 private:
  void note(const mrpt::obs::CObservation::Ptr& observation) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation))
      scans_.push_back(scan);
    if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation))
      odometry_.push_back(odometry->odometry.asTPose());
  }

  std::shared_ptr<sensors::ObservationInbox> inbox_ = std::make_shared<sensors::ObservationInbox>();
  std::vector<std::unique_ptr<sensors::SensorThread>> threads_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  std::vector<CObservation2DRangeScan::Ptr> scans_;
  std::vector<mrpt::math::TPose2D> odometry_;
  std::thread thread_;
};

class DeviceTest : public testing::Test {
 protected:
  test::SimulatedRobot robot{SOURCE_DIR "/datasets/csie/csie.plan",
                             SOURCE_DIR "/datasets/csie/csie-loop.route", 0.4};
  test::Events events;
};

class Lms100Test : public DeviceTest, public testing::WithParamInterface<const char*> {
 protected:
  std::string section(uint16_t port) const { return lmsSection(port, GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Drivers, Lms100Test, testing::Values("Lms100", "CLMS100Eth"));

TEST_P(Lms100Test, ItsScansArriveAsTheDeviceMadeThem) {
  test::LmsStandIn lms(robot);
  Sensors sensors(section(lms.port()), events);
  ASSERT_TRUE(test::happens([&] { return sensors.scans().size() >= 3; })) << events.text();
  const auto truth = robot.scans();
  const auto scan = sensors.scans()[1];
  // One of the scans that the device made, not mirrored.
  const auto isThis = [&scan](const CObservation2DRangeScan& made) {
    for (size_t i = 0; i < 541; ++i)
      if (made.getScanRangeValidity(i) && std::abs(made.getScanRange(i) - scan->getScanRange(i)) > 0.0006)
        return false;
    return true;
  };
  ASSERT_EQ(scan->getScanSize(), 541u);
  EXPECT_EQ(std::count_if(truth.begin(), truth.end(), isThis), 1);
  EXPECT_TRUE(scan->rightToLeft) << "as in the INI file and the device; MRPT's driver reports the opposite";
  EXPECT_NEAR(scan->aperture, 1.5 * M_PI, 1e-4);
  EXPECT_NEAR(scan->sensorPose.x(), 0.15, 1e-6);
  EXPECT_EQ(scan->sensorLabel, "LASER");
  EXPECT_EQ(events.count("sensor LASER: works"), 1u) << events.text();
}

TEST(Lms100, AFanThatIsNotSymmetricTurnsTheSensorPose) {
  sensors::Lms100Options options;
  options.x = 0.2, options.yaw = 10, options.maxRange = 5;
  live::cola::Scan scan;
  scan.first = 0, scan.step = M_PI / 4;  // from the right to 90 deg, which is ahead
  scan.ranges = {1, 0, 5};
  auto observation = sensors::observationOf(scan, options);
  EXPECT_NEAR(observation->aperture, M_PI / 2, 1e-6);
  EXPECT_NEAR(observation->sensorPose.yaw(), (10 - 45) * M_PI / 180, 1e-9);
  EXPECT_NEAR(observation->sensorPose.x(), 0.2, 1e-12);
  EXPECT_TRUE(observation->getScanRangeValidity(0));
  EXPECT_FALSE(observation->getScanRangeValidity(1)) << "no return";
  EXPECT_FALSE(observation->getScanRangeValidity(2)) << "at the maximum range";
  options.isRightToLeft = false;
  EXPECT_NEAR(sensors::observationOf(scan, options)->sensorPose.yaw(), (10 + 45) * M_PI / 180, 1e-9);
}

TEST(Sensors, TheirKeysAreInTheDocumentation) {
  sensors::Lms100Options laser;
  sensors::PioneerOptions pioneer;
  std::ostringstream manual;
  files::writeManual({{"LASER", &laser}, {"PIONEER", &pioneer}}, manual);
  const std::string page = test::contentOf(SOURCE_DIR "/doc/live.md");
  std::istringstream rows(manual.str());
  for (std::string row; std::getline(rows, row);)
    if (row.substr(0, 3) == "| `") {
      EXPECT_THAT(page, HasSubstr(row + "\n"));
    }
}

TEST_F(DeviceTest, ThePioneersOdometryIsTheRobots) {
  test::PioneerStandIn pioneer(robot, 100);
  Sensors sensors(pioneerSection(pioneer.port()), events);
  ASSERT_TRUE(test::happens([&] { return !sensors.odometry().empty(); })) << events.text();
  for (int i = 0; i < 30; ++i) robot.scan();
  const auto truth = robot.odometry();
  ASSERT_TRUE(test::happens([&] { return std::abs(sensors.odometry().back().x - truth.x) < 0.001; }));
  EXPECT_NEAR(sensors.odometry().back().y, truth.y, 0.001);
  EXPECT_NEAR(sensors.odometry().back().phi, truth.phi, M_PI / 4096 + 1e-9);
  ASSERT_TRUE(test::happens([&] { return pioneer.pulses() >= 2; })) << "the watchdog is fed";
  sensors.stop();
  EXPECT_TRUE(test::happens([&] { return pioneer.closes() == 1; }));
  EXPECT_THAT(pioneer.commands(), testing::IsSubsetOf({live::arcos::pulse, live::arcos::close}))
      << "and nothing that moves it";
}

/// A serial line (a pseudo-terminal) that ends in a TCP connection.
class SerialLine {
 public:
  explicit SerialLine(uint16_t port) : socket_(live::TcpSocket::connectTo("127.0.0.1", port, 10)) {
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    ::grantpt(master_), ::unlockpt(master_);
    char text[64];
    ::ptsname_r(master_, text, sizeof text);
    name_ = text;
    slave_ =
        ::open(text, O_RDWR | O_NOCTTY);  // stays open, so that the line does not hang up between two users
    termios raw{};
    ::tcgetattr(slave_, &raw), ::cfmakeraw(&raw), ::tcsetattr(slave_, TCSANOW, &raw);
    thread_ = std::thread([this] {
      char bytes[256];
      while (!stop_) {
        const ssize_t count = ::read(master_, bytes, sizeof bytes);
        if (count > 0) socket_.send(std::string(bytes, static_cast<size_t>(count)), 5);
        const std::string answer = socket_.receive(0.005);
        [[maybe_unused]] const ssize_t ignored = ::write(master_, answer.data(), answer.size());
      }
    });
  }
  ~SerialLine() {
    stop_ = true;
    thread_.join();
    ::close(slave_), ::close(master_);
  }
  const std::string& name() const { return name_; }

 private:
  live::TcpSocket socket_;
  int master_ = -1, slave_ = -1;
  std::string name_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

TEST_F(DeviceTest, APioneerOnASerialLine) {
  test::PioneerStandIn pioneer(robot, 100);
  const SerialLine line(pioneer.port());
  Sensors sensors(
      "[PIONEER]\ndriver = PioneerOdometry\nprocess_rate = 50\nserial_port = " + line.name() + "\n", events);
  ASSERT_TRUE(test::happens([&] { return !sensors.odometry().empty(); })) << events.text();
  for (int i = 0; i < 10; ++i) robot.scan();
  EXPECT_TRUE(
      test::happens([&] { return std::abs(sensors.odometry().back().x - robot.odometry().x) < 0.001; }));
  sensors.stop();
  EXPECT_TRUE(test::happens([&] { return pioneer.closes() == 1; }));
}

TEST_F(DeviceTest, TheRecordingOfBothDevicesReplaysToTheSameMap) {
  test::LmsStandIn lms(robot);
  test::PioneerStandIn pioneer(robot, 100);
  const files::TemporaryFolder folder;
  const std::string ini =
      folder.write("run.ini", "[particle_filter]\nparticles = 10\nproposal = standard\n" +
                                  lmsSection(lms.port()) + pioneerSection(pioneer.port()));
  live::LiveOptions options;
  options.maxWaiting = 1000;
  run::Configuration configuration(ini, {"run.output=" + folder.path("live")});
  live::LiveRun run(configuration, options, events.log(), true);
  Sensors sensors(test::contentOf(ini), events, 5, [&](const CSensoryFrame::Ptr& cycle) { run.take(cycle); });
  ASSERT_TRUE(test::happens([&] { return sensors.scans().size() >= 25; })) << events.text();
  sensors.stop();
  run.finish(0);
  EXPECT_EQ(run.skipped(), 0u);

  run::Configuration again(ini, {"run.output=" + folder.path("offline")});
  again.run.rawlog = test::filesIn(folder.path("live"), "recording-").at(0);
  const std::atomic<bool> stop{false};
  run::replay(again, true, stop, "test");
  const std::string trajectory = test::contentOf(folder.path("live/trajectory.tum"));
  EXPECT_EQ(trajectory, test::contentOf(folder.path("offline/trajectory.tum")));
  EXPECT_EQ(test::contentOf(folder.path("live/map.pgm")), test::contentOf(folder.path("offline/map.pgm")));

  // The robot's path until the last scan was grouped.
  const auto poses = files::loadTum(folder.path("live/trajectory.tum"));
  ASSERT_GE(poses.size(), 25u);
  const double way =
      std::hypot(poses.back().pose.x - poses.front().pose.x, poses.back().pose.y - poses.front().pose.y);
  EXPECT_GT(way, 3) << "24 steps of 0.26 m";
}

TEST_P(Lms100Test, IsRetriedIfItIsMissing) {
  uint16_t port = 0;
  {
    live::TcpListener reserved("127.0.0.1", 0);
    port = reserved.port();
  }
  Sensors sensors(section(port), events);
  ASSERT_TRUE(test::happens([&] { return events.count("sensor LASER: fault") == 1; }));
  test::LmsStandIn lms(robot, port);
  EXPECT_TRUE(test::happens([&] { return !sensors.scans().empty(); })) << events.text();
}

TEST_P(Lms100Test, RecoversFromEveryFault) {
  test::LmsStandIn lms(robot);
  Sensors sensors(section(lms.port()), events, 0.3);
  for (const Fault fault : {Fault::cut, Fault::garbled, Fault::silent, Fault::refusing}) {
    ASSERT_TRUE(test::happens([&] { return !sensors.scans().empty(); }));
    const bool isHarmless = fault == Fault::garbled && GetParam() == std::string("Lms100");
    const size_t faults = events.count("sensor LASER: fault"), scans = sensors.scans().size();
    lms.set(fault);
    ASSERT_TRUE(test::happens([&] {
      return isHarmless ? sensors.scans().size() > scans + 20 : events.count("sensor LASER: fault") > faults;
    })) << events.text();
    EXPECT_EQ(events.count("sensor LASER: fault") > faults, !isHarmless) << events.text();
    if (isHarmless) {
      EXPECT_GE(events.count("damaged scans skipped: 1 so far"), 1u) << events.text();
    }
    lms.set(Fault::none);
    const size_t before = sensors.scans().size();
    ASSERT_TRUE(test::happens([&] { return sensors.scans().size() > before + 2; })) << events.text();
  }
  for (const auto& scan : sensors.scans()) EXPECT_EQ(scan->getScanSize(), 541u) << "no part of a scan";
}

TEST_F(DeviceTest, ThePioneersOdometryContinuesAfterEveryFault) {
  for (int i = 0; i < 20; ++i) robot.scan();
  test::PioneerStandIn pioneer(robot, 100);
  Sensors sensors(pioneerSection(pioneer.port()), events, 0.3);
  for (const Fault fault : {Fault::refusing, Fault::silent}) {
    ASSERT_TRUE(test::happens([&] { return !sensors.odometry().empty(); })) << events.text();
    const size_t faults = events.count("sensor PIONEER: fault");
    pioneer.set(fault);
    ASSERT_TRUE(test::happens([&] { return events.count("sensor PIONEER: fault") > faults; }))
        << events.text();
    for (int i = 0; i < 10; ++i) robot.scan();  // unobserved motion
    pioneer.set(Fault::none);
    const size_t before = sensors.odometry().size();
    ASSERT_TRUE(test::happens([&] { return sensors.odometry().size() > before; })) << events.text();
    robot.scan();
  }
  const auto poses = sensors.odometry();
  for (size_t i = 1; i < poses.size(); ++i)
    EXPECT_LT((poses[i] - poses[i - 1]).norm(), 0.6)
        << "no jump back to zero, and none by the unobserved motion";
}

TEST_F(DeviceTest, DamagedPacketsOfThePioneerAreDroppedAndReported) {
  test::PioneerStandIn pioneer(robot, 100);
  Sensors sensors(pioneerSection(pioneer.port()), events);
  ASSERT_TRUE(test::happens([&] { return !sensors.odometry().empty(); }));
  for (const Fault fault : {Fault::cut, Fault::garbled}) {
    pioneer.set(fault);
    const size_t before = sensors.odometry().size();
    ASSERT_TRUE(test::happens([&] { return sensors.odometry().size() > before + 20; }));
  }
  for (const auto& pose : sensors.odometry())
    EXPECT_EQ(pose, mrpt::math::TPose2D(0, 0, 0)) << "it stands still";
  EXPECT_EQ(events.count("fault"), 0u) << events.text();
  EXPECT_GE(events.count("damaged packets skipped"), 1u);
}

TEST_F(DeviceTest, WrongSettingsAreErrorsBeforeAnythingRuns) {
  const auto errorOf = [&](const std::string& ini) {
    const std::string error = test::errorOf([&] {
      mrpt::config::CConfigFileMemory config(ini);
      sensors::SensorSource(config, 5, 1, events.shared());
    });
    EXPECT_THAT(error, testing::Not(HasSubstr("\n")));
    return error;
  };
  EXPECT_THAT(errorOf("[live]\nserver = a:1\n"), HasSubstr("no sensors"));
  EXPECT_THAT(errorOf("[A]\ndriver = CNoSuchThing\nprocess_rate = 5\n"),
              HasSubstr("unknown driver `CNoSuchThing`"));
  EXPECT_THAT(errorOf("[A]\ndriver = CHokuyoURG\nCOM_port_LIN = x\n"), HasSubstr("section [A]"));
  const std::string ofMrpt = "[H]\ndriver = CHokuyoURG\nprocess_rate = 5\n";
  EXPECT_THAT(errorOf(ofMrpt + "time_offset = soon\n"), HasSubstr("section [H], key `time_offset`"));
  EXPECT_THAT(errorOf(ofMrpt + "time_offset = 11\n"), HasSubstr("-10..10"));
  EXPECT_THAT(errorOf(ofMrpt + "right_to_left = maybe\n"), HasSubstr("section [H], key `right_to_left`"));
  const std::string laser = "[L]\ndriver = CLMS100Eth\nprocess_rate = 5\n";
  EXPECT_EQ(errorOf(laser), "no error") << "192.168.0.1";
  for (const char* address :
       {"127.0.0.1", "10.1.2.3", "172.16.0.1", "172.31.255.255", "192.168.1.7", "169.254.9.9"})
    EXPECT_EQ(errorOf(laser + "ip_address = " + address + "\n"), "no error") << address;
  for (const char* address :
       {"8.8.8.8", "172.32.0.1", "172.15.0.1", "192.169.0.1", "laser.example", "10.1", "::1"}) {
    const std::string error = errorOf(laser + "ip_address = " + address + "\n");
    EXPECT_THAT(error, testing::AllOf(HasSubstr(address), HasSubstr("section [L], key `ip_address`")))
        << address;
    EXPECT_EQ(errorOf(laser + "ip_address = " + address + "\ntrust_address = true\n"), "no error") << address;
  }
  const std::string own = "[L]\ndriver = Lms100\n";
  EXPECT_EQ(errorOf(own + "ip_address = laser.example\n"), "no error") << "its reader is safe";
  EXPECT_THAT(errorOf(own + "ip_adress = 10.0.0.1\n"), HasSubstr("nearest known key is `ip_address`"));
  EXPECT_THAT(errorOf(own + "TCP_port = 0\n"), HasSubstr("1..65535"));
  const std::string pioneer = "[P]\ndriver = PioneerOdometry\n";
  EXPECT_EQ(errorOf(pioneer + "host = robot\n"), "no error");
  EXPECT_THAT(errorOf(pioneer), HasSubstr("expected exactly one of the two"));
  EXPECT_THAT(errorOf(pioneer + "host = robot\nserial_port = ttyS0\n"),
              HasSubstr("expected exactly one of the two"));
  EXPECT_THAT(errorOf(pioneer + "hots = robot\n"), HasSubstr("nearest known key is `host`"));
  EXPECT_THAT(errorOf(pioneer + "host = robot\ntcp_port = 0\n"), HasSubstr("1..65535"));
  EXPECT_THAT(errorOf(pioneer + "host = robot\nprocess_rate = 0\n"), HasSubstr("process_rate"));
  EXPECT_THAT(errorOf(pioneer + "host = robot\nrawlog-grabber-ignore = true\n"), HasSubstr("no sensors"));
}

}  // namespace
}  // namespace hybrid_slam
