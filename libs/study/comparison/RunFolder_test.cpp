#include "study/comparison/RunFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::comparison {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A log, and a run on it as written by hybrid-slam.
struct RunFolderTest : testing::Test {
  files::TemporaryFolder temporary;
  RunFolder folder{fs::path(temporary.path("runs")), "hybrid-20-1"};
  RunIdentity identity;

  RunFolderTest() {
    noteLog(identity, temporary.write("log.rawlog", "scans"));
    identity.configuration = configuration("0.05");
  }
  std::string configuration(const std::string& resolution) const {
    return "[run]\nmethod = hybrid\nrawlog = " + identity.log +
           "\noutput = elsewhere\n\n[grid]\nresolution = " + resolution + "\nlabel = \n";
  }
  void finishRun() const {
    folder.begin(identity);
    std::ofstream(folder.partial() / "config.ini") << identity.configuration;
    for (const char* name : {"map.pgm", "map.yaml", "map.simplemap.gz", "map.gridmap.gz", "metrics.json"})
      std::ofstream(folder.partial() / name) << "{}";
    folder.finish();
  }
  std::string difference(const RunIdentity& other) const {
    try {
      folder.expect(other);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(folder.path().string()));
      return error.what();
    }
    return "none";
  }
};

TEST_F(RunFolderTest, IsFinishedWhenItHasItsFinalName) {
  EXPECT_FALSE(folder.isFinished());
  folder.begin(identity);
  std::ofstream(folder.partial() / "metrics.json") << "{}";
  EXPECT_FALSE(folder.isFinished());
  folder.finish();
  EXPECT_TRUE(folder.isFinished());
  EXPECT_FALSE(fs::exists(folder.partial()));
}

TEST_F(RunFolderTest, KeepsTheFilesOfTheReportAndRemovesLargeOnes) {
  finishRun();
  EXPECT_TRUE(fs::exists(folder.file("map.gridmap.gz")));
  for (const char* name : {"map.pgm", "map.yaml", "map.simplemap.gz"})
    EXPECT_FALSE(fs::exists(folder.file(name)));
}

TEST_F(RunFolderTest, NoticesAFileThatHasChanged) {
  finishRun();
  EXPECT_EQ(folder.damage(), "");
  for (const char* text : {"{", "{]"}) {  // of another and of the same size
    std::ofstream(folder.file("metrics.json")) << text;
    EXPECT_EQ(folder.damage(), "metrics.json") << text;
  }
  std::ofstream(folder.file("metrics.json")) << "{}";
  fs::remove(folder.file("map.gridmap.gz"));
  EXPECT_EQ(folder.damage(), "map.gridmap.gz");
  std::ofstream(folder.file("checksums.json")) << "{";
  EXPECT_EQ(folder.damage(), "checksums.json");
}

// Reading it whole would take minutes.
TEST_F(RunFolderTest, AFileThatHasGrownToATerabyteIsDamagedAtOnce) {
  finishRun();
  fs::resize_file(folder.file("map.gridmap.gz"), uintmax_t{1} << 40);
  EXPECT_EQ(folder.damage(), "map.gridmap.gz");
}

// It has no end.
TEST_F(RunFolderTest, AChecksumOfADeviceIsDamage) {
  finishRun();
  for (const char* record : {"1", R"({"bytes": 18446744073709551615, "crc32": 1})"}) {
    std::ifstream in(folder.file("checksums.json"));
    auto records = nlohmann::ordered_json::parse(in);
    records["/dev/zero"] = nlohmann::json::parse(record);
    std::ofstream(folder.file("checksums.json")) << records;
    EXPECT_EQ(folder.damage(), "/dev/zero") << record;
  }
}

TEST_F(RunFolderTest, AFileOfTheReportWithoutAChecksumIsDamage) {
  finishRun();
  std::ofstream(folder.file("checksums.json")) << "{}";
  EXPECT_EQ(folder.damage(), "checksums.json");
}

TEST_F(RunFolderTest, RecordsOfTheChecksumAloneAreStillRead) {
  finishRun();
  std::ifstream in(folder.file("checksums.json"));
  auto records = nlohmann::json::parse(in);
  for (auto& record : records) record = record["crc32"];
  std::ofstream(folder.file("checksums.json")) << records;
  EXPECT_EQ(folder.damage(), "");
  std::ofstream(folder.file("metrics.json")) << "{";
  EXPECT_EQ(folder.damage(), "metrics.json");
}

TEST_F(RunFolderTest, ExpectsTheSameSettingsAndLog) {
  finishRun();
  EXPECT_EQ(difference(identity), "none");

  RunIdentity other = identity;
  other.configuration = configuration("0.1");
  EXPECT_THAT(difference(other), HasSubstr("[grid] resolution = 0.05, now 0.1"));
  other = identity;
  other.configuration += "fresh = 1\n";
  EXPECT_THAT(difference(other), HasSubstr("[grid] fresh = (nothing), now 1"));
  other = identity;
  other.configuration.erase(other.configuration.find("label"));
  EXPECT_THAT(difference(other), HasSubstr("[grid] label = , now no such key"));
  other = identity;
  other.log += "2";
  EXPECT_THAT(difference(other), HasSubstr("log.rawlog2"));
  for (const auto& change : std::vector<std::function<void(RunIdentity&)>>{
           [](RunIdentity& i) { ++i.logSize; }, [](RunIdentity& i) { ++i.logTime; },
           [](RunIdentity& i) { i.otherSections = "[MappingApplication]\n"; }}) {
    other = identity;
    change(other);
    EXPECT_THAT(difference(other), HasSubstr("changed"));
  }
}

TEST_F(RunFolderTest, WithoutARecordOfItsOriginComparesSettingsAndPathOnly) {
  finishRun();
  fs::remove(folder.file("origin.json"));
  RunIdentity other = identity;
  ++other.logSize;
  EXPECT_EQ(difference(other), "none");
  other.configuration = configuration("0.1");
  EXPECT_THAT(difference(other), HasSubstr("resolution"));
}

TEST_F(RunFolderTest, ARecordOfItsOriginWithWrongTypesIsDamage) {
  finishRun();
  fs::remove(folder.file("checksums.json"));
  for (const char* origin : {"{", "[]", "{}", R"({"log_size": "5", "log_time_ns": 1, "other_sections": ""})",
                             R"({"log_size": 5, "log_time_ns": {}, "other_sections": ""})",
                             R"({"log_size": 5, "log_time_ns": 1, "other_sections": 7})",
                             R"({"log_size": -5, "log_time_ns": 1, "other_sections": ""})"}) {
    std::ofstream(folder.file("origin.json")) << origin;
    EXPECT_EQ(folder.damage(), "origin.json") << origin;
    EXPECT_THAT(difference(identity), HasSubstr("origin.json is broken")) << origin;
  }
}

/// A recursive copy of 200,000 levels would overflow the stack.
TEST_F(RunFolderTest, ADeepRecordOfItsOriginIsDamage) {
  finishRun();
  const std::string deep(200000, '[');
  std::ofstream(folder.file("origin.json"))
      << "{\"log_size\":" << deep << std::string(deep.size(), ']') << "}";
  EXPECT_EQ(folder.damage(), "origin.json");
}

TEST_F(RunFolderTest, ALoopOfLinksIsNotFinished) {
  fs::create_directories(folder.path().parent_path());
  fs::create_symlink(folder.path(), folder.path());
  EXPECT_FALSE(folder.isFinished());
  EXPECT_EQ(folder.damage(), "");
}

TEST_F(RunFolderTest, AnEmptyConfigurationIsAnotherRuns) {
  finishRun();
  std::ofstream(folder.file("config.ini")) << "";
  EXPECT_THAT(difference(identity), HasSubstr("log "));
}

TEST_F(RunFolderTest, ARunOfOursWithoutChecksumsIsDamaged) {
  finishRun();
  fs::remove(folder.file("checksums.json"));
  EXPECT_EQ(folder.damage(), "checksums.json");
  fs::remove(folder.file("origin.json"));
  EXPECT_EQ(folder.damage(), "") << "not started by slam-compare";
}

// Otherwise one broken run prevents the report of all others.
TEST_F(RunFolderTest, ADamagedConfigurationIsNoOtherLog) {
  finishRun();
  for (const std::string& text :
       {std::string(), std::string(100, '\0'), std::string("[run]\nrawlog = other\n")}) {
    std::ofstream(folder.file("config.ini")) << text;
    EXPECT_EQ(folder.damage(), "config.ini");
    EXPECT_NO_THROW(expectLog(folder.path().parent_path(), identity));
  }
  fs::resize_file(folder.file("config.ini"), 20'000'000);
  EXPECT_THAT(difference(identity), HasSubstr("log"));
}

// Opening a pipe waits for its writer.
TEST_F(RunFolderTest, APipeInPlaceOfAFileIsDamage) {
  finishRun();
  for (const char* name : {"config.ini", "steps.csv", "origin.json", "checksums.json", "error.txt"}) {
    SCOPED_TRACE(name);
    fs::rename(folder.path(), temporary.path("other"));
    fs::copy(temporary.path("other"), folder.path());
    fs::remove(folder.file(name));
    ASSERT_EQ(mkfifo(folder.file(name).c_str(), 0600), 0);
    EXPECT_NO_THROW(expectLog(folder.path().parent_path(), identity));
    EXPECT_EQ(folder.damage(), name);
    EXPECT_EQ(folder.error(), "");
    difference(identity);  // returns
    folder.discard();
    fs::rename(temporary.path("other"), folder.path());
  }
}

TEST_F(RunFolderTest, AFailedRunLeavesItsErrorAndNothingElse) {
  folder.begin(identity);
  std::ofstream(folder.partial() / "metrics.json") << "{}";
  folder.fail("disk full: here; there");
  EXPECT_FALSE(folder.isFinished());
  EXPECT_EQ(folder.error(), "disk full: here; there");
  EXPECT_FALSE(fs::exists(folder.partial()));
  finishRun();  // the next attempt
  EXPECT_TRUE(folder.isFinished());
  EXPECT_EQ(folder.error(), "");
}

TEST_F(RunFolderTest, FilesOfTheUserStay) {
  finishRun();
  const fs::path notes = folder.file("notes.txt");
  std::ofstream(notes) << "mine";
  folder.discard();
  EXPECT_FALSE(folder.isFinished());
  finishRun();  // the next attempt
  EXPECT_TRUE(folder.isFinished());
  EXPECT_EQ(test::contentOf(notes.string()), "mine");
  EXPECT_FALSE(fs::exists(folder.partial()));
  folder.begin(identity);
  folder.fail("disk full");
  EXPECT_FALSE(folder.isFinished());
  EXPECT_EQ(test::contentOf(notes.string()), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2) << "and error.txt";
}

TEST_F(RunFolderTest, ResultsThatAreGoneAreAnError) {
  folder.begin(identity);
  fs::remove_all(temporary.path("runs"));
  EXPECT_THROW(folder.finish(), InputError);
}

TEST_F(RunFolderTest, AnAbandonedRunLeavesNothing) {
  folder.begin(identity);
  fs::create_directory(folder.partial().parent_path() / ".other.part-x");
  fs::create_directory(folder.partial().parent_path() /
                       ("." + folder.partial().filename().string() + ".part-x"));
  folder.abandon();
  fs::remove(folder.partial().parent_path() / ".other.part-x");
  EXPECT_TRUE(fs::is_empty(temporary.path("runs")));
}

TEST_F(RunFolderTest, AMissingLogIsAnInputError) {
  EXPECT_THROW(noteLog(identity, temporary.path("none.rawlog")), InputError);
}

}  // namespace
}  // namespace hybrid_slam::comparison
