/// A replay with player controls, without a window.
#include "window/view/ReplaySession.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <chrono>
#include <fstream>

#include "run/Replay.h"
#include "testing/ReplaySessionTest.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::window {
namespace {

using Method = run::RunOptions::Method;
using State = ReplaySnapshot::State;
using ReplaySessionTest = test::ReplaySessionTest;
using test::happens;
using testing::HasSubstr;

TEST_F(ReplaySessionTest, WaitsBeforeTheFirstScanAndStepsOneByOne) {
  ReplaySession session(laps(), {Method::hybrid, Method::general});
  ASSERT_TRUE(reaches(session, State::paused, 0));
  EXPECT_EQ(session.snapshot()->total, kScans);
  EXPECT_EQ(session.snapshot()->filters.at(0), nullptr);
  session.step();
  ASSERT_TRUE(reaches(session, State::paused, 1));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->filters.at(1) != nullptr; }));
  session.step();
  session.step();
  ASSERT_TRUE(reaches(session, State::paused, 3));
}

TEST_F(ReplaySessionTest, ShowsBothFiltersOnTheSameLog) {
  ReplaySession session(laps(), {Method::hybrid, Method::general});
  session.seek(kScans);
  ASSERT_TRUE(reaches(session, State::ended, kScans));
  const auto all = session.snapshot();
  const FilterSnapshot &hybrid = *all->filters.at(0), &general = *all->filters.at(1);
  EXPECT_EQ(hybrid.method, "hybrid");
  EXPECT_EQ(general.method, "general");
  EXPECT_EQ(hybrid.updates, general.updates);
  EXPECT_EQ(hybrid.plot.size(), hybrid.updates);
  EXPECT_EQ(hybrid.path.size(), hybrid.updates);
  EXPECT_EQ(hybrid.particles.size(), 5u);
  EXPECT_FALSE(hybrid.lines.empty());
  EXPECT_TRUE(general.lines.empty());
  ASSERT_TRUE(hybrid.dominatingDirection);
  // The scan sees only the room's walls, which are already in the database. The first pose is the map's
  // origin.
  const double turned = std::remainder(*hybrid.dominatingDirection + test::poseOnLap(0, 80).phi, M_PI / 2);
  EXPECT_NEAR(turned, 0, 0.05);
  EXPECT_FALSE(hybrid.scanLines.empty());
  // The lines drawn as matched are those that w_line counted, as in steps.csv.
  int matched = 0;
  for (const ScanLine& line : hybrid.scanLines) matched += line.isMatched;
  EXPECT_EQ(matched, hybrid.step.linesMatched);
  EXPECT_GT(matched, 0);
  // The map is the room: 10 m by 6 m, turned, and a margin.
  EXPECT_GT(hybrid.map.right() - hybrid.map.left, 6);
  EXPECT_LT(hybrid.map.right() - hybrid.map.left, 14);
  EXPECT_EQ(hybrid.map.grey.size(), static_cast<size_t>(hybrid.map.width * hybrid.map.height));
}

TEST_F(ReplaySessionTest, GivesTheResultsOfHybridSlam) {
  const run::Configuration c = laps();
  run::Configuration offline = c;
  offline.run.output = folder.path("offline");
  const std::atomic<bool> stop{false};
  run::replay(offline, true, stop);

  ReplaySession session(c, {Method::hybrid, Method::general});
  session.seek(20);
  ASSERT_TRUE(reaches(session, State::paused, 20));
  session.seek(5);  // by restarting
  ASSERT_TRUE(reaches(session, State::paused, 5));
  EXPECT_EQ(session.snapshot()->run, 2u);
  session.setSpeed(0);
  session.play();
  ASSERT_TRUE(reaches(session, State::ended, kScans));
  session.exportResults(folder.path("out"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages > 0; }));
  EXPECT_THAT(session.snapshot()->message, HasSubstr("60 scans"));
  EXPECT_FALSE(session.snapshot()->isError);
  for (const char* name : {"trajectory.tum", "map.pgm", "lines.csv", "map.simplemap.gz"})
    EXPECT_EQ(test::contentOf(folder.path(std::string("out/hybrid/") + name)),
              test::contentOf(folder.path(std::string("offline/") + name)))
        << name;
  EXPECT_THAT(test::contentOf(folder.path("out/general/metrics.json")), HasSubstr("\"general\""));

  const std::string first = test::contentOf(folder.path("out/hybrid/metrics.json"));
  session.exportResults(folder.path("out"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages > 1; }));
  EXPECT_THAT(session.snapshot()->message, HasSubstr(folder.path("out/20")));
  EXPECT_EQ(test::contentOf(folder.path("out/hybrid/metrics.json")), first);
}

/// As when the window is closed during an export.
TEST_F(ReplaySessionTest, OutlivesTheFurtherSectionsOfItsConfiguration) {
  struct LiveOptions : Options {
    int retries = 3;
    void describe(OptionTable& t) override { t.add("retries", retries, 0, 9, "further section"); }
  };
  std::unique_ptr<ReplaySession> session;
  {
    LiveOptions live;
    const std::string log = test::writeGzipped(folder.path("laps.rawlog"), test::laps(kScans));
    session = std::make_unique<ReplaySession>(
        run::Configuration("", {"run.rawlog=" + log, "particle_filter.particles=2"}, {{"live", &live}}),
        std::vector<Method>{Method::hybrid});
  }
  session->seek(20);
  ASSERT_TRUE(reaches(*session, State::paused, 20));
  session->exportResults(folder.path("out"));
  ASSERT_TRUE(test::happens([&] { return session->snapshot()->messages > 0; }));
  EXPECT_FALSE(session->snapshot()->isError);
  EXPECT_THAT(test::contentOf(folder.path("out/hybrid/config.ini")), testing::Not(HasSubstr("[live]")));
}

TEST_F(ReplaySessionTest, ShowsMethodsWithoutGridsByTheirScans) {
  ReplaySession session(laps(), {Method::linemap, Method::ortho});
  session.seek(20);
  ASSERT_TRUE(reaches(session, State::paused, 20));
  for (const auto& filter : session.snapshot()->filters) {
    EXPECT_EQ(filter->path.size(), filter->updates);
    EXPECT_FALSE(filter->lines.empty()) << filter->method;
    EXPECT_GT(filter->map.width, 20) << filter->method;
  }
  session.saveMap(folder.path("saved"));
  ASSERT_TRUE(test::happens([&] { return !session.snapshot()->note.empty(); }));
  EXPECT_FALSE(test::contentOf(folder.path("saved/ortho/plan.svg")).empty());
  EXPECT_FALSE(test::contentOf(folder.path("saved/linemap/session.hslam")).empty());
}

TEST_F(ReplaySessionTest, TheConfiguredMethodIsBesideHybrid) {
  run::Configuration c = laps();
  const auto expect = [&c](Method configured, Method second) {
    c.setMethod(configured);
    EXPECT_EQ(comparedMethods(c), (std::vector<Method>{Method::hybrid, second}));
  };
  expect(Method::hybrid, Method::general);
  expect(Method::general, Method::general);
  expect(Method::ortho, Method::ortho);
  expect(Method::linemap, Method::linemap);
}

TEST_F(ReplaySessionTest, TheMapsAreThoseOfTheScanThatIsShown) {
  run::Configuration c = laps();
  c.filter.filter.updateDistance = 0.001;  // every scan is an update
  ReplaySession session(c, {Method::hybrid, Method::general});
  ASSERT_TRUE(reaches(session, State::paused, 0));
  session.setSpeed(0);
  session.play();
  ASSERT_TRUE(test::happens([&] {
    const auto now = session.snapshot();
    for (const auto& filter : now->filters) EXPECT_EQ(filter ? filter->updates : 0, now->scans);
    return now->state == State::ended;
  }));
}

TEST_F(ReplaySessionTest, KeepsTheLogsPace) {
  ReplaySession session(laps(), {Method::hybrid});
  ASSERT_TRUE(reaches(session, State::paused, 0));
  const auto start = std::chrono::steady_clock::now();
  session.setSpeed(4);
  session.play();
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->scans >= 11; }));
  // 10 gaps of 0.2 s at four times the pace.
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(490));
}

TEST_F(ReplaySessionTest, PausesBetweenScans) {
  ReplaySession session(laps(), {Method::hybrid});
  session.setSpeed(0.001);  // 200 s from scan to scan
  session.play();
  ASSERT_TRUE(reaches(session, State::playing, 1));
  session.pause();
  EXPECT_TRUE(reaches(session, State::paused, 1));
}

TEST_F(ReplaySessionTest, AnExportBeforeTheEndEndsTheReplayAndPlayRestartsIt) {
  ReplaySession session(laps(), {Method::hybrid});
  session.exportResults(folder.path("early"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 1; }));
  EXPECT_TRUE(session.snapshot()->isError);
  EXPECT_THAT(session.snapshot()->message, HasSubstr("no results yet"));
  session.seek(30);
  ASSERT_TRUE(reaches(session, State::paused, 30));
  session.exportResults("/proc/nowhere");
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 2; }));
  EXPECT_TRUE(session.snapshot()->isError);
  session.seek(31);  // nothing was written: it can continue
  ASSERT_TRUE(reaches(session, State::paused, 31));
  EXPECT_EQ(session.snapshot()->run, 1u);
  session.exportResults(folder.path("out"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 3; }));
  EXPECT_FALSE(session.snapshot()->isError) << session.snapshot()->message;
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/hybrid/metrics.json")));
  session.setSpeed(0);
  session.play();
  ASSERT_TRUE(reaches(session, State::ended, kScans));
  EXPECT_EQ(session.snapshot()->run, 2u);
}

TEST_F(ReplaySessionTest, AfterAFailureOfTheFilterTheResultsUpToItCanBeExported) {
  // With cells of 1 cm, MRPT's grid cannot hold the surroundings of a robot whose laser is 99 m away.
  test::Log log = test::laps(60);
  dynamic_cast<mrpt::obs::CObservation2DRangeScan&>(*log[81]).sensorPose.x(99);
  run::Configuration c(
      "", {"run.rawlog=" + test::writeGzipped(folder.path("far.rawlog"), log), "particle_filter.particles=2",
           "particle_filter.proposal=standard", "grid.resolution=0.01", "grid.max_range=10",
           "grid_weight.method=likelihood_field"});
  ReplaySession session(c, {Method::general, Method::linemap});
  session.setSpeed(0);
  session.play();
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 1; }));
  const auto failed = session.snapshot();
  EXPECT_EQ(failed->state, State::ended);
  EXPECT_TRUE(failed->isError);
  EXPECT_THAT(failed->message, AllOf(HasSubstr("run failed: "), HasSubstr("entry "), HasSubstr("export")));
  EXPECT_EQ(failed->scans, 40u);

  session.exportResults(folder.path("out"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 2; }));
  EXPECT_FALSE(session.snapshot()->isError) << session.snapshot()->message;
  c.setMethod(Method::general);
  c.run.output = folder.path("offline");
  const std::atomic<bool> stop{false};
  EXPECT_FALSE(run::replay(c, true, stop).incomplete.empty());
  for (const char* name : {"trajectory.tum", "map.pgm", "covariance.csv"})
    EXPECT_EQ(test::contentOf(folder.path(std::string("out/general/") + name)),
              test::contentOf(folder.path(std::string("offline/") + name)))
        << name;
  for (const char* method : {"general", "linemap"})
    EXPECT_THAT(test::contentOf(folder.path(std::string("out/") + method + "/metrics.json")),
                HasSubstr("\"complete\": false"));
  session.play();  // from the beginning
  EXPECT_TRUE(test::happens([&] { return session.snapshot()->run == 2; }));
}

TEST_F(ReplaySessionTest, ResultsThatNeedAMissingLogAreAFailure) {
  const run::Configuration c = laps();
  ReplaySession session(c, {Method::hybrid});
  session.seek(30);
  ASSERT_TRUE(reaches(session, State::paused, 30));
  const std::string log = c.run.rawlog, away = log + ".away";
  std::filesystem::rename(log, away);  // map.simplemap.gz is made from it
  for (const size_t attempt : {1u, 2u}) {
    session.exportResults(folder.path("out"));
    ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == attempt; }));
    EXPECT_TRUE(session.snapshot()->isError);
    EXPECT_THAT(session.snapshot()->message, HasSubstr("laps.rawlog"));
    EXPECT_EQ(session.snapshot()->state, State::ended);
  }
  std::filesystem::rename(away, log);
  session.setSpeed(0);
  session.play();
  ASSERT_TRUE(reaches(session, State::ended, kScans));
  session.exportResults(folder.path("out"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 3; }));
  EXPECT_FALSE(session.snapshot()->isError) << session.snapshot()->message;
}

/// Writes a log of 100 million scans, which takes longer to read than a test may take, but only 20 MB.
std::string writeEndless(const std::string& path) {
  const std::string part = test::contentOf(test::writePlain(path, test::Log(20000, test::scan(1000))));
  std::string compressed(ZSTD_compressBound(part.size()), '\0');
  compressed.resize(ZSTD_compress(compressed.data(), compressed.size(), part.data(), part.size(), 1));
  std::ofstream file(path, std::ios::binary);
  for (int i = 0; i < 5000; ++i) file << compressed;
  return path;
}

TEST_F(ReplaySessionTest, ClosingDoesNotWaitForALongLogToBeRead) {
  const run::Configuration c = configuration(writeEndless(folder.path("long.rawlog")));
  const auto opened = std::chrono::steady_clock::now();
  { const ReplaySession session(c, {Method::hybrid}); }
  EXPECT_LT(std::chrono::steady_clock::now() - opened, std::chrono::minutes(1));
}

TEST_F(ReplaySessionTest, SavesTheMapAndGoesOn) {
  ReplaySession session(laps(), {Method::hybrid, Method::general});
  session.saveMap(folder.path("early"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 1; }));
  EXPECT_THAT(session.snapshot()->message, HasSubstr("no map yet"));
  session.seek(30);
  ASSERT_TRUE(reaches(session, State::paused, 30));
  session.saveMap(folder.path("saved"));
  ASSERT_TRUE(test::happens([&] { return !session.snapshot()->note.empty(); }));
  EXPECT_EQ(session.snapshot()->note, "map saved: " + folder.path("saved"));
  for (const char* method : {"hybrid", "general"}) {
    const std::string path = folder.path("saved/") + method;
    EXPECT_FALSE(test::contentOf(path + "/session.hslam").empty()) << method;
    const std::string trajectory = test::contentOf(path + "/trajectory.tum");
    EXPECT_EQ(std::count(trajectory.begin(), trajectory.end(), '\n'), 30) << method;
  }
  run::Configuration whole = laps(), resumed = laps();
  whole.run.output = folder.path("whole");
  resumed.run.resume = folder.path("saved/hybrid/session.hslam");
  const std::atomic<bool> stop{false};
  run::replay(whole, true, stop);
  run::replay(resumed, true, stop);
  const auto results = test::filesIn(folder.path("saved/hybrid"), "20");  // beside the saved map
  ASSERT_EQ(results.size(), 1u);
  for (const char* name : {"/trajectory.tum", "/map.pgm", "/lines.csv"})
    EXPECT_EQ(test::contentOf(results[0] + name), test::contentOf(folder.path("whole") + name)) << name;

  session.saveMap("/proc/nowhere");
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 2; }));
  EXPECT_TRUE(session.snapshot()->isError);
  EXPECT_EQ(session.snapshot()->state, State::paused);
  session.seek(31);
  ASSERT_TRUE(reaches(session, State::paused, 31));
  EXPECT_EQ(session.snapshot()->run, 1u) << "the same run";
}

TEST_F(ReplaySessionTest, SaysWhichLasersItTakesAndWhatFollowsFromTheLog) {
  test::Log log = test::laps(kScans);
  const auto rear = test::scan(1000, {}, 91, "REAR");
  rear->sensorPose.setYawPitchRoll(0, 0.5, 0);
  log.push_back(rear);
  ReplaySession session(configuration(test::writeGzipped(folder.path("two.rawlog"), log)), {Method::hybrid});
  ASSERT_TRUE(reaches(session, State::paused, 0));
  const auto now = session.snapshot();
  EXPECT_THAT(now->events, testing::Contains(HasSubstr("laser LASER: 181 beams")));
  EXPECT_THAT(now->events, testing::Contains(HasSubstr("improved_proposal.update_distance = 0.1: ")));
  EXPECT_THAT(now->events, testing::Contains(HasSubstr("warning: laser `REAR` is not used: ")));
  EXPECT_THAT(now->note, HasSubstr("REAR")) << "in the status bar";
  ASSERT_TRUE(now->ofLog);
  EXPECT_EQ(now->ofLog->lasers.size(), 1u);
  EXPECT_EQ(now->messages, 0u) << "no dialog";
  session.step();
  ASSERT_TRUE(reaches(session, State::paused, 1));
  EXPECT_EQ(session.snapshot()->events, now->events) << "they stay";
}

TEST_F(ReplaySessionTest, ALogWithoutTheRequiredOdometryFailsEachTime) {
  run::Configuration c =
      configuration(test::writeGzipped(folder.path("none.rawlog"), {test::scan(1), test::scan(2)}));
  c.source.write("input", "require_odometry", "true");
  ReplaySession session(c, {Method::hybrid});
  for (const size_t attempt : {1u, 2u}) {
    ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == attempt; }));
    EXPECT_EQ(session.snapshot()->state, State::failed);
    EXPECT_THAT(session.snapshot()->message, HasSubstr("no odometry"));
    session.play();
  }
}

TEST_F(ReplaySessionTest, AnInvalidLogFailsWithItsName) {
  ReplaySession session(configuration(folder.path("missing.rawlog")), {Method::hybrid});
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->state == State::failed; }));
  EXPECT_THAT(session.snapshot()->message, HasSubstr("missing.rawlog"));
  session.exportResults(folder.path("out"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 2; }));
  session.saveMap(folder.path("map"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 3; }));
  EXPECT_THAT(session.snapshot()->message, HasSubstr("missing.rawlog"));
  session.play();
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == 4; }));
  test::writeGzipped(folder.path("missing.rawlog"), test::laps(10));
  session.setSpeed(0);
  session.play();
  EXPECT_TRUE(reaches(session, State::ended, 10)) << "the requests do not wait for this";
  EXPECT_EQ(session.snapshot()->messages, 4u);
}

}  // namespace
}  // namespace hybrid_slam::window
