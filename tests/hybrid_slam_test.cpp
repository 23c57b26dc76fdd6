/// Results of a replay, and the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/maps/CSimpleMap.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "HybridSlamProgram.h"
#include "files/Trajectory.h"
#include "testing/CompressedBytes.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using test::csv;
using test::kResults;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::UnorderedElementsAre;

const char* const kMalaga =
    "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";
const char* const kMalagaStockIni =
    "/usr/share/mrpt/config_files/rbpf-slam/gridmapping_RBPF_ICPbased_malaga.ini";

// ---- results

TEST_F(HybridSlam, WritesAllResultsAndASummary) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(80));
  expectDone(replay(log, "--seed 7 --threads 2"));
  EXPECT_THAT(out,
              MatchesRegex("laser LASER: 181 beams every 1 deg, at x 0.00 m, y 0.00 m, 0 deg on the robot\n"
                           "grid.max_range = 20: [^\n]*\nline_weight.sigma_deg = 0.4: [^\n]*\n"
                           "improved_proposal.update_distance = 0.1: [^\n]*\n"
                           "improved_proposal.update_angle_deg = 5: [^\n]*\n"
                           "80 scans, [0-9]+ updates, 10 m in [0-9.]+ s \\([0-9]+ x real time\\): " +
                           output + "/map.png\nverdict: consistent: no place was seen twice\n"));

  const files::Trajectory trajectory = files::loadTum(output + "/trajectory.tum");
  ASSERT_EQ(trajectory.size(), 80u);
  for (size_t i = 0; i < trajectory.size(); ++i) {
    EXPECT_NEAR(trajectory[i].timestamp, 1000 + 0.2 * static_cast<double>(i), 1e-6) << "the scan's own time";
    const auto truth = test::poseOnLap(i, 80) - test::poseOnLap(0, 80);
    EXPECT_LT((trajectory[i].pose - truth).norm(), 0.1) << i;
  }

  const auto metrics = nlohmann::json::parse(result("metrics.json"));
  std::vector<std::string> keys;
  for (const auto& [key, value] : metrics.items()) keys.push_back(key);
  EXPECT_THAT(keys,
              UnorderedElementsAre("method", "particles", "particles_min", "particles_max", "seed", "threads",
                                   "scans", "updates", "duration_s", "wall_s", "cpu_s", "realtime_factor",
                                   "peak_rss_mb", "resamplings", "slips", "loops_closed", "path_relaxed",
                                   "verdict", "reasons", "doubtful_places", "lines", "distance_m", "complete",
                                   "skipped_readings", "second_run", "versions"));
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
      "lines_seen,lines_matched,step_ms,matched,slipped,loops_closed,loop_shift,degeneracy,frames_deg");
  EXPECT_EQ(steps.size(), metrics["updates"].get<size_t>() + 1);
  size_t resamplings = 0;
  for (size_t i = 1; i < steps.size(); ++i) {
    ASSERT_EQ(steps[i].size(), 20u) << i;
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

TEST_F(HybridSlam, TheVerdictOnAGoodMap) {
  expectDone(replay(test::laps(240), "--strict"));
  EXPECT_THAT(out, testing::EndsWith("verdict: consistent\n"));
  const auto metrics = nlohmann::json::parse(result("metrics.json"));
  EXPECT_EQ(metrics["verdict"], "consistent");
  EXPECT_TRUE(metrics["reasons"].empty());
  EXPECT_TRUE(metrics["doubtful_places"].empty());
}

TEST_F(HybridSlam, TheVerdictOnALostMap) {
  expectDone(replay(test::lapsWithMirroredOdometry(240)));
  EXPECT_THAT(out, HasSubstr("\nverdict: lost: "));
  const auto metrics = nlohmann::json::parse(result("metrics.json"));
  EXPECT_EQ(metrics["verdict"], "lost");
  EXPECT_THAT(std::string(metrics["reasons"][0]), HasSubstr("contradict what was mapped before"));
  const auto& place = metrics["doubtful_places"][0];
  EXPECT_LT(std::hypot(double(place["x"]), double(place["y"])), 10);
  EXPECT_GE(place["timestamp"], 1000);
  EXPECT_GT(place["length_m"], 1);
}

TEST_F(HybridSlam, StrictMakesALostMapAnError) {
  EXPECT_EQ(replay(test::lapsWithMirroredOdometry(240), "--strict"), 1);
  EXPECT_THAT(err, HasSubstr("hybrid-slam: error: verdict: lost: "));
  EXPECT_THAT(results(), testing::UnorderedElementsAreArray(kResults));
}

TEST_F(HybridSlam, ConfigIniGivesTheSameRunAgain) {
  expectDone(replay(test::laps(40), "-n 6 -s 3 --set grid.resolution=0.2"));
  const std::string trajectory = result("trajectory.tum");
  EXPECT_EQ(run("'" + output + "/config.ini' -o '" + folder.path("again") + "'"), 0) << err;
  EXPECT_EQ(test::contentOf(folder.path("again/trajectory.tum")), trajectory);
  EXPECT_THAT(test::contentOf(folder.path("again/config.ini")),
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

TEST_F(HybridSlam, QuietPrintsNothing) {
  for (const std::string method : {"hybrid", "general", "linemap", "ortho", "stock"}) {
    SCOPED_TRACE(method);
    expectDone(replay(test::laps(40), "-q -m " + method));
    EXPECT_THAT(out, IsEmpty());
  }
}

TEST_F(HybridSlam, ProfilePrintsTheStagesAndChangesNoResult) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(24, 80, 61));
  for (const std::string proposal : {"standard", "improved"}) {
    SCOPED_TRACE(proposal);
    // Of steps.csv all but step_ms, the seventh column from the end: the time that each step took. The
    // session holds the times too.
    const auto resultsOf = [&](const std::string& option) {
      expectDone(replay(log, "-q --set particle_filter.ess_threshold=1 -p " + proposal + option));
      std::map<std::string, std::string> files;
      for (const std::string& name : kResults)
        if (name != "metrics.json" && name != "steps.csv" && name != "session.hslam")
          files[name] = result(name);
      files["steps.csv"] =
          std::regex_replace(result("steps.csv"), std::regex(",[^,\n]*((,[^,\n]*){6}\n)"), "$1");
      return files;
    };
    const auto plain = resultsOf("");
    EXPECT_THAT(out, IsEmpty());
    const auto profiled = resultsOf(" --profile");
    for (const auto& [name, content] : plain) EXPECT_TRUE(profiled.at(name) == content) << name;
    for (const char* const stage : {"1 read log", "2 prepare scan, extract lines", "3 sample, weigh",
                                    "4 resample", "5 update maps", "7 write results"})
      EXPECT_THAT(out, HasSubstr(stage));
  }
}

TEST_F(HybridSlam, AllMethodsAndProposals) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(24, 80, 61));
  for (const std::string options :
       {"-m hybrid", "-m general", "-m linemap", "-m ortho", "-m stock", "-p standard", "-p improved",
        "-p auxiliary_standard", "-p auxiliary_optimal", "-m general -p auxiliary_optimal"}) {
    SCOPED_TRACE(options);
    fs::remove_all(output);
    expectDone(replay(log, options));
    const files::Trajectory trajectory = files::loadTum(output + "/trajectory.tum");
    ASSERT_EQ(trajectory.size(), 24u);
    // The odometry is exact; MRPT's weights displace its few particles more than ours.
    EXPECT_LT((trajectory.back().pose - (test::poseOnLap(23, 80) - test::poseOnLap(0, 80))).norm(),
              options == "-m stock" ? 1 : 0.1);
    const auto metrics = nlohmann::json::parse(result("metrics.json"));
    EXPECT_GT(metrics["updates"], 3);
    const std::string method = options[1] == 'm' ? options.substr(3, options.find(' ', 3) - 3) : "hybrid";
    EXPECT_EQ(metrics["method"], method);
    EXPECT_EQ(metrics["lines"] == 0, method == "general" || method == "stock");
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
  EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 225u);
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
  EXPECT_EQ(out + err, "") << "nor does MRPT print anything";
  EXPECT_EQ(test::contentOf(folder.path("again/trajectory.tum")), trajectory)
      << "config.ini has MRPT's sections";
}

// ---- command line

TEST_F(HybridSlam, HelpVersionAndManual) {
  EXPECT_EQ(run("--help"), 0);
  for (const char* option : {"--output", "--method", "--proposal", "--particles", "--seed", "--threads",
                             "--set", "--quiet", "--version", "--help-config", "trajectory.tum", "Exit:"})
    EXPECT_THAT(out, HasSubstr(option));
  std::istringstream help(out);
  for (std::string line; std::getline(help, line);)
    EXPECT_TRUE(line.size() <= 100 || line.rfind("Usage: ", 0) == 0) << line;  // with the program's path
  EXPECT_EQ(run("--version"), 0);
  EXPECT_THAT(out, MatchesRegex("hybrid-slam [0-9]+[.][0-9]+[.][0-9]+\n"));
  EXPECT_EQ(run("--help-config"), 0);
  EXPECT_THAT(out, AllOf(HasSubstr("## [particle_filter]"), HasSubstr("| `particles` |")));
}

TEST_F(HybridSlam, WrongCommandLine) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  expectError(run(""), "no log");
  expectError(run("'" + ini + "' -o '" + output + "'"), "no log");
  expectError(replay(log, "--particels 3"), "--particels");
  for (const char* option : {"--paticles", "--paticles=3", "--Particles"})
    expectError(replay(log, option), "the nearest option is `--particles`, see hybrid-slam --help");
  expectError(replay(log, "one more"), "one");
  expectError(replay(log, "-n"), "--particles");
  expectError(replay(log, "-n -1"),
              "wrong value `-1`: command line, section [particle_filter], key `particles`");
  expectError(replay(log, "-n abc"), "abc");
  expectError(replay(log, "-n 1.5"), "1.5");
  expectError(replay(log, "-n 99999999999"), "99999999999");
  expectError(replay(log, "-s -1"), "wrong value `-1`: command line, section [particle_filter], key `seed`");
  expectError(replay(log, "-j -1"), "key `threads`");
  expectError(replay(log, "-m wrong"), "expected one of hybrid | general | linemap | ortho | stock");
  expectError(replay(log, "-p wrong"), "expected one of standard");
  expectError(replay(log, "--set"), "--set");
  expectError(replay(log, "--set particle_filter.particles"), "SECTION.KEY=VALUE");
  expectError(replay(log, "--set particle_filter.particels=3"), "`particles`");
  expectError(replay(log, "--set nothing.particles=3"), "[nothing]");
}

TEST_F(HybridSlam, TheIniFileIsOptional) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(10));
  expectDone(run("'" + log + "' -n 5 -p standard -o '" + output + "'"));
  const auto metrics = nlohmann::json::parse(result("metrics.json"));
  EXPECT_EQ(metrics["method"], "hybrid");
  EXPECT_THAT(result("config.ini"), HasSubstr("proposal = standard"));
  expectDone(run("--overwrite --set run.rawlog='" + log + "' -n 5 -o '" + output + "'"));
  EXPECT_THAT(result("config.ini"), HasSubstr("proposal = improved"));
  for (const char* name : {"settings.txt", "settings.INI"}) {
    SCOPED_TRACE(name);
    const std::string settings =
        folder.write(name, "# comment\n\n[run]\nrawlog = " + log + "\n[particle_filter]\nparticles = 7\n");
    expectDone(run("--overwrite '" + settings + "' -o '" + output + "'"));
    EXPECT_EQ(nlohmann::json::parse(result("metrics.json"))["particles"], 7);
  }
  fs::remove_all(output);
  expectError(run("'" + folder.path("none.ini") + "' -o '" + output + "'"), "no such file");
  expectError(run("'" + folder.path("none.clf") + "' -o '" + output + "'"), "no such file");
  expectError(run("'" + log + "' '" + log + "' -o '" + output + "'"), "not an INI file");
}

/// A CARMEN log of 10 m along a corridor, with one broken line. The fan of 180 beams is centred at -0.5 deg,
/// and the laser is ahead of the robot's centre; the results must respect both.
std::string carmenLog() {
  std::ostringstream log;
  log << "# made for a test\nPARAM robot_frontlaser_offset 0.1\nFLASER 180 broken\n";
  for (int i = 0; i < 40; ++i) {
    const double x = 0.25 * i - 4.5;
    log << "FLASER 180";
    for (int beam = 0; beam < 180; ++beam)
      log << ' ' << 0.01 * std::round(100 * test::rangeInRoom(x + 0.4, 0.3, mrpt::DEG2RAD(beam - 90)));
    log << ' ' << std::to_string(x + 0.4) << " 0.3 0 " << std::to_string(x) << " 0.3 0 " << 1000 + i
        << " host " << i << '\n';
  }
  return log.str();
}

TEST_F(HybridSlam, ATextLogGivesWhatItsRawlogGives) {
  const std::string log = folder.write("log.clf", carmenLog()), rawlog = folder.path("log.rawlog");
  ASSERT_EQ(test::shell(folder, "'" LOG2RAWLOG "' '" + log + "' '" + rawlog + "'").status, 0);
  const auto trajectoryOf = [&](const std::string& file, const std::string& warning) {
    expectDone(run("--overwrite '" + file + "' -o '" + output + "'"), warning);
    return result("trajectory.tum");
  };
  const std::string expected = trajectoryOf(rawlog, "");
  EXPECT_THAT(out, AllOf(HasSubstr("laser FLASER: 180 beams every 1 deg, at x 0.40 m"),
                         HasSubstr("line_weight.sigma_deg = 0.5")));
  EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 40u);
  EXPECT_EQ(trajectoryOf(log, "1 broken line: first at line 3 of " + log + "; skipped"), expected);
  for (const files::Compression compression : test::kCompressions) {
    SCOPED_TRACE(files::nameOf(compression));
    const std::string packed = folder.write("packed", test::compressed(compression, contentOf(log)));
    EXPECT_EQ(trajectoryOf(packed, "1 broken line"), expected);
  }

  const std::string bytes = test::compressed(files::Compression::gzip, contentOf(log));
  fs::remove_all(output);
  EXPECT_EQ(
      run("'" + folder.write("cut.clf.gz", bytes.substr(0, bytes.size() * 3 / 4)) + "' -o '" + output + "'"),
      1);
  EXPECT_THAT(err, HasSubstr("gzip file cut off: line "));
  EXPECT_THAT(results(), testing::UnorderedElementsAreArray(kResults));
}

/// The logs of GMapping and DP-SLAM, which have no name that tells their format.
TEST_F(HybridSlam, OtherTextLogsGiveWhatTheirRawlogsGive) {
  std::string gfs, dpslam;
  for (size_t i = 0; i < 40; ++i) {
    const mrpt::math::TPose2D pose = test::poseOnLap(i, 80);
    const auto scan = test::scan(0, pose);
    std::ostringstream ranges, at;
    for (size_t k = 0; k < 181; ++k) ranges << ' ' << scan->getScanRange(k);
    at << pose.x << ' ' << pose.y << ' ' << pose.phi;
    gfs += "LASER_READING 181" + ranges.str() + ' ' + at.str() + ' ' +
           std::to_string(100 + 0.2 * static_cast<double>(i)) + '\n';
    dpslam += "Odometry " + at.str() + "\nLaser 181" + ranges.str() + '\n';
  }
  for (const std::string& content : {gfs, dpslam}) {
    const std::string log = folder.write("log", content), rawlog = folder.path("made.rawlog");
    ASSERT_EQ(test::shell(folder, "'" LOG2RAWLOG "' '" + log + "' '" + rawlog + "'").status, 0);
    expectDone(run("--overwrite '" + rawlog + "' -o '" + output + "'"));
    const std::string expected = result("trajectory.tum");
    EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 40u);
    expectDone(run("--overwrite '" + log + "' -o '" + output + "'"));
    EXPECT_EQ(result("trajectory.tum"), expected);
  }
}

// ---- INI file

TEST_F(HybridSlam, ShippedInisRun) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(10));
  // These run in LivePrograms.TheShippedConfigurationsWaitForTheirSensors, SimulFloorplan.TheC* and
  // RbpfSlam.*.
  std::vector<std::string> all = {"live-p3dx-lms100.ini",    "observation-server.ini",  "simul-csie.ini",
                                  "simul-csie-corridor.ini", "simul-csie-doorways.ini", "simul-csie-loop.ini",
                                  "simul-moved.ini",         "rbpf-slam-lines.ini"};
  for (const char* name : {"csie-lms100.ini", "lms-logs.ini", "malaga.ini", "paper.ini"}) {
    SCOPED_TRACE(name);
    ini = std::string(SOURCE_DIR "/config-ini/") + name;
    expectDone(replay(log, "-n 2"));
    all.emplace_back(name);
  }
  EXPECT_THAT(test::namesIn(SOURCE_DIR "/config-ini"), testing::UnorderedElementsAreArray(all))
      << "each has a test that runs it";
}

}  // namespace
}  // namespace hybrid_slam
