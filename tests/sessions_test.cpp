/// hybrid-slam with sessions: saved, resumed, continued, localised in; killed at any moment; damaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "ChildProgram.h"
#include "HybridSlamProgram.h"
#include "base/RandomStream.h"
#include "files/Gzip.h"
#include "files/Trajectory.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

class Sessions : public HybridSlam {
 protected:
  std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(120));
  std::string session = output + "/session.hslam";

  /// All results of a run except times and memory.
  std::map<std::string, std::string> resultsIn(const std::string& where) const {
    std::map<std::string, std::string> all;
    for (const char* name : {"trajectory.tum", "covariance.csv", "map.pgm", "map.gridmap.gz", "lines.csv"})
      all[name] = contentOf(where + "/" + name);
    const std::regex stepTime(",[^,\n]*((,[^,\n]*){6}\n)");
    all["steps.csv"] = std::regex_replace(contentOf(where + "/steps.csv"), stepTime, "$1");
    return all;
  }
  void expectSame(const std::map<std::string, std::string>& expected, const std::string& where) const {
    const auto found = resultsIn(where);
    for (const auto& [name, text] : expected) EXPECT_TRUE(found.at(name) == text) << name << " of " << where;
  }
  std::string write(const std::string& name, const std::string& bytes) const {
    return folder.write(name, bytes);
  }
};

TEST_F(Sessions, AKilledRunIsResumedToTheSameBytes) {
  ASSERT_EQ(replay(log), 0) << err;
  const auto expected = resultsIn(output);
  RandomStream random(1, 0, 0);
  double latest = 0.1;  // s after the first checkpoint
  for (int k = 0, killed = 0; killed < 4; ++k) {
    ASSERT_LT(k, 50) << "only " << killed << " runs were killed; the others ended before";
    const std::string part = folder.path("killed-" + std::to_string(k)), saved = part + "/session.hslam";
    {
      test::ChildProgram program(folder, "killed",
                                 {HYBRID_SLAM, ini, log, "-o", part, "--checkpoint-every", "0.001"});
      ASSERT_TRUE(test::happens([&] { return fs::exists(saved) || program.hasEnded(); }));
      std::this_thread::sleep_for(std::chrono::duration<double>(latest * random.uniform()));
    }
    if (fs::exists(part + "/metrics.json")) {  // the run was faster: kill the next one earlier
      latest /= 2;
      continue;
    }
    ++killed;
    ASSERT_TRUE(fs::exists(saved));
    EXPECT_FALSE(fs::exists(part + "/trajectory.tum"));
    EXPECT_EQ(run("--resume '" + saved + "'"), 0) << err;
    expectSame(expected, part);
    EXPECT_THAT(test::namesIn(part), testing::UnorderedElementsAreArray(test::kResults));
  }
}

TEST_F(Sessions, AnInterruptedRunIsResumedElsewhere) {
  ASSERT_EQ(replay(log), 0) << err;
  const auto expected = resultsIn(output);
  const std::string cut = folder.path("interrupted"), whole = folder.path("whole");
  test::ChildProgram program(folder, "interrupted",
                             {HYBRID_SLAM, ini, log, "-o", cut, "--checkpoint-every", "0.001"});
  ASSERT_TRUE(test::happens([&] { return fs::exists(cut + "/session.hslam"); }));
  program.signal(SIGINT);
  ASSERT_TRUE(test::happens([&] { return program.hasEnded(); }));
  EXPECT_EQ(run("--resume '" + cut + "/session.hslam' -o '" + whole + "' -j 2"), 0) << err;
  expectSame(expected, whole);
}

TEST_F(Sessions, ResumingAFinishedRunWritesItsResults) {
  ASSERT_EQ(replay(log), 0) << err;
  const auto expected = resultsIn(output);
  const std::string again = folder.path("again");
  EXPECT_EQ(run("--resume '" + session + "' -o '" + again + "'"), 0) << err;
  expectSame(expected, again);
}

/// The log ends between the scans of two lasers, and then grows.
TEST_F(Sessions, ARunIsResumedWhereTheLogEndedWithinAReading) {
  test::Log two;
  for (const auto& object : test::laps(30)) {
    two.push_back(object);
    const auto front = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(object);
    if (!front) continue;
    const auto rear = mrpt::obs::CObservation2DRangeScan::Create(*front);
    rear->sensorLabel = "REAR";
    two.push_back(rear);
  }
  test::writeGzipped(log, test::Log(two.begin(), two.begin() + 60));  // without the front scan
  ASSERT_EQ(replay(log), 0) << err;
  test::writeGzipped(log, two);
  const std::string first = folder.path("first"), second = folder.path("second");
  ASSERT_EQ(run("--resume '" + session + "' -o '" + first + "'"), 0) << err;
  EXPECT_EQ(files::loadTum(first + "/trajectory.tum").size(), 31u) << "the first is of the front laser alone";
  EXPECT_EQ(run("--resume '" + first + "/session.hslam' -o '" + second + "'"), 0) << err;
}

TEST_F(Sessions, AnotherConfigurationLogOrMethodIsNamed) {
  ASSERT_EQ(replay(log), 0) << err;
  const std::string resume = "--resume '" + session + "' -o '" + folder.path("other") + "' ";
  const auto expectRefused = [&](const std::string& options, const std::string& text) {
    EXPECT_EQ(run(resume + options), 2) << options;
    EXPECT_THAT(err, AllOf(testing::MatchesRegex(kErrorLine), HasSubstr(text)));
    EXPECT_FALSE(fs::exists(folder.path("other")));
  };
  expectRefused("--set grid.resolution=0.2",
                "section [grid], key `resolution` = 0.2; expected 0.1 as in " + session);
  expectRefused("-n 6", "key `particles` = 6; expected 5");
  expectRefused("-m general", "key `method` = general; expected hybrid");
  const std::string other = test::writeGzipped(folder.path("other.rawlog"), test::laps(120, 70));
  expectRefused("'" + other + "'", "another log than the session's: " + other);
  const std::string shorter = test::writeGzipped(folder.path("shorter.rawlog"), test::laps(100));
  expectRefused("'" + shorter + "'", "another log than the session's: " + shorter);
  expectRefused("--continue '" + session + "'", "--resume and --continue exclude each other");
  const std::string longer = test::writeGzipped(folder.path("longer.rawlog"), test::laps(140));
  EXPECT_EQ(run(resume + "'" + longer + "'"), 0) << "a log that has grown: " << err;
}

TEST_F(Sessions, AFileThatIsNoSessionIsAnErrorLine) {
  ASSERT_EQ(replay(log), 0) << err;
  const std::string bytes = contentOf(session), plain = files::readGzip(session, "", 1 << 28);
  // --continue also takes other maps, and reads that of a session in the same way; --localize is the same.
  const auto expectRefused = [&](const std::string& file, const std::string& text,
                                 const std::string& ofMap = "") {
    for (const std::string option : {"--resume", "--continue"}) {
      EXPECT_EQ(run("'" + log + "' -o '" + folder.path("other") + "' " + option + " '" + file + "'"), 2)
          << option << " " << text;
      EXPECT_THAT(err, testing::MatchesRegex(kErrorLine));
      EXPECT_THAT(err, HasSubstr(option == "--resume" || ofMap.empty() ? text : ofMap));
      EXPECT_FALSE(fs::exists(folder.path("other")));
    }
  };
  expectRefused(folder.path("missing"), "no such file");
  expectRefused(folder.path("."), "a folder, not a file");
  ASSERT_EQ(::mkfifo(folder.path("pipe").c_str(), 0666), 0);
  expectRefused(folder.path("pipe"), "not a file");  // opening it would wait
  expectRefused(write("empty", ""), "not a session file", "grid map cut off");
  expectRefused(log, "not a session file", "not a readable grid map");
  expectRefused(write("text", "no session"), "not a session file", "not a map");
  expectRefused(write("zeros", files::gzipped(std::string(1000, '\0'))), "not a session file",
                "not a readable grid map");
  for (const size_t length : {bytes.size() / 100, bytes.size() / 2, bytes.size() - 4})
    expectRefused(write("cut", bytes.substr(0, length)), "cut");
  std::string damaged = bytes;
  damaged[bytes.size() / 2] = static_cast<char>(~damaged[bytes.size() / 2]);
  expectRefused(write("damaged", damaged), "damaged");
  expectRefused(write("longer", bytes + 'x'), "damaged");
  expectRefused(write("twice", bytes + bytes), "damaged");
  std::string newer = plain;
  newer[8] = 2;
  expectRefused(write("newer", files::gzipped(newer)), "session of format 2");
  std::string huge = plain;
  huge.replace(12, 8, "\xff\xff\xff\xff\xff\xff\xff\x7f");  // the length of the first text
  expectRefused(write("huge", files::gzipped(huge)), "damaged session, it is cut");
  // The state of the run, which only --resume reads, stands behind the map.
  EXPECT_EQ(run("--resume '" + write("short", files::gzipped(plain.substr(0, plain.size() - 1))) + "'"), 2);
  EXPECT_THAT(err, HasSubstr("damaged session, it is cut"));
  EXPECT_EQ(run("--resume '" + write("long", files::gzipped(plain + "x")) + "'"), 2);
  EXPECT_THAT(err, HasSubstr("damaged session, it has more bytes"));
}

TEST_F(Sessions, AnotherVersionIsNamed) {
  ASSERT_EQ(replay(log), 0) << err;
  std::string plain = files::readGzip(session, "", 1 << 28);
  const size_t at = plain.find(HYBRID_SLAM_VERSION);
  ASSERT_EQ(at, 20u);
  plain[at] = '9';
  EXPECT_EQ(run("--resume '" + write("version", files::gzipped(plain)) + "'"), 2);
  EXPECT_THAT(err, AllOf(testing::MatchesRegex(kErrorLine), HasSubstr("session of version 9"),
                         HasSubstr("--continue")));
}

TEST_F(Sessions, ACheckpointIsNotOverwrittenByAnotherRun) {
  fs::create_directory(output);
  folder.write("out/session.hslam", "of a run that was killed");
  EXPECT_EQ(run("'" + ini + "' '" + log + "' -o '" + output + "' --checkpoint-every 0.001"), 0) << err;
  EXPECT_EQ(contentOf(session), "of a run that was killed");
  EXPECT_EQ(test::namesIn(output).size(), 2u) << "a dated subfolder";
}

TEST_F(Sessions, ACheckpointIsNotOverwrittenByARunThatIsResumed) {
  ASSERT_EQ(replay(log), 0) << err;
  const auto expected = resultsIn(output);
  const std::string other = folder.path("other");
  fs::create_directory(other);
  folder.write("other/session.hslam", "of a run that was killed");
  EXPECT_EQ(run("--resume '" + session + "' -o '" + other + "' --checkpoint-every 0.001"), 0) << err;
  EXPECT_EQ(contentOf(other + "/session.hslam"), "of a run that was killed");
  ASSERT_EQ(test::namesIn(other).size(), 2u) << "a dated subfolder";
  for (const std::string& name : test::namesIn(other))
    if (name != "session.hslam") expectSame(expected, other + "/" + name);
}

TEST_F(Sessions, ARunThatIsKilledBeforeItReplacesResultsLeavesThemAndItsCheckpoint) {
  const std::string options = " -n 100 -s 2";
  ASSERT_EQ(replay(log, options), 0) << err;
  const auto expected = resultsIn(output);
  ASSERT_EQ(replay(log), 0) << err;
  const auto before = resultsIn(output);
  const std::string sessionBefore = contentOf(session), checkpoint = output + "/checkpoint.hslam";
  {
    test::ChildProgram program(folder, "killed",
                               {HYBRID_SLAM, ini, log, "-o", output, "--overwrite", "-n", "100", "-s", "2",
                                "--checkpoint-every", "0.001"});
    ASSERT_TRUE(test::happens([&] { return fs::exists(checkpoint) || program.hasEnded(); }));
    ASSERT_FALSE(program.hasEnded()) << "no checkpoint of its own";
  }
  expectSame(before, output);
  EXPECT_EQ(contentOf(session), sessionBefore);
  ASSERT_EQ(run("--resume '" + checkpoint + "' --overwrite"), 0) << err;
  expectSame(expected, output);
  EXPECT_THAT(test::namesIn(output), testing::UnorderedElementsAreArray(test::kResults));
}

TEST_F(Sessions, MapsOnFromAKnownOrASearchedStart) {
  ASSERT_EQ(replay(log), 0) << err;
  const auto before = files::loadTum(output + "/trajectory.tum");
  test::Log second = test::laps(200);
  second.erase(second.begin(), second.begin() + 2 * 110);  // from where the first nearly ends
  const std::string log2 = test::writeGzipped(folder.path("second.rawlog"), second);
  const auto end = before[110].pose;
  const std::string start = " --start=" + std::to_string(end.x) + "," + std::to_string(end.y) + "," +
                            std::to_string(end.phi * 180 / M_PI);
  const std::string known = folder.path("known");
  ASSERT_EQ(run("'" + ini + "' '" + log2 + "' -o '" + known + "' --continue '" + session + "'" + start), 0)
      << err;
  const auto after = files::loadTum(known + "/trajectory.tum");
  ASSERT_EQ(after.size(), 90u);
  for (size_t i = 0; i < 10; ++i) {  // the scans that both have
    EXPECT_NEAR(after[i].pose.x, before[110 + i].pose.x, 0.1) << i << ": a cell";
    EXPECT_NEAR(after[i].pose.y, before[110 + i].pose.y, 0.1) << i;
  }
  EXPECT_TRUE(fs::exists(known + "/session.hslam"));
  // The room is symmetric: without a start, the place stays unknown.
  const std::string searched = folder.path("searched");
  EXPECT_EQ(run("'" + ini + "' '" + log2 + "' -o '" + searched + "' --continue '" + session + "'"), 1);
  EXPECT_THAT(
      err, AllOf(testing::MatchesRegex("(.|\n)*hybrid-slam: error: [^\n]*\n"), HasSubstr("place not found")));
  EXPECT_THAT(err, HasSubstr("mapped in their own frame"));
  EXPECT_EQ(files::loadTum(searched + "/trajectory.tum").size(), 90u) << "nothing is lost";
  // So it does in a log that is cut off.
  const std::string cut = test::writePlain(folder.path("cut.rawlog"), second);
  fs::resize_file(cut, fs::file_size(cut) - 100);
  EXPECT_EQ(run("'" + ini + "' '" + cut + "' --overwrite -o '" + searched + "' --continue '" + session + "'"),
            1);
  EXPECT_THAT(err, AllOf(HasSubstr("results cover the log up to this point"), HasSubstr("place not found")));
}

TEST_F(Sessions, AWrongPlaceInTheEarlierMapIsReported) {
  ASSERT_EQ(replay(log), 0) << err;
  const std::string other = folder.path("other");
  for (const auto& [start, verdict] : {std::pair("0,0,0", "consistent"), std::pair("1,2,45", "lost")}) {
    ASSERT_EQ(run("'" + ini + "' '" + log + "' --overwrite -o '" + other + "' --continue '" + session +
                  "' --start " + start),
              0)
        << err;
    EXPECT_THAT(out, HasSubstr(std::string("verdict: ") + verdict));
    EXPECT_EQ(testing::Value(out, HasSubstr("contradict the map that the run continues")),
              verdict == std::string("lost"));
  }
}

TEST_F(Sessions, ARunThatMapsOnIsResumedToTheSameBytes) {
  ASSERT_EQ(replay(log), 0) << err;
  const std::string whole = folder.path("whole"), again = folder.path("again");
  const std::string there = " --continue '" + session + "' --start 0,0,0 --checkpoint-every 0.001";
  ASSERT_EQ(run("'" + ini + "' '" + log + "' -o '" + whole + "'" + there), 0) << err;
  const auto expected = resultsIn(whole);
  EXPECT_EQ(run("--resume '" + whole + "/session.hslam' -o '" + again + "'"), 0) << err;
  expectSame(expected, again);
  const std::string killed = folder.path("killed");
  {
    test::ChildProgram program(folder, "killed",
                               {HYBRID_SLAM, ini, log, "-o", killed, "--continue", session, "--start",
                                "0,0,0", "--checkpoint-every", "0.001"});
    ASSERT_TRUE(test::happens([&] { return fs::exists(killed + "/session.hslam"); }));
  }
  if (fs::exists(killed + "/metrics.json")) GTEST_SKIP() << "it was too fast to be killed";
  EXPECT_EQ(run("--resume '" + killed + "/session.hslam'"), 0) << err;
  expectSame(expected, killed);
}

TEST_F(Sessions, LocalisesWithoutAMapOfItsOwn) {
  ASSERT_EQ(replay(log), 0) << err;
  for (const std::string& map : {session, output + "/map.yaml", output + "/map.gridmap.gz"}) {
    SCOPED_TRACE(map);
    const std::string there = folder.path("there");
    fs::remove_all(there);
    ASSERT_EQ(run("'" + ini + "' '" + log + "' -o '" + there + "' --localize '" + map + "' --start 0,0,0"), 0)
        << err;
    EXPECT_THAT(test::namesIn(there),
                testing::UnorderedElementsAre("trajectory.tum", "covariance.csv", "map.png", "steps.csv",
                                              "config.ini", "metrics.json"));
    const auto expected = files::loadTum(output + "/trajectory.tum"),
               found = files::loadTum(there + "/trajectory.tum");
    ASSERT_EQ(found.size(), expected.size());
    double worst = 0;
    for (size_t i = 0; i < found.size(); ++i) {
      const auto off = found[i].pose - expected[i].pose;
      worst = std::max(worst, off.norm());
    }
    EXPECT_LT(worst, 0.25);
    const auto metrics = nlohmann::json::parse(contentOf(there + "/metrics.json"));
    EXPECT_EQ(metrics.at("verdict"), "consistent");
    EXPECT_EQ(metrics.at("localized_share"), 1);
  }
}

TEST_F(Sessions, AFolderOfResultsNamesItsSession) {
  ASSERT_EQ(replay(log), 0) << err;
  const std::string other = folder.path("other");
  EXPECT_EQ(run("'" + log + "' -o '" + other + "' --localize '" + output + "'"), 0) << err;
  EXPECT_EQ(run("--overwrite -o '" + other + "' --continue '" + output + "/' --start 0,0,0 '" + log + "'"), 0)
      << err;
  EXPECT_EQ(run("--resume '" + output + "' --overwrite -o '" + other + "'"), 0) << err;
}

TEST_F(Sessions, ARunInsideAFolderOfResultsIsANewOne) {
  ASSERT_EQ(replay(log), 0) << err;
  const std::string other = folder.path("other"), expected = contentOf(output + "/trajectory.tum");
  EXPECT_EQ(run("'" + ini + "' '" + log + "' -o '" + other + "'", "cd '" + output + "'; "), 0) << err;
  EXPECT_EQ(contentOf(other + "/trajectory.tum"), expected);
}

TEST_F(Sessions, ASessionGivenAsTheLogIsNamed) {
  ASSERT_EQ(replay(log), 0) << err;
  for (const char* option : {"", "--list "}) {
    EXPECT_EQ(run(option + ("'" + session + "' -o '" + folder.path("other") + "'")), 2);
    EXPECT_THAT(err, AllOf(testing::MatchesRegex(kErrorLine), HasSubstr("a session, not a log: " + session)));
  }
  EXPECT_FALSE(fs::exists(folder.path("other")));
}

TEST_F(Sessions, OptionsThatExcludeEachOther) {
  const auto expectRefused = [&](const std::string& options, const std::string& text) {
    EXPECT_EQ(run("'" + log + "' -o '" + output + "' " + options), 2) << options;
    EXPECT_THAT(err, AllOf(testing::MatchesRegex(kErrorLine), HasSubstr(text)));
    EXPECT_FALSE(fs::exists(output));
  };
  expectRefused("--start 1,2,3", "--start without a map");
  expectRefused("--start 1,2 --continue x", "wrong pose `1,2`: command line, option --start");
  expectRefused("--start 1,2,east --continue x", "wrong pose `1,2,east`");
  expectRefused("--start 1e9,2,3 --continue x", "too far away");
  expectRefused("--checkpoint-every 0", "--checkpoint-every");
  expectRefused("--checkpoint-every nan", "is not a number in 0.001..1e+09");
  expectRefused("--checkpoint-every 1 --localize x", "--checkpoint-every with --localize");
  expectRefused("--refine 2 --localize x", "--refine with --localize");
  expectRefused("--refine 2 -m linemap", "--refine with method linemap");
  ASSERT_EQ(replay(log), 0) << err;
  const std::string other = folder.path("other");
  EXPECT_EQ(run("'" + log + "' -o '" + other + "' -m stock --continue '" + session + "'"), 2);
  EXPECT_THAT(err, HasSubstr("method stock does not take a map"));
  EXPECT_EQ(run("'" + log + "' -o '" + other + "' -m ortho --checkpoint-every 10"), 2);
  EXPECT_THAT(err, HasSubstr("method ortho saves no sessions: option --checkpoint-every"));
  EXPECT_EQ(run("'" + log + "' -o '" + other + "' --set grid.resolution=0.05 --continue '" + session + "'"),
            2);
  EXPECT_THAT(err, HasSubstr("expected 0.1 m as in " + session));
  EXPECT_EQ(run("'" + log + "' -o '" + other + "' -m linemap --continue '" + session + "'"), 2);
  EXPECT_THAT(err, HasSubstr("method linemap does not take a map"));
  EXPECT_EQ(run("'" + log + "' -o '" + other + "' -m ortho --resume '" + session + "'"), 2);
  EXPECT_THAT(err, HasSubstr("expected hybrid as in " + session));
  EXPECT_FALSE(fs::exists(other));
}

}  // namespace
}  // namespace hybrid_slam
