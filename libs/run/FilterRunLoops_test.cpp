// The rows and lines of loops that a run closes.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "base/Numbers.h"
#include "files/TemporaryFolder.h"
#include "files/Trajectory.h"
#include "run/FilterRun.h"
#include "testing/RingDrive.h"
#include "testing/TestLogs.h"
#include "testing/TrustedOdometry.h"

namespace hybrid_slam::run {
namespace {

/// The drive as a log: an odometry reading and a scan at the same time, 5 per second from 1000 s on.
test::Log logOf(const std::vector<test::DrivenPose>& drive) {
  test::Log log;
  mrpt::math::TPose2D pose;
  for (const test::DrivenPose& step : drive) {
    pose = pose + step.motion;
    const double time = 1000 + 0.1 * static_cast<double>(log.size());
    const auto scan = test::observed(step.scans[0]).front();
    scan->timestamp = test::stamp(time);
    scan->sensorLabel = "LASER";
    log.push_back(test::odometry(time, pose));
    log.push_back(scan);
  }
  return log;
}

/// A row of steps.csv.
struct Row {
  double time, shift;
  int loops;
};

/// A line on a closed loop.
struct Note {
  bool isRefinement;
  std::string earlier, later, shift;  ///< s, s, m
};

/// Two laps around a ring whose heading drifts.
class FilterRunLoops : public testing::Test {
 protected:
  Configuration configuration(const std::string& output) const {
    Configuration c("", {"run.output=" + folder.path(output)});
    c.filter = test::trustingConfiguration();
    c.filter.grid.resolution = 0.1;
    c.setMethod(RunOptions::Method::general);
    return c;
  }
  void process(FilterRun& run, const Configuration& c) const {
    readings::RawlogSource source(log, c.input, readings::summarise(log, c.input));
    while (const auto reading = source.next()) run.process(*reading);
  }
  /// Lets the refinement close loops, also where the filter, which has a copy of its settings, did not.
  void finish(FilterRun& run, Configuration& c) const {
    c.filter.loopClosing.enabled = true;
    run.finish(log, readings::summarise(log, c.input), nlohmann::ordered_json::object());
  }
  std::string result(const std::string& name) const { return test::contentOf(folder.path(name)); }
  std::vector<Row> rows(const std::string& output) const {
    std::istringstream table(result(output + "/steps.csv"));
    std::vector<Row> all;
    std::string line;
    std::getline(table, line);
    while (std::getline(table, line)) {
      std::vector<std::string> fields(1);
      for (const char c : line)
        if (c == ',')
          fields.emplace_back();
        else
          fields.back() += c;
      EXPECT_EQ(fields.size(), 20u) << line;
      all.push_back({parseNumber(fields.at(0)).value(), parseNumber(fields.at(17)).value(),
                     static_cast<int>(parseNumber(fields.at(16)).value())});
    }
    return all;
  }
  /// The loops that metrics.json counts.
  int counted(const std::string& output) const {
    return nlohmann::json::parse(result(output + "/metrics.json"))["loops_closed"].get<int>();
  }
  static int sum(const std::vector<Row>& table) {
    int loops = 0;
    for (const Row& row : table) loops += row.loops;
    return loops;
  }

  const files::TemporaryFolder folder;
  const std::string log =
      test::writeGzipped(folder.path("log.rawlog"), logOf(test::ringDrive(0.03 * kDegree)));
};

/// Returns what the lines on closed loops say.
std::vector<Note> loopNotes(const std::vector<std::string>& notes) {
  const std::regex form(
      R"(loop closed( in the refinement)? at \((-?[0-9.]+), (-?[0-9.]+)\) m between ([0-9.]+) s and ([0-9.]+) s: )"
      R"(path moved by up to ([0-9.]+) m and [0-9.]+ deg; [0-9]+ matches agree, at least [0-9]+ % of their )"
      R"(walls fit, other places score [0-9]+ % of theirs)");
  std::vector<Note> all;
  for (const std::string& note : notes) {
    if (note.rfind("loop closed", 0) != 0) continue;
    std::smatch part;
    if (std::regex_match(note, part, form))
      all.push_back({part[1].matched, part[4], part[5], part[6]});
    else
      ADD_FAILURE() << note;
  }
  return all;
}

TEST_F(FilterRunLoops, ALoopOfTheFilterHasARowAndALine) {
  Configuration c = configuration("out");
  FilterRun run(c);
  process(run, c);
  finish(run, c);
  const std::vector<Note> notes = loopNotes(run.takeNotes());
  const std::vector<Row> table = rows("out");
  ASSERT_FALSE(notes.empty());
  EXPECT_FALSE(notes[0].isRefinement);
  ASSERT_EQ(sum(table), static_cast<int>(notes.size()));
  EXPECT_EQ(counted("out"), static_cast<int>(notes.size()));
  const auto first = std::find_if(table.begin(), table.end(), [](const Row& row) { return row.loops > 0; });
  EXPECT_GE(first->time, parseNumber(notes[0].later).value());
}

// The map never changes without a row.
TEST_F(FilterRunLoops, ALoopOfTheRefinementHasARowAndALine) {
  Configuration c = configuration("out");
  c.filter.loopClosing.enabled = false;
  FilterRun run(c);
  process(run, c);
  EXPECT_TRUE(loopNotes(run.takeNotes()).empty());
  finish(run, c);
  const std::vector<Note> notes = loopNotes(run.takeNotes());
  const std::vector<Row> table = rows("out");
  ASSERT_FALSE(notes.empty());
  ASSERT_EQ(sum(table), static_cast<int>(notes.size()));
  EXPECT_EQ(counted("out"), static_cast<int>(notes.size()));
  for (const Note& note : notes) {
    SCOPED_TRACE(note.later);
    EXPECT_TRUE(note.isRefinement);
    EXPECT_LT(parseNumber(note.earlier).value(), parseNumber(note.later).value());
    const auto row = std::find_if(table.begin(), table.end(),
                                  [&](const Row& r) { return fixedText(r.time, 1) == note.later; });
    ASSERT_TRUE(row != table.end());
    EXPECT_EQ(row->loops, 1);
    EXPECT_NEAR(row->shift, parseNumber(note.shift).value(), 0.0051);
  }
  for (const Row& row : table) EXPECT_EQ(row.loops > 0, row.shift > 0) << row.time;
}

TEST_F(FilterRunLoops, TheMapBeginsAtTheFirstPoseAlsoIfRefined) {
  Configuration c = configuration("out");
  FilterRun run(c);
  process(run, c);
  finish(run, c);
  const files::Trajectory trajectory = files::loadTum(folder.path("out/trajectory.tum"));
  EXPECT_NEAR(trajectory.at(0).pose.norm(), 0, 1e-9);
  EXPECT_NEAR(trajectory.at(0).pose.phi, 0, 1e-9);
}

// A path whose errors were not distributed over its loops drifts more.
TEST_F(FilterRunLoops, TheCovarianceIsThatOfARelaxedPathOnlyIfItWasRelaxed) {
  const auto varianceOfEarlyPose = [this](int refine, bool closes) {
    Configuration c = configuration("out");
    c.run.overwrite = true;
    c.run.refine = refine;
    c.filter.loopClosing.enabled = closes;
    FilterRun run(c);
    process(run, c);
    run.finish(log, readings::summarise(log, c.input), nlohmann::ordered_json::object());
    std::istringstream table(result("out/covariance.csv"));
    std::string line;
    for (int row = 0; row < 20; ++row) std::getline(table, line);
    line.erase(0, line.find(',') + 1);
    return parseNumber(line.substr(0, line.find(','))).value();
  };
  EXPECT_NEAR(varianceOfEarlyPose(1, true), 3e-4, 1e-4) << "two scan matches, and little drift";
  EXPECT_GT(varianceOfEarlyPose(0, true), 1e-3);
  EXPECT_GT(varianceOfEarlyPose(1, false), 1e-3);
}

// A resumed run refines again, which must not count the same loops twice.
TEST_F(FilterRunLoops, ASessionHoldsTheLoopsOfTheFilterAlone) {
  Configuration c = configuration("out");
  c.filter.loopClosing.enabled = false;
  FilterRun run(c);
  process(run, c);
  finish(run, c);
  ASSERT_GT(counted("out"), 0);

  Configuration again = configuration("again");
  again.filter.loopClosing.enabled = false;
  FilterRun resumed(again);
  SessionReader session(folder.path("out/session.hslam"));
  resumed.resume(session);
  finish(resumed, again);
  EXPECT_EQ(counted("again"), counted("out"));
  EXPECT_EQ(result("again/steps.csv"), result("out/steps.csv"));
  EXPECT_EQ(result("again/trajectory.tum"), result("out/trajectory.tum"));
}

}  // namespace
}  // namespace hybrid_slam::run
