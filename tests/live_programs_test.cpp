/// observation-server and hybrid-slam-live from the command line.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "ChildProgram.h"
#include "InstalledProgram.h"
#include "ResultFiles.h"
#include "Shell.h"
#include "files/RawlogReader.h"
#include "files/TemporaryFolder.h"
#include "files/Trajectory.h"
#include "testing/DriveLog.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"

namespace hybrid_slam {
namespace {

using Program = test::ChildProgram;
using test::contentOf;
using test::happens;
using testing::HasSubstr;
using testing::MatchesRegex;

class LivePrograms : public testing::Test {
 protected:
  std::unique_ptr<Program> server(const std::string& config, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{OBSERVATION_SERVER, config};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto program = std::make_unique<Program>(folder, "server", arguments);
    EXPECT_TRUE(happens([&] { return program->out().find('\n') != std::string::npos; })) << program->err();
    const std::string line = program->out();
    port = line.substr(line.rfind(':') + 1, line.find('\n') - line.rfind(':') - 1);
    return program;
  }
  /// The server that replays laps in the room.
  std::unique_ptr<Program> replaying(size_t steps, const std::string& rate, const std::string& atPort = "0") {
    return replaying(test::laps(steps), rate, atPort);
  }
  std::unique_ptr<Program> replaying(const test::Log& recorded, const std::string& rate,
                                     const std::string& atPort = "0") {
    const std::string log = test::writeGzipped(folder.path("log.rawlog"), recorded);
    return server(folder.write("server.ini", "[server]\nport = " + atPort +
                                                 "\nwait_for_clients = 1\nqueue = 10000\n" +
                                                 "replay_rate = " + rate + "\nrawlog = " + log + "\n"));
  }
  std::unique_ptr<Program> live(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{HYBRID_SLAM_LIVE, "--server", "127.0.0.1:" + port,     "-o",
                                       output,           "--set",    "live.max_waiting=10000"};
    if (!ini.empty()) arguments.push_back(ini);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Program>(folder, "live", arguments);
  }
  std::string replay(const std::string& log, const std::string& to) {
    Program program(folder, "replay", {HYBRID_SLAM, ini, log, "-q", "-o", folder.path(to)});
    EXPECT_EQ(program.wait(), 0) << program.err();
    return contentOf(folder.path(to + "/trajectory.tum"));
  }
  /// The session of a replay.
  std::string sessionOf(const test::Log& recorded) {
    replay(test::writeGzipped(folder.path("earlier.rawlog"), recorded), "earlier");
    return folder.path("earlier/session.hslam");
  }
  /// Waits for the first cycles in the recording, which are written in one block within 5 s.
  bool isRecording() const {
    return happens([&] {
      std::error_code none;
      const auto files = test::filesIn(output, ".partial.recording-");
      return !files.empty() && std::filesystem::file_size(files[0], none) > 1000 && !none;
    });
  }
  std::string result(const std::string& name) const { return contentOf(output + "/" + name); }
  /// Expects all results of a replay, and the recording.
  void expectAllResults() const {
    std::vector<std::string> all = test::kResults;
    all.push_back(std::filesystem::path(recording()).filename().string());
    EXPECT_THAT(test::namesIn(output), testing::UnorderedElementsAreArray(all));
  }
  std::string recording() const {
    const auto files = test::filesIn(output, "recording-20");
    return files.empty() ? "none" : files[0];
  }
  size_t recorded() const {
    files::RawlogReader reader(recording());
    size_t scans = 0;
    while (const auto object = reader.next())
      if (std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(object)) ++scans;
    EXPECT_EQ(reader.defect(), "");
    return scans;
  }
  void expectError(Program& program, const std::string& name, const std::string& text) {
    const int status = program.wait();
    test::expectInputError({status, program.out(), program.err()}, name, text);
  }

  files::TemporaryFolder folder;
  std::string ini = folder.write("live.ini",
                                 "[particle_filter]\nparticles = 5\nproposal = standard\nupdate_distance = "
                                 "0.2\n[grid]\nresolution = 0.1\n[live]\ndisk_reserve = 0\n");
  std::string output = folder.path("out"), port;
};

TEST_F(LivePrograms, TheLiveMapEqualsThatOfTheLogAndOfTheRecording) {
  const auto robot = replaying(100, "500");
  const auto map = live();
  EXPECT_EQ(map->wait(), 0) << map->err();
  EXPECT_EQ(robot->wait(), 0) << robot->err();
  EXPECT_THAT(robot->out(), HasSubstr("100 cycles served, 0 dropped"));
  EXPECT_THAT(map->out(), HasSubstr("100 scans"));
  expectAllResults();
  const std::string trajectory = result("trajectory.tum");
  EXPECT_EQ(std::count(trajectory.begin(), trajectory.end(), '\n'), 100);
  EXPECT_EQ(trajectory, replay(recording(), "again")) << "the recording's replay";
  EXPECT_EQ(trajectory, replay(folder.path("log.rawlog"), "original")) << "no cycle was lost";
  const auto metrics = nlohmann::json::parse(result("metrics.json"));
  EXPECT_EQ(metrics["skipped"], 0);
  EXPECT_EQ(metrics["lost_cycles"], 0);
  EXPECT_TRUE(metrics["latency_ms"].contains("median") && metrics["latency_ms"].contains("p99"));
  EXPECT_THAT(result("config.ini"), HasSubstr("max_waiting"));
}

TEST_F(LivePrograms, AServerNeedsNoIniFile) {
  const auto robot = replaying(60, "500");
  ini.clear();
  EXPECT_EQ(live()->wait(), 0);
  EXPECT_EQ(recorded(), 60u);
}

TEST_F(LivePrograms, ControlCWritesAllResults) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE(strsignal(signal));
    output = folder.path("until " + std::to_string(signal));
    std::filesystem::remove(folder.path("server.out"));  // it has the port of an earlier server
    const auto robot = replaying(5000, "50");
    const auto map = live();
    ASSERT_TRUE(happens([&] { return robot->err().find(": connected") != std::string::npos; }));
    ASSERT_TRUE(isRecording()) << map->err();
    map->signal(signal);
    EXPECT_EQ(map->wait(), 0) << map->err();
    expectAllResults();
    const size_t scans = nlohmann::json::parse(result("metrics.json"))["scans"];
    EXPECT_THAT(scans, testing::AllOf(testing::Gt(0u), testing::Lt(5000u)));
    EXPECT_EQ(recorded(), scans);
    robot->signal(signal);
    EXPECT_EQ(robot->wait(), 0);
  }
}

TEST_F(LivePrograms, AServerRestartContinuesTheSameMap) {
  auto robot = replaying(5000, "100");
  const auto map = live();
  ASSERT_TRUE(isRecording()) << map->err();
  robot->signal(SIGKILL);
  EXPECT_EQ(robot->endedBySignal(), SIGKILL);
  ASSERT_TRUE(happens([&] { return map->err().find("trying again") != std::string::npos; }));
  robot = replaying(50, "500", port);
  EXPECT_EQ(map->wait(), 0) << map->err();
  EXPECT_THAT(map->err(), HasSubstr("new server: odometry continues from the last pose"));
  const size_t scans = nlohmann::json::parse(result("metrics.json"))["scans"];
  EXPECT_GT(scans, 50u) << "both servers'";
  EXPECT_EQ(recorded(), scans);
  EXPECT_EQ(result("trajectory.tum"), replay(recording(), "again"));
}

TEST_F(LivePrograms, TheServerSaysThatItsLogIsDamaged) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(100));
  std::filesystem::resize_file(log, std::filesystem::file_size(log) / 2);
  const auto robot = server(folder.write(
      "server.ini", "[server]\nport = 0\nwait_for_clients = 1\nreplay_rate = 500\nrawlog = " + log + "\n"));
  EXPECT_THAT(
      robot->err(),
      MatchesRegex("observation-server: rawlog: log gzip file (damaged or )?cut off: entry [0-9]+ of " + log +
                   "; served up to this point\n"));
  const auto map = live();
  EXPECT_EQ(map->wait(), 0) << map->err();
  EXPECT_EQ(robot->wait(), 1) << "after it has served what is there";
}

TEST_F(LivePrograms, TheLogOfTheServerMayBeAnInstalledOne) {
  const test::InstalledProgram installed(folder, OBSERVATION_SERVER);
  test::writeGzipped(installed.data("room.rawlog"), test::laps(3));
  const std::string config = folder.write("server.ini", "[server]\nport = 0\nrawlog = data/room.rawlog\n");
  const test::Outcome outcome = test::shell(folder, "'" + installed.path + "' '" + config + "'");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n3 cycles served"));
}

TEST_F(LivePrograms, WithoutAServerThereAreNoResults) {
  port = "1";
  const auto map = live();
  ASSERT_TRUE(happens([&] { return map->err().find("refused") != std::string::npos; })) << map->err();
  map->signal(SIGTERM);
  EXPECT_EQ(map->wait(), 1);
  EXPECT_THAT(map->err(), HasSubstr("no scan with odometry"));
  EXPECT_FALSE(std::filesystem::exists(output));
}

TEST_F(LivePrograms, AnotherStartLosesNothing) {
  const auto robot = replaying(60, "500");
  const auto first = live();
  EXPECT_EQ(first->wait(), 0) << first->err();
  const std::string metrics = result("metrics.json"), recorded = contentOf(recording());
  const auto before = test::namesIn(output);

  port = "1";  // mistyped
  const auto second = live();
  ASSERT_TRUE(happens([&] { return second->err().find("refused") != std::string::npos; }));
  EXPECT_THAT(second->err(), HasSubstr("has results of an earlier run"));
  second->signal(SIGTERM);
  EXPECT_EQ(second->wait(), 1);
  EXPECT_THAT(test::namesIn(output), testing::UnorderedElementsAreArray(before));

  std::filesystem::remove(folder.path("server.out"));  // it has the port of the first server
  const auto again = replaying(60, "500");
  const auto third = live({"--overwrite"});
  EXPECT_EQ(third->wait(), 0) << third->err();
  EXPECT_NE(result("metrics.json"), metrics);
  EXPECT_EQ(contentOf(recording()), recorded);
  EXPECT_EQ(test::namesIn(output).size(), before.size() + 1) << "one recording more";
}

TEST_F(LivePrograms, AKilledRunLeavesItsRecording) {
  const auto robot = replaying(5000, "100");
  const auto map = live();
  ASSERT_TRUE(isRecording()) << map->err();
  map->signal(SIGKILL);
  EXPECT_EQ(map->endedBySignal(), SIGKILL);
  const auto left = test::filesIn(output, ".partial.recording-");
  ASSERT_EQ(left.size(), 1u);
  files::RawlogReader reader(left[0]);
  size_t objects = 0;
  while (reader.next()) ++objects;
  EXPECT_GT(objects, 10u);
}

TEST_F(LivePrograms, AKilledRunIsResumedFromItsCheckpointAndItsRecording) {
  const auto robot = replaying(5000, "100");
  const auto map = live({"--checkpoint-every", "0.3"});
  const std::string session = output + "/session.hslam";
  ASSERT_TRUE(happens([&] { return std::filesystem::exists(session); })) << map->err();
  const auto first = contentOf(session);
  ASSERT_TRUE(happens([&] { return contentOf(session) != first; })) << "the next checkpoint";
  map->signal(SIGKILL);
  EXPECT_EQ(map->endedBySignal(), SIGKILL);
  const auto left = test::filesIn(output, ".partial.recording-");
  ASSERT_EQ(left.size(), 1u);

  Program whole(folder, "whole", {HYBRID_SLAM, ini, left[0], "-q", "-o", folder.path("whole")});
  EXPECT_EQ(whole.wait(), 1) << "the recording is cut off";
  Program resumed(folder, "resumed", {HYBRID_SLAM, "--resume", session, left[0], "-q"});
  EXPECT_EQ(resumed.wait(), 1);
  EXPECT_THAT(resumed.err(), HasSubstr("cut off"));
  for (const char* name : {"trajectory.tum", "map.pgm", "lines.csv", "covariance.csv"}) {
    EXPECT_EQ(result(name), contentOf(folder.path("whole/") + name)) << name;
    EXPECT_FALSE(result(name).empty()) << name;
  }
}

TEST_F(LivePrograms, ASignalSavesTheMapAndTheRunGoesOn) {
  const auto robot = replaying(400, "100");
  const auto map = live();
  ASSERT_TRUE(isRecording()) << map->err();
  map->signal(SIGUSR1);
  ASSERT_TRUE(happens([&] { return map->err().find("map saved: ") != std::string::npos; })) << map->err();
  const auto saved = test::filesIn(output, "saved-20");
  ASSERT_EQ(saved.size(), 1u);
  EXPECT_THAT(map->err(), HasSubstr("map saved: " + saved[0] + "\n"));
  EXPECT_THAT(test::namesIn(saved[0]),
              testing::UnorderedElementsAre("trajectory.tum", "map.png", "map.pgm", "map.yaml", "lines.csv",
                                            "plan.svg", "plan.dxf", "plan.geojson", "session.hslam"));
  EXPECT_EQ(map->wait(), 0) << map->err();
  EXPECT_THAT(map->out(), HasSubstr("400 scans"));
  EXPECT_TRUE(std::filesystem::exists(saved[0] + "/session.hslam")) << "beside the results of the run";
  EXPECT_EQ(result("trajectory.tum"), replay(recording(), "again")) << "saving changes nothing";
}

TEST_F(LivePrograms, LocalisesInTheMapOfAnEarlierRun) {
  const std::string session = sessionOf(test::logOf(test::drive(8, 1)));
  const auto robot = replaying(test::logOf(test::drive(4, 2)), "100");
  const auto map = live({"--localize", session, "--set", "particle_filter.particles=50"});
  EXPECT_EQ(map->wait(), 0) << map->err();
  EXPECT_THAT(test::namesIn(output), testing::IsSupersetOf({"trajectory.tum", "map.png", "covariance.csv"}));
  EXPECT_THAT(test::namesIn(output), testing::Not(testing::Contains("map.pgm")))
      << "the map is not this run's";
  const auto metrics = nlohmann::json::parse(result("metrics.json"));
  EXPECT_GT(metrics["localized_share"], 0.5);
  EXPECT_EQ(metrics["verdict"], "consistent");
  const auto truth = test::drive(4, 2).back().truth,
             last = files::loadTum(output + "/trajectory.tum").back().pose;
  EXPECT_NEAR(last.x, truth.x, 0.1);  // the five particles of the INI file are at times 0.2 m off
  EXPECT_NEAR(last.y, truth.y, 0.1);
}

TEST_F(LivePrograms, MapsOnInTheMapOfAnEarlierRun) {
  const std::string session = sessionOf(test::logOf(test::drive(8, 1)));
  const auto robot = replaying(test::logOf(test::drive(4, 2)), "100");
  const auto map = live({"--continue", session, "--set", "live.max_waiting=100000"});
  EXPECT_EQ(map->wait(), 0) << map->err();
  EXPECT_THAT(map->err(), HasSubstr("place found after"));
  expectAllResults();
  Program again(folder, "again",
                {HYBRID_SLAM, ini, recording(), "--continue", session, "-q", "-o", folder.path("again")});
  EXPECT_EQ(again.wait(), 0) << again.err();
  for (const char* name : {"trajectory.tum", "map.pgm", "lines.csv"})
    EXPECT_EQ(result(name), contentOf(folder.path("again/") + name)) << name;
}

TEST_F(LivePrograms, APlaceThatIsNotFoundIsAnErrorThatLosesNothing) {
  const std::string session = sessionOf(test::logOf(test::drive(8, 1)));
  const auto robot = replaying(3, "100");  // three scans of another room
  const auto map = live({"--continue", session});
  EXPECT_EQ(map->wait(), 1);
  EXPECT_THAT(map->err(), HasSubstr("place not found in the map of " + session));
  expectAllResults();
  EXPECT_EQ(recorded(), 3u);
}

TEST_F(LivePrograms, TheShippedConfigurationsWaitForTheirSensors) {
  const std::vector<std::string> nowhere{"--set", "LASER.ip_address=127.0.0.1",   "--set", "LASER.TCP_port=1",
                                         "--set", "PIONEER.serial_port=/dev/none"};
  auto arguments = nowhere;
  arguments.insert(arguments.end(), {"--set", "server.port=0"});
  const auto robot = server(SOURCE_DIR "/config-ini/observation-server.ini", arguments);
  arguments = nowhere;
  arguments.insert(arguments.begin(),
                   {HYBRID_SLAM_LIVE, SOURCE_DIR "/config-ini/live-p3dx-lms100.ini", "-o", output});
  Program map(folder, "live", arguments);
  for (Program* program : {robot.get(), &map}) {
    EXPECT_TRUE(happens([&] {
      return program->err().find("sensor LASER: fault") != std::string::npos &&
             program->err().find("sensor PIONEER: fault") != std::string::npos;
    })) << program->err();
    program->signal(SIGINT);
  }
  EXPECT_EQ(robot->wait(), 0) << robot->err();
  EXPECT_EQ(map.wait(), 1) << map.err();
}

TEST_F(LivePrograms, WrongCommandLinesAndFiles) {
  const auto serverError = [&](const std::string& content, const std::string& text) {
    Program program(folder, "wrong", {OBSERVATION_SERVER, folder.write("wrong.ini", content)});
    expectError(program, "observation-server", text);
  };
  serverError("[server]\n", "no sensors");
  serverError("[LASER]\ndriver = CLMS100Eth\n", "missing section");
  serverError("[server]\nprot = 1\n", "nearest known key is `port`");
  serverError("[server]\naddress = 127.0.0.300\nport = 0\nrawlog = " SOURCE_DIR
              "/datasets/csie/csie-loop.rawlog\n",
              "cannot listen");
  const auto liveError = [&](const std::vector<std::string>& arguments, const std::string& text) {
    std::vector<std::string> all{HYBRID_SLAM_LIVE};
    all.insert(all.end(), arguments.begin(), arguments.end());
    Program program(folder, "wrong", all);
    expectError(program, "hybrid-slam-live", text);
  };
  liveError({}, "no INI file");
  liveError({ini, "-o", output}, "no sensors");
  liveError({ini, "--server", "robot", "-o", output}, "expected HOST:PORT");
  liveError({ini, "--server", std::string(100000, 'a') + ":1", "-o", output}, "expected HOST:PORT");
  liveError({ini, "--server", "a:1", "--start", "0,0,0"}, "--start without a map");
  liveError({ini, "--server", "a:1", "-o", output, "--localize", folder.write("no.hslam", "none")},
            "no.hslam");
  liveError({ini, "--server", "a:1", "--set", "live.maxwaiting=1"}, "nearest known key is `max_waiting`");
}

TEST_F(LivePrograms, HelpAndVersion) {
  for (const char* path : {OBSERVATION_SERVER, HYBRID_SLAM_LIVE}) {
    Program version(folder, "version", {path, "--version"});
    EXPECT_EQ(version.wait(), 0);
    EXPECT_EQ(version.out(), std::filesystem::path(path).filename().string() + " " HYBRID_SLAM_VERSION "\n");
    Program help(folder, "help", {path, "--help"});
    EXPECT_EQ(help.wait(), 0);
    EXPECT_THAT(help.out(), HasSubstr("Exit: 0 done"));
  }
}

TEST_F(LivePrograms, EveryKeyIsInTheManual) {
  const std::string manual = contentOf(SOURCE_DIR "/doc/live.md");
  for (const char* path : {OBSERVATION_SERVER, HYBRID_SLAM_LIVE}) {
    Program help(folder, "help", {path, "--help-config"});
    EXPECT_EQ(help.wait(), 0);
    std::istringstream lines(help.out());
    for (std::string line; std::getline(lines, line);)
      if (line.rfind('|', 0) == 0) {
        EXPECT_THAT(manual, HasSubstr(line));
      }
  }
}

}  // namespace
}  // namespace hybrid_slam
