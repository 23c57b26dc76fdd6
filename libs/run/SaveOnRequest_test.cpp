#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "files/TemporaryFolder.h"
#include "run/FilterRun.h"
#include "testing/FullDisk.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using testing::HasSubstr;

std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  return names;
}

TEST(SaveOnRequest, AFullDiskLeavesAllFilesOrNone) {
  const files::TemporaryFolder folder;
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  Configuration c("", {"run.output=" + folder.path("out"), "particle_filter.particles=5"});
  FilterRun run(c);
  readings::RawlogSource source(log, c.input, readings::summarise(log, c.input));
  size_t whole = 0, none = 0;
  for (rlim_t bytes = 500; const auto reading = source.next(); bytes += bytes / 4) {
    run.requestSave();
    {
      const test::FullDisk disk(bytes);
      run.process(*reading);
    }
    const std::vector<std::string> notes = run.takeNotes(), names = namesIn(folder.path("out"));
    ASSERT_EQ(notes.size(), 1u);
    if (names.empty()) {
      ++none;
      EXPECT_THAT(notes[0], HasSubstr("map not saved: "));
      continue;
    }
    ++whole;
    ASSERT_EQ(names.size(), 1u);
    EXPECT_THAT(names[0], testing::StartsWith("saved-"));
    const std::string saved = folder.path("out/" + names[0]);
    EXPECT_EQ(notes[0], "map saved: " + saved);
    EXPECT_THAT(namesIn(saved),
                testing::UnorderedElementsAre("trajectory.tum", "map.png", "map.pgm", "map.yaml", "lines.csv",
                                              "plan.svg", "plan.dxf", "plan.geojson", "session.hslam"));
    std::filesystem::remove_all(saved);
  }
  EXPECT_GT(whole, 5u);
  EXPECT_GT(none, 5u);
}

}  // namespace
}  // namespace hybrid_slam::run
