#include "live/Recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "files/RawlogReader.h"
#include "files/TemporaryFolder.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::live {
namespace {

size_t entriesOf(const std::string& file) {
  files::RawlogReader reader(file);
  size_t entries = 0;
  while (reader.next()) ++entries;
  return entries;
}

// A supervisor may start the program again within a second.
TEST(Recording, NoneReplacesAnother) {
  const files::TemporaryFolder folder;
  test::Events events;
  std::set<std::string> paths;
  for (size_t i = 1; i <= 6; ++i) {  // at least two within a second
    Recording one(folder.path(""), "run.rawlog", events.log());
    Recording other(folder.path(""), "run.rawlog", events.log());
    for (size_t k = 0; k < i; ++k) one.write(*test::scan(1000, {}));
    other.write(*test::scan(1000, {}));
    one.finish();
    EXPECT_EQ(entriesOf(one.path()), i);
    other.finish();
    EXPECT_EQ(entriesOf(one.path()), i);
    EXPECT_EQ(entriesOf(other.path()), 1u);
    paths.insert({one.path(), other.path()});
  }
  EXPECT_EQ(paths.size(), 12u);
}

TEST(Recording, MovesWithItsFolder) {
  const files::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("out"));
  test::Events events;
  Recording recording(folder.path("out"), "run.rawlog", events.log());
  recording.write(*test::scan(1000, {}));
  std::filesystem::rename(folder.path("out"), folder.path("moved"));
  recording.write(*test::scan(1001, {}));
  recording.finish();
  EXPECT_EQ(std::filesystem::path(recording.path()).parent_path(), folder.path("moved"));
  EXPECT_EQ(entriesOf(recording.path()), 2u);
}

TEST(Recording, MayBeginAfterItsFolderHasMoved) {
  const files::TemporaryFolder folder;
  test::Events events;
  for (const bool isRemoved : {false, true}) {
    std::filesystem::create_directory(folder.path("out"));
    Recording recording(folder.path("out"), "run.rawlog", events.log());
    isRemoved ? std::filesystem::remove(folder.path("out"))
              : (std::filesystem::rename(folder.path("out"), folder.path("moved")), true);
    recording.write(*test::scan(1000, {}));
    recording.finish();
    EXPECT_EQ(std::filesystem::path(recording.path()).parent_path(),
              folder.path(isRemoved ? "out" : "moved"));
    EXPECT_EQ(entriesOf(recording.path()), 1u);
  }
}

TEST(Recording, LeavesDiskSpaceWhereItsFolderIsNow) {
  const files::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("out"));
  test::Events events;
  Recording recording(folder.path("out"), "run.rawlog", events.log());
  recording.write(*test::scan(1000, {}));
  std::filesystem::rename(folder.path("out"), folder.path("moved"));
  recording.keepFree(1e18);
  recording.write(*test::scan(1001, {}));
  EXPECT_EQ(events.count("disk almost full: " + folder.path("moved")), 1u) << events.text();
}

TEST(Recording, WithoutAnObservationThereIsNoFile) {
  const files::TemporaryFolder folder;
  test::Events events;
  { const Recording recording(folder.path(""), "run.rawlog", events.log()); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
}

}  // namespace
}  // namespace hybrid_slam::live
