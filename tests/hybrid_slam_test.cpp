/// What a user of the program sees: exit code, messages, files.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "evaluation/Trajectory.h"
#include "io/TemporaryFolder.h"
#include "io/TestLogs.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using test::Log;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;

const std::vector<std::string> kResults{"trajectory.tum", "map.png",          "map.pgm",   "map.yaml",
                                        "map.gridmap.gz", "map.simplemap.gz", "lines.csv", "steps.csv",
                                        "metrics.json",   "config.ini"};
const char* const kMalaga =
    "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";
const char* const kMalagaStockIni =
    "/usr/share/mrpt/config_files/rbpf-slam/gridmapping_RBPF_ICPbased_malaga.ini";
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
const char* const kErrorLine = "hybrid-slam: error: [^\n]*: [^\n]*; [^\n]*\n";

class HybridSlam : public testing::Test {
 protected:
  /// Runs the program; `before` is shell code that runs first.
  int run(const std::string& arguments, const std::string& before = "") {
    const std::string command = before + "'" HYBRID_SLAM "' " + arguments + " >'" + folder.path("stdout") +
                                "' 2>'" + folder.path("stderr") + "'";
    const int status = std::system(command.c_str());
    out = contentOf(folder.path("stdout"));
    err = contentOf(folder.path("stderr"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Replays a log with the made INI into `output`.
  int replay(const std::string& log, const std::string& options = "", const std::string& before = "") {
    return run("'" + ini + "' '" + log + "' -o '" + output + "' " + options, before);
  }
  int replay(const Log& log, const std::string& options = "") {
    return replay(test::writeGzipped(folder.path("log.rawlog"), log), options);
  }
  std::string result(const std::string& name) const { return contentOf(output + "/" + name); }
  std::vector<std::string> results() const {
    std::vector<std::string> names;
    if (fs::is_directory(output))
      for (const auto& entry : fs::directory_iterator(output))
        names.push_back(entry.path().filename().string());
    return names;
  }
  /// Exit 2, one line that says so, and no file.
  void expectError(int exitCode, const std::string& text) {
    EXPECT_EQ(exitCode, 2);
    EXPECT_THAT(err, MatchesRegex(kErrorLine));
    EXPECT_THAT(err, HasSubstr(text));
    EXPECT_THAT(out, IsEmpty());
    EXPECT_THAT(results(), IsEmpty());
  }
  /// Exit 0 with all results and nothing on standard error but `warning`.
  void expectDone(int exitCode, const std::string& warning = "") {
    EXPECT_EQ(exitCode, 0) << err;
    EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
    // A run of more than ten seconds, on a busy machine, says how far it is.
    err = std::regex_replace(err, std::regex("[0-9]+ of [0-9]+ scans [^\n]*\n"), "");
    if (warning.empty())
      EXPECT_THAT(err, IsEmpty());
    else
      EXPECT_THAT(err,
                  AllOf(MatchesRegex("hybrid-slam: warning: [^\n]*: [^\n]*; [^\n]*\n"), HasSubstr(warning)));
  }

  TemporaryFolder folder;
  std::string ini = folder.write("run.ini",
                                 "[run]\nmethod = hybrid\n[particle_filter]\nparticles = 5\nupdate_distance "
                                 "= 0.2\n[grid]\nresolution = 0.1\n");
  std::string output = folder.path("out");
  std::string out, err;
};

std::vector<std::vector<std::string>> csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

// ---- results

TEST_F(HybridSlam, WritesAllResultsAndSumsUp) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(80));
  expectDone(replay(log, "--seed 7 --threads 2"));
  EXPECT_THAT(out,
              MatchesRegex("80 scans, [0-9]+ updates, 10 m in [0-9.]+ s \\([0-9]+ times the log's pace\\): " +
                           output + "/map.png\n"));

  const Trajectory trajectory = loadTum(output + "/trajectory.tum");
  ASSERT_EQ(trajectory.size(), 80u);
  for (size_t i = 0; i < trajectory.size(); ++i) {
    EXPECT_NEAR(trajectory[i].timestamp, 1000 + 0.2 * static_cast<double>(i), 1e-6) << "the scan's own time";
    const auto truth = test::poseOnLap(i, 80) - test::poseOnLap(0, 80);
    EXPECT_LT((trajectory[i].pose - truth).norm(), 0.3) << i;
  }

  const auto metrics = nlohmann::json::parse(result("metrics.json"));
  std::vector<std::string> keys;
  for (const auto& [key, value] : metrics.items()) keys.push_back(key);
  EXPECT_THAT(keys, UnorderedElementsAre("method", "particles", "seed", "threads", "scans", "updates",
                                         "duration_s", "wall_s", "cpu_s", "realtime_factor", "peak_rss_mb",
                                         "resamplings", "slips", "lines", "distance_m", "versions"));
  EXPECT_EQ(metrics["method"], "hybrid");
  EXPECT_EQ(metrics["particles"], 5);
  EXPECT_EQ(metrics["seed"], 7);
  EXPECT_EQ(metrics["threads"], 2);
  EXPECT_EQ(metrics["scans"], 80);
  EXPECT_NEAR(metrics["duration_s"], 79 * 0.2, 1e-6);
  EXPECT_NEAR(metrics["distance_m"], 9.6, 0.1);  // the ellipse's perimeter
  EXPECT_GT(metrics["peak_rss_mb"], 1);
  EXPECT_TRUE(metrics["versions"].contains("hybrid_slam"));
  EXPECT_TRUE(metrics["versions"].contains("mrpt"));

  const auto steps = csv(result("steps.csv"));
  EXPECT_EQ(
      result("steps.csv").substr(0, result("steps.csv").find('\n')),
      "timestamp,particles,ess,resampled,std_x,std_y,std_phi,std_along,std_across,w_grid_best,w_line_best,"
      "lines_seen,lines_matched,step_ms,matched,slipped");
  EXPECT_EQ(steps.size(), metrics["updates"].get<size_t>() + 1);
  size_t resamplings = 0;
  for (size_t i = 1; i < steps.size(); ++i) {
    ASSERT_EQ(steps[i].size(), 16u) << i;
    EXPECT_EQ(steps[i][1], "5");
    resamplings += steps[i][3] == "1" ? 1 : 0;
  }
  EXPECT_EQ(resamplings, metrics["resamplings"].get<size_t>());

  const auto lines = csv(result("lines.csv"));
  EXPECT_EQ(result("lines.csv").substr(0, result("lines.csv").find('\n')),
            "rho,theta,length,x_start,y_start,x_end,y_end,count");
  EXPECT_EQ(lines.size(), metrics["lines"].get<size_t>() + 1);
  for (const auto& line : lines) EXPECT_EQ(line.size(), 8u);

  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(output + "/map.simplemap.gz"));
  EXPECT_EQ(map.size(), metrics["updates"].get<size_t>());
}

TEST_F(HybridSlam, ConfigIniGivesTheSameRunAgain) {
  expectDone(replay(test::laps(40), "-n 6 -s 3 --set grid.resolution=0.2"));
  const std::string trajectory = result("trajectory.tum");
  EXPECT_EQ(run("'" + output + "/config.ini' -o '" + folder.path("again") + "'"), 0) << err;
  EXPECT_EQ(contentOf(folder.path("again/trajectory.tum")), trajectory);
  EXPECT_THAT(contentOf(folder.path("again/config.ini")),
              AllOf(HasSubstr("particles = 6"), HasSubstr("resolution = 0.2")));
}

// Weighing the particles by hand gives the spreads of steps.csv.
TEST_F(HybridSlam, ParticlesOfEveryNthUpdate) {
  ASSERT_EQ(replay(test::laps(40), "-q --set run.particles_every=3"), 0) << err;
  const auto steps = csv(result("steps.csv")), particles = csv(result("particles.csv"));
  ASSERT_EQ(particles[0], (std::vector<std::string>{"timestamp", "x", "y", "phi", "log_weight"}));
  size_t row = 1, updates = 0;
  for (size_t update = 3; update < steps.size(); update += 3, ++updates) {
    double sum = 0, x = 0, xx = 0;
    for (int i = 0; i < 5; ++i, ++row) {
      ASSERT_LT(row, particles.size());
      ASSERT_EQ(particles[row].size(), 5u);
      EXPECT_EQ(particles[row][0], steps[update][0]);
      const double weight = std::exp(std::stod(particles[row][4])), at = std::stod(particles[row][1]);
      sum += weight, x += weight * at, xx += weight * at * at;
    }
    EXPECT_NEAR(std::sqrt(std::max(0.0, xx / sum - std::pow(x / sum, 2))), std::stod(steps[update][4]), 1e-4);
  }
  EXPECT_GE(updates, 3u);
  EXPECT_EQ(row, particles.size());
}

TEST_F(HybridSlam, QuietSaysNothing) {
  expectDone(replay(test::laps(20), "-q"));
  EXPECT_THAT(out, IsEmpty());
}

TEST_F(HybridSlam, ProfilePrintsTheStagesAndChangesNoResult) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(24, 80, 61));
  for (const std::string proposal : {"standard", "improved"}) {
    SCOPED_TRACE(proposal);
    // Of steps.csv all but step_ms, the third column from the end: the time that each step took.
    const auto resultsOf = [&](const std::string& option) {
      expectDone(replay(log, "-q -p " + proposal + option));
      std::map<std::string, std::string> files;
      for (const std::string& name : kResults)
        if (name != "metrics.json" && name != "steps.csv") files[name] = result(name);
      files["steps.csv"] =
          std::regex_replace(result("steps.csv"), std::regex(",[^,\n]*(,[^,\n]*,[^,\n]*\n)"), "$1");
      return files;
    };
    const auto plain = resultsOf("");
    EXPECT_THAT(out, IsEmpty());
    const auto profiled = resultsOf(" --profile");
    for (const auto& [name, content] : plain) EXPECT_TRUE(profiled.at(name) == content) << name;
    for (const char* const stage : {"1 read log", "2 prepare scan, extract lines", "3 sample, weigh",
                                    "4 resample", "5 update maps", "6 write results"})
      EXPECT_THAT(out, HasSubstr(stage));
  }
}

TEST_F(HybridSlam, AllMethodsAndProposals) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(24, 80, 61));
  for (const std::string options :
       {"-m hybrid", "-m general", "-m stock", "-p standard", "-p improved", "-p auxiliary_standard",
        "-p auxiliary_optimal", "-m general -p auxiliary_optimal"}) {
    SCOPED_TRACE(options);
    fs::remove_all(output);
    expectDone(replay(log, options));
    const Trajectory trajectory = loadTum(output + "/trajectory.tum");
    ASSERT_EQ(trajectory.size(), 24u);
    // The odometry is exact; MRPT's weights pull its few particles farther off than ours.
    EXPECT_LT((trajectory.back().pose - (test::poseOnLap(23, 80) - test::poseOnLap(0, 80))).norm(),
              options == "-m stock" ? 1 : 0.3);
    const auto metrics = nlohmann::json::parse(result("metrics.json"));
    EXPECT_GT(metrics["updates"], 3);
    const std::string method = options[1] == 'm' ? options.substr(3, options.find(' ', 3) - 3) : "hybrid";
    EXPECT_EQ(metrics["method"], method);
    EXPECT_EQ(metrics["lines"] == 0, method != "hybrid");
  }
}

TEST_F(HybridSlam, SameSeedSameBytesForAnyNumberOfThreads) {
  if (!fs::exists(kMalaga)) GTEST_SKIP() << kMalaga << " is missing: package mrpt-common";
  ini = SOURCE_DIR "/config-ini/malaga.ini";
  const auto trajectoryOf = [this](const std::string& options) {
    EXPECT_EQ(replay(kMalaga, "-q -n 10 " + options), 0) << err;
    return result("trajectory.tum");
  };
  const std::string first = trajectoryOf("-s 1 -j 1");
  EXPECT_EQ(loadTum(output + "/trajectory.tum").size(), 225u);
  EXPECT_EQ(trajectoryOf("-s 1 -j 1"), first);
  EXPECT_EQ(trajectoryOf("-s 1 -j 2"), first);
  EXPECT_EQ(trajectoryOf("-s 1 -j 4"), first);
  EXPECT_NE(trajectoryOf("-s 2 -j 1"), first);
}

TEST_F(HybridSlam, StockWithMrptsOwnIni) {
  if (!fs::exists(kMalaga) || !fs::exists(kMalagaStockIni)) GTEST_SKIP() << "package mrpt-common is missing";
  ini = kMalagaStockIni;
  expectDone(replay(kMalaga, "-m stock"));
  const auto metrics = nlohmann::json::parse(result("metrics.json"));
  EXPECT_EQ(metrics["method"], "stock");
  EXPECT_EQ(metrics["particles"], 10) << "MRPT's sampleSize";
  EXPECT_EQ(metrics["scans"], 225);
  const std::string trajectory = result("trajectory.tum");
  EXPECT_EQ(run("'" + output + "/config.ini' -q -o '" + folder.path("again") + "'"), 0) << err;
  EXPECT_EQ(contentOf(folder.path("again/trajectory.tum")), trajectory) << "config.ini has MRPT's sections";
}

// ---- command line

TEST_F(HybridSlam, HelpVersionAndManual) {
  EXPECT_EQ(run("--help"), 0);
  for (const char* option : {"--output", "--method", "--proposal", "--particles", "--seed", "--threads",
                             "--set", "--quiet", "--version", "--help-config", "trajectory.tum", "Exit:"})
    EXPECT_THAT(out, HasSubstr(option));
  EXPECT_EQ(run("--version"), 0);
  EXPECT_THAT(out, MatchesRegex("hybrid-slam [0-9]+[.][0-9]+[.][0-9]+\n"));
  EXPECT_EQ(run("--help-config"), 0);
  EXPECT_THAT(out, AllOf(HasSubstr("## [particle_filter]"), HasSubstr("| `particles` |")));
}

TEST_F(HybridSlam, WrongCommandLine) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  expectError(run(""), "no INI file");
  expectError(run("'" + ini + "' -o '" + output + "'"), "no rawlog");
  expectError(replay(log, "--particels 3"), "--particels");
  expectError(replay(log, "one more"), "one");
  expectError(replay(log, "-n"), "--particles");
  expectError(replay(log, "-n 0"),
              "wrong value `0`: command line, section [particle_filter], key `particles`");
  expectError(replay(log, "-n abc"), "abc");
  expectError(replay(log, "-n 1.5"), "1.5");
  expectError(replay(log, "-n 99999999999"), "99999999999");
  expectError(replay(log, "-s -1"), "wrong value `-1`: command line, section [particle_filter], key `seed`");
  expectError(replay(log, "-j -1"), "key `threads`");
  expectError(replay(log, "-m wrong"), "expected one of hybrid | general | stock");
  expectError(replay(log, "-p wrong"), "expected one of standard");
  expectError(replay(log, "--set"), "--set");
  expectError(replay(log, "--set particle_filter.particles"), "SECTION.KEY=VALUE");
  expectError(replay(log, "--set particle_filter.particels=3"), "`particles`");
  expectError(replay(log, "--set nothing.particles=3"), "[nothing]");
}

// ---- INI file

TEST_F(HybridSlam, ShippedInisRun) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(10));
  size_t count = 0;
  for (const auto& entry : fs::directory_iterator(SOURCE_DIR "/config-ini")) {
    ini = entry.path().string();
    if (contentOf(ini).find("hybrid-slam config-ini/") == std::string::npos) continue;  // another program's
    SCOPED_TRACE(ini);
    expectDone(replay(log, "-n 2"));
    ++count;
  }
  EXPECT_GE(count, 2u);
}

TEST_F(HybridSlam, WrongIni) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  const auto replayWith = [&](const std::string& text) {
    ini = folder.write("wrong.ini", text);
    return replay(log);
  };
  expectError(replayWith("[particle_filter]\nparticels = 3\n"), "the nearest known key is `particles`");
  expectError(replayWith("[particle_filter]\nparticles = many\n"), "expected a whole number");
  expectError(replayWith("[particle_filter]\nparticles = 0\n"), "1..100000");
  expectError(replayWith("[particle_filter]\nparticles 3\n"), "wrong line");
  expectError(replayWith("[something]\nx = 3\n"), "missing section");
  expectError(replayWith("[particle_filters]\nx = 3\n[grid]\n"), "[particle_filter]");
  expectError(replayWith(""), "missing section");
  expectError(replayWith(std::string("\0\1\2\3", 4)), "not a text file");
  ini = folder.path("none.ini");
  expectError(replay(log), "no such file: " + ini);
  ini = folder.path("");
  expectError(replay(log), "not a file");
}

TEST_F(HybridSlam, WrongStockIni) {
  ini = folder.write("stock.ini", "[MappingApplication]\nsampleSize = 3\n");
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  EXPECT_EQ(replay(log, "-m stock"), 2);
  EXPECT_THAT(err, AllOf(MatchesRegex(kErrorLine), HasSubstr("[MappingApplication]"),
                         HasSubstr("adaptiveSampleSize")));
  EXPECT_THAT(results(), IsEmpty());
}

// ---- logs

TEST_F(HybridSlam, WrongLog) {
  expectError(replay(folder.path("none.rawlog")), "no such file: " + folder.path("none.rawlog"));
  expectError(replay(folder.path("")), "not a file");
  expectError(replay(folder.write("empty", "")), "empty");
  expectError(replay(folder.write("text", "ODOM 1 2 3\nFLASER 4 5 6\n")), "not a rawlog");
  expectError(replay(HYBRID_SLAM), "not a rawlog");
  expectError(replay(Log{test::odometry(1, {}), test::odometry(2, {})}), "no laser scans");
  expectError(replay(Log{test::scan(1), test::scan(2)}), "require_odometry = false");
  expectError(replay(Log{test::odometry(1, {}), test::scan(1, {}, 0)}), "zero length");
  expectError(replay(test::laps(4), "--set input.sensor_label=REAR"), "the log has `LASER`");
  Log tilted = test::laps(4);
  for (auto& object : tilted)
    if (const auto scan = std::dynamic_pointer_cast<test::CObservation2DRangeScan>(object))
      scan->sensorPose.setYawPitchRoll(0, 0.5, 0);
  expectError(replay(tilted), "tilted");
}

TEST_F(HybridSlam, UnreadableLog) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  fs::permissions(log, fs::perms::none);
  if (access(log.c_str(), R_OK) == 0) GTEST_SKIP() << "run as root, who may read everything";
  expectError(replay(log), "cannot open: " + log);
}

TEST_F(HybridSlam, ScansOnlyOnRequest) {
  expectDone(replay(Log{test::scan(1), test::scan(2), test::scan(3)}, "--set input.require_odometry=false"));
  for (const auto& row : loadTum(output + "/trajectory.tum")) EXPECT_LT(row.pose.norm(), 0.2);
}

TEST_F(HybridSlam, ACutLogGivesResultsUpToTheCut) {
  std::vector<size_t> ends;
  const std::string bytes = contentOf(test::writePlain(folder.path("whole"), test::laps(40), &ends));
  ASSERT_EQ(replay(folder.write("part", bytes.substr(0, ends[41]))), 0) << err;
  const std::string part = result("trajectory.tum");
  fs::remove_all(output);
  const std::string log = folder.write("cut.rawlog", bytes.substr(0, ends[41] + 33));
  EXPECT_EQ(replay(log), 1);
  EXPECT_THAT(err, MatchesRegex(kErrorLine));
  EXPECT_THAT(err, HasSubstr("cut off in the middle of an object: entry 43 of " + log));
  EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
  EXPECT_EQ(result("trajectory.tum"), part);
  EXPECT_EQ(loadTum(output + "/trajectory.tum").size(), 21u);
}

TEST_F(HybridSlam, ACutGzippedLogToo) {
  const std::string bytes = contentOf(test::writeGzipped(folder.path("whole"), test::laps(40)));
  EXPECT_EQ(replay(folder.write("cut.rawlog", bytes.substr(0, bytes.size() / 2))), 1);
  EXPECT_THAT(err, AllOf(MatchesRegex(kErrorLine), HasSubstr("gzip file damaged or cut off: entry ")));
  EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
  EXPECT_GT(loadTum(output + "/trajectory.tum").size(), 5u);
}

/// Laps with some beams of each scan changed.
Log withBeams(const std::function<void(test::CObservation2DRangeScan&, size_t)>& change) {
  Log log = test::laps(30, 80, 91);
  for (auto& object : log)
    if (const auto scan = std::dynamic_pointer_cast<test::CObservation2DRangeScan>(object))
      for (size_t i = 3; i < 91; i += 9) change(*scan, i);
  return log;
}

TEST_F(HybridSlam, ReadingsThatAreNoneAreIgnoredBeamByBeam) {
  const Log marked = withBeams([](auto& scan, size_t i) { scan.setScanRangeValidity(i, false); });
  const float odd[] = {kNaN, HUGE_VALF, -HUGE_VALF, -3, 0, 20, 81.83f, 1e30f};
  const Log unmarked = withBeams([&odd](auto& scan, size_t i) { scan.setScanRange(i, odd[i / 9 % 8]); });
  for (const std::string method : {"hybrid", "general", "stock"}) {
    SCOPED_TRACE(method);
    expectDone(replay(marked, "-m " + method));
    const std::string expected = result("trajectory.tum");
    expectDone(replay(unmarked, "-m " + method));
    EXPECT_EQ(result("trajectory.tum"), expected);
  }
}

TEST_F(HybridSlam, AllReadingsInvalid) {
  Log log = test::laps(10);
  for (auto& object : log)
    if (const auto scan = std::dynamic_pointer_cast<test::CObservation2DRangeScan>(object))
      for (size_t i = 0; i < 181; ++i) scan->setScanRange(i, kNaN);
  expectDone(replay(log));
  EXPECT_EQ(loadTum(output + "/trajectory.tum").size(), 10u);
}

TEST_F(HybridSlam, ScansWithoutBeamsAreLeftOut) {
  Log log = test::laps(10);
  log[3] = test::scan(1000.2, {}, 0);
  expectDone(replay(log), "1 scans without beams (or aperture or sensor pose): first at entry 4; left out");
  EXPECT_EQ(loadTum(output + "/trajectory.tum").size(), 9u);
}

TEST_F(HybridSlam, AnyNumberOfBeams) {
  for (const size_t beams : {1u, 2u, 3u, 5000u}) {
    SCOPED_TRACE(beams);
    expectDone(replay(test::laps(10, 80, beams)));
  }
}

/// 10 scans, the last five with the odometry `jump` m farther on.
Log withJump(double jump) {
  Log log = test::laps(10);
  for (size_t i = 10; i < 20; i += 2)
    std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(log[i])->odometry.x_incr(jump);
  return log;
}

TEST_F(HybridSlam, OdometryThatJumps) {
  expectDone(replay(withJump(99)));
  expectDone(replay(withJump(60), "--set particle_filter.update_distance=100"));
  fs::remove_all(output);
  for (const double jump : {101., 1e5, 1e9, 1e300}) {
    SCOPED_TRACE(jump);
    expectError(replay(withJump(jump)), "odometry jumps: entry 12 of " + folder.path("log.rawlog"));
  }
}

TEST_F(HybridSlam, TimestampsMissingEqualOrBackwards) {
  const auto timesOf = [this] {
    std::vector<double> times;
    for (const auto& row : loadTum(output + "/trajectory.tum")) times.push_back(row.timestamp - 1000);
    return times;
  };
  const auto withTimes = [](const std::vector<double>& times) {
    Log log;
    for (size_t i = 0; i < times.size(); ++i) {
      const double time = 1000 + times[i];
      log.push_back(test::odometry(time, test::poseOnLap(i, 40)));
      log.push_back(test::scan(time, test::poseOnLap(i, 40)));
    }
    return log;
  };
  expectDone(replay(withTimes({0, 1, test::kNoTime, 3})), "1 scans without timestamp: first at entry 6");
  EXPECT_THAT(timesOf(), testing::ElementsAre(0, 1, 1, 3));
  expectDone(replay(withTimes({0, 1, 1, 3})),
             "1 timestamps repeat that of the scan before: first at entry 6");
  EXPECT_THAT(timesOf(), testing::ElementsAre(0, 1, 1, 3));
  expectDone(replay(withTimes({0, 2, 1, 3})), "1 timestamps step back: first at entry 6");
  EXPECT_THAT(timesOf(), testing::ElementsAre(0, 2, 1, 3));
  expectDone(replay(withTimes(std::vector<double>(4, test::kNoTime))),
             "4 scans without timestamp: first at entry 2");
  EXPECT_EQ(loadTum(output + "/trajectory.tum").size(), 4u);
}

// ---- output

TEST_F(HybridSlam, OutputThatCannotBeWritten) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  output = folder.write("file", "in its place");
  expectError(replay(log), output);
  EXPECT_EQ(contentOf(output), "in its place");
  output += "/below";
  expectError(replay(log), output);
}

TEST_F(HybridSlam, OutputFolderNotWritable) {
  fs::create_directory(output);
  fs::permissions(output, fs::perms::owner_read | fs::perms::owner_exec);
  if (access(output.c_str(), W_OK) == 0) GTEST_SKIP() << "run as root, who may write everywhere";
  expectError(replay(test::laps(4)), "output folder not writable: " + output);
}

TEST_F(HybridSlam, AResultThatCannotBeWrittenLeavesNoPart) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  for (const std::string& name : kResults) {
    SCOPED_TRACE(name);
    fs::remove_all(output);
    fs::create_directories(output + "/" + name);
    EXPECT_EQ(replay(log), 2);
    EXPECT_EQ(err,
              "hybrid-slam: error: cannot write: " + output + "/" + name + "; expected the name of a file\n");
    for (const std::string& left : results()) EXPECT_THAT(kResults, testing::Contains(left));
  }
}

/// A limit on the size of files stands in for a full disk: writing fails in the middle of a result.
TEST_F(HybridSlam, DiskFull) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  ASSERT_EQ(replay(log), 0);
  const std::string trajectory = result("trajectory.tum");
  const auto largest = fs::file_size(output + "/map.png");
  std::set<std::string> failures;
  for (std::uintmax_t blocks = 1; blocks * 512 < largest; blocks *= 2) {
    SCOPED_TRACE(blocks);
    fs::remove_all(output);
    EXPECT_EQ(replay(log, "", "trap '' XFSZ; ulimit -f " + std::to_string(blocks) + "; "), 2);
    EXPECT_THAT(err, MatchesRegex(kErrorLine));
    EXPECT_THAT(err, AllOf(StartsWith("hybrid-slam: error: cannot write: " + output + "/"),
                           HasSubstr("room on its disk")));
    failures.insert(err);
    EXPECT_THAT(results(), testing::AnyOf(IsEmpty(), testing::ElementsAre("trajectory.tum")));
    if (!results().empty()) {
      EXPECT_EQ(result("trajectory.tum"), trajectory);
    }
  }
  EXPECT_EQ(failures.size(), 2u) << "first the trajectory, then the picture did not fit";
}

// ---- processes

std::vector<char*> pointersTo(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  return argv;
}

/// Starts the program without a shell between; gives its process.
pid_t start(const std::vector<std::string>& arguments, const std::string& errorFile) {
  const pid_t child = fork();
  if (child == 0) {
    const int file = open(errorFile.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDERR_FILENO);
    execv(HYBRID_SLAM, pointersTo(arguments).data());
    _exit(127);
  }
  return child;
}

int exitCodeOf(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// What the program writes on a terminal, and its exit code.
std::pair<std::string, int> onTerminal(const std::vector<std::string>& arguments) {
  int terminal = 0;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    execv(HYBRID_SLAM, pointersTo(arguments).data());
    _exit(127);
  }
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(terminal, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<size_t>(n));
  close(terminal);
  return {text, exitCodeOf(child)};
}

TEST_F(HybridSlam, ATerminalGetsABarWithTheTimeLeft) {
  Log log = test::laps(100);
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), log);
  const auto [text, code] = onTerminal({"hybrid-slam", "-o", output, ini, path});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text, HasSubstr("\r[##############################] 100 %  0:00 left  spread "));
  EXPECT_THAT(text, HasSubstr("\n100 scans, ")) << "the bar's line is ended";

  std::dynamic_pointer_cast<test::CObservation2DRangeScan>(log.back())->sensorPose.setYawPitchRoll(0, 0.5, 0);
  ini = folder.write("every.ini", "[particle_filter]\nupdate_distance = 0\nparticles = 300\n");
  const auto [error, errorCode] =
      onTerminal({"hybrid-slam", "-o", output, ini, test::writeGzipped(path, log)});
  EXPECT_EQ(errorCode, 2);
  EXPECT_THAT(error, HasSubstr("\nhybrid-slam: error: the laser's scan plane is tilted"))
      << "also by an error";
}

TEST_F(HybridSlam, CtrlCWritesTheResultsSoFar) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4000));
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove_all(output);
    const pid_t child =
        start({"hybrid-slam", "-q", "-n", "300", "-o", output, ini, log}, folder.path("stderr"));
    while (!fs::exists(output + "/.partial.steps.csv") && kill(child, 0) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // so that some scans are through
    kill(child, signal);
    EXPECT_EQ(exitCodeOf(child), 1);
    err = contentOf(folder.path("stderr"));
    EXPECT_THAT(err, MatchesRegex(kErrorLine));
    EXPECT_THAT(err, HasSubstr("interrupted: entry "));
    EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
    EXPECT_LT(loadTum(output + "/trajectory.tum").size(), 4000u);
  }
}

TEST_F(HybridSlam, PeakMemoryIsThatOfTheProgramAlone) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(10));
  {
    const std::vector<char> large(700 << 20, 'x');  // resident in the process that starts it
    ASSERT_EQ(large.back(), 'x');
    EXPECT_EQ(exitCodeOf(start({"hybrid-slam", "-q", "-o", output, ini, log}, folder.path("stderr"))), 0);
  }
  EXPECT_LT(nlohmann::json::parse(result("metrics.json"))["peak_rss_mb"], 700);
}

TEST_F(HybridSlam, MemoryDoesNotGrowWithTheLogOfTheSamePlace) {
  const auto peakOf = [this](size_t steps) {
    EXPECT_EQ(replay(test::laps(steps), "-q -n 20"), 0) << err;
    return nlohmann::json::parse(result("metrics.json"))["peak_rss_mb"].get<double>();
  };
  const double once = peakOf(800), twice = peakOf(1600);
  EXPECT_LT(twice, 1.1 * once) << once << " MB, then " << twice << " MB";
  RecordProperty("peak_rss_mb", std::to_string(once) + ", " + std::to_string(twice));
}

}  // namespace
}  // namespace hybrid_slam
