#include "run/FilterRun.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/Errors.h"
#include "files/Gzip.h"
#include "files/TemporaryFolder.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using testing::HasSubstr;

// A search without end would keep its maps, and the run would have no checkpoints.
TEST(FilterRun, SavesItselfOnceTheSearchInAPlanIsOver) {
  const files::TemporaryFolder folder;
  Configuration configuration("", {"run.output=" + folder.path("out"), "particle_filter.particles=2"});
  configuration.run.priorPlan = folder.write(
      "plan.geojson",
      R"({"features":[{"geometry":{"type":"LineString","coordinates":[[0,0],[3,0],[3,2],[0,0]]}}]})");
  FilterRun run(configuration);
  readings::Reading reading;
  const auto process = [&] {
    const auto scan = test::scan(1000 + reading.timestamp, {}, 61);
    for (size_t i = 0; i < 61; ++i) scan->setScanRange(i, i % 2 == 0 ? 4.F : 5.F);
    reading.scans = {scan};
    reading.timestamp += 1;
    run.process(reading);
  };
  process();
  EXPECT_EQ(run.state(), "");
  EXPECT_THROW(run.saveMapTo(folder.path("early")), std::runtime_error);
  for (int i = 0; i < 400; ++i) process();
  EXPECT_NE(run.state(), "");
  run.saveMapTo(folder.path("late"));
  EXPECT_THAT(run.placeNote(), HasSubstr("place not found in the floor plan"));
}

// Otherwise the fuzz target stops at the header, because older layouts are refused.
TEST(FilterRun, GoesOnFromTheSessionsOfTheFuzzCorpus) {
  const files::TemporaryFolder folder;
  size_t sessions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SOURCE_DIR "/tests/fuzz/corpus/session")) {
    SCOPED_TRACE(entry.path());
    const std::string zipped =
        folder.write("session.hslam", files::gzipped(test::contentOf(entry.path().string())));
    SessionReader session(zipped);
    Configuration configuration("", {"particle_filter.particles=2", "run.output=" + folder.path("out")});
    FilterRun run(configuration);
    EXPECT_NO_THROW(run.resume(session)) << "made again by hybrid-slam -n 2, uncompressed";
    EXPECT_GT(run.scans(), 0u);
    ++sessions;
  }
  EXPECT_EQ(sessions, 3u);
}

}  // namespace
}  // namespace hybrid_slam::run
