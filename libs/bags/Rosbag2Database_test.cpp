#include "bags/Rosbag2Database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "files/Gzip.h"
#include "files/TemporaryFolder.h"
#include "testing/BagContents.h"

namespace hybrid_slam::bags {
namespace {

using test::Content;
using test::errorOfBag;
using test::expectSame;
using test::messages;
using test::read;
using test::TestMessage;
using testing::HasSubstr;

void execute(const std::string& path, const std::string& sql) {
  sqlite3* database = nullptr;
  sqlite3_open(path.c_str(), &database);
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  sqlite3_close(database);
}

/// Adds topics numbered `from` to `to`, with equal or different names.
void addTopics(const std::string& path, int from, int to, const std::string& name = "'/t' || i") {
  execute(path, "WITH RECURSIVE n(i) AS (VALUES(" + std::to_string(from) +
                    ") UNION ALL SELECT i + 1 FROM n WHERE i < " + std::to_string(to) +
                    ") INSERT INTO topics SELECT i, " + name + ", 'a/B', 'cdr', '' FROM n");
}

TEST(Rosbag2Database, GivesTheMessagesInOrder) {
  const files::TemporaryFolder folder;
  auto written = messages(50, Encoding::cdr);
  const std::string path = test::writeDatabase(folder.path("a.db3"), written);
  EXPECT_TRUE(isBag(path));
  const Content content = read(path);
  EXPECT_EQ(content.defect, "");
  expectSame(content.messages, written);
}

/// The files of a folder, sorted.
std::vector<std::string> filesIn(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// rosbag2 wrote in this mode until 2021. The name has characters that mean something in a URI.
TEST(Rosbag2Database, ReadingOneInWalModeLeavesNothingBesideIt) {
  const files::TemporaryFolder folder, temporary;
  const auto written = messages(50, Encoding::cdr);
  const std::string name = "a 100%?x=1#\xc3\xa9.db3", path = test::writeDatabase(folder.path(name), written);
  execute(path, "PRAGMA journal_mode=WAL");
  ASSERT_THAT(filesIn(folder.path("")), testing::ElementsAre(name));
  expectSame(read(path).messages, written);
  EXPECT_THAT(filesIn(folder.path("")), testing::ElementsAre(name));
  const std::string before = std::filesystem::temp_directory_path();
  ::setenv("TMPDIR", temporary.path("").c_str(), 1);
  expectSame(read(folder.write("b.db3.gz", files::gzipped(test::contentOf(path)))).messages, written);
  ::setenv("TMPDIR", before.c_str(), 1);
  EXPECT_THAT(filesIn(temporary.path("")), testing::IsEmpty());
}

/// As after a crash of the recorder.
TEST(Rosbag2Database, ChangesInAWalFileAreRead) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(50, Encoding::cdr));
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  sqlite3_exec(database, "PRAGMA journal_mode=WAL; DELETE FROM messages WHERE id > 7", nullptr, nullptr,
               nullptr);
  for (const std::string suffix : {"", "-wal"})
    std::filesystem::copy_file(path + suffix, folder.path("b.db3" + suffix));
  sqlite3_close(database);
  EXPECT_EQ(read(folder.path("b.db3")).messages.size(), 7u);
}

TEST(Rosbag2Database, OtherDatabasesAreNone) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), {});
  EXPECT_TRUE(read(path).messages.empty());
  execute(path, "DROP TABLE messages; CREATE VIEW messages AS SELECT 1 AS topic_id");
  EXPECT_THAT(errorOfBag(path), HasSubstr("not a recording"));
  execute(path, "DROP VIEW messages; CREATE VIRTUAL TABLE messages USING fts5(topic_id, timestamp, data)");
  EXPECT_THAT(errorOfBag(path), HasSubstr("not a recording"));
  EXPECT_THAT(
      errorOfBag(folder.write("b.db3", std::string("SQLite format 3\0", 16) + std::string(5000, 'x'))),
      HasSubstr("expected a ROS 2 recording"));
}

TEST(Rosbag2Database, TenThousandTopicsAreReadAndMoreAreNot) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(1, Encoding::cdr));
  addTopics(path, 3, 10000);
  EXPECT_EQ(read(path).messages.size(), 2u);
  const std::string copy = folder.path("folder/a.db3");
  std::filesystem::create_directory(folder.path("folder"));
  std::filesystem::copy(path, copy);
  EXPECT_EQ(read(folder.path("folder")).defect, "");
  addTopics(path, 10001, 10001);
  EXPECT_THAT(errorOfBag(path), HasSubstr("over 10,000 topics"));
}

TEST(Rosbag2Database, TopicsOfOneNameAreBoundedAsWell) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(1, Encoding::cdr));
  addTopics(path, 3, 10001, "'/scan'");
  EXPECT_THAT(errorOfBag(path), HasSubstr("over 10,000 topics"));
}

TEST(Rosbag2Database, ComputedColumnsAreRefused) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(1, Encoding::cdr));
  execute(path, "ALTER TABLE topics ADD COLUMN extra TEXT AS (name || name)");
  EXPECT_EQ(errorOfBag(path), "computed columns in table topics: " + path +
                                  "; expected a ROS 2 recording with the tables topics and messages");
  test::writeDatabase(path, messages(1, Encoding::cdr));
  execute(path,
          "ALTER TABLE messages DROP COLUMN data;"
          "ALTER TABLE messages ADD COLUMN data BLOB AS (zeroblob(1000000))");
  EXPECT_THAT(errorOfBag(path), HasSubstr("computed columns in table messages"));
}

/// SQLite would sort in temporary files, which may become larger than the recording.
TEST(Rosbag2Database, MessagesAreNotSortedByAColumnNamedRowid) {
  const files::TemporaryFolder folder;
  const auto written = messages(5, Encoding::cdr);
  const std::string path = test::writeDatabase(folder.path("a.db3"), written);
  execute(path, "ALTER TABLE messages ADD COLUMN rowid INTEGER; UPDATE messages SET rowid = -id");
  expectSame(read(path).messages, written);
}

TEST(Rosbag2Database, AFileGivesNoMoreThanItsBytes) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(500, Encoding::cdr));
  execute(path,
          "ALTER TABLE messages DROP COLUMN data; ALTER TABLE messages ADD COLUMN data BLOB DEFAULT x'" +
              std::string(20000, '0') + "'; VACUUM");
  const Content content = read(path);
  EXPECT_EQ(content.defect, "damaged database (more messages than bytes)");
  EXPECT_LT(content.messages.size() * 10000, std::filesystem::file_size(path));
}

/// An inner page of 512 bytes in a table's tree: `start`, then pointers to the page `first` and 50 times to
/// `other`.
std::string innerPage(const std::string& start, char first, char other) {
  constexpr int kCells = 50, kCellsBegin = 512 - 5 * kCells;
  const auto number = [](int value) {
    return std::string{static_cast<char>(value >> 8), static_cast<char>(value)};
  };
  std::string page = start + std::string("\5\0\0", 3) + number(kCells) + number(kCellsBegin) +
                     std::string{0, 0, 0, 0, other};
  for (int i = 0; i < kCells; ++i) page += number(kCellsBegin + 5 * i);
  page.resize(kCellsBegin);
  for (int i = 0; i < kCells; ++i) page += std::string{0, 0, 0, i == 0 ? first : other, 1};
  return page;
}

/// A file of 5 kB that claims one row a million times.
TEST(Rosbag2Database, ASchemaOfTheSamePageManyTimesIsRefused) {
  const files::TemporaryFolder folder;
  const std::string path = folder.path("a.db3");
  execute(
      path,
      "PRAGMA page_size = 512; CREATE TABLE topics(id, name, type, serialization_format);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data); CREATE TABLE x(a UNIQUE)");
  const std::string bytes = test::contentOf(path);
  ASSERT_EQ(bytes.size(), 5u * 512);
  std::string head = bytes.substr(0, 100);
  head[31] = 10;  // pages
  const std::string fourRows = bytes.substr(100, 16), cells = bytes.substr(116, 512 - 116);
  const std::string lastRow = fourRows.substr(0, 4) + '\1' + fourRows.substr(5, 3) + fourRows.substr(14);
  test::write(path, innerPage(head, 6, 10) + bytes.substr(512) + fourRows + std::string(100, '\0') + cells +
                        lastRow + std::string(106, '\0') + cells + innerPage("", 7, 7) + innerPage("", 8, 8) +
                        innerPage("", 9, 9));
  EXPECT_THAT(errorOfBag(path), HasSubstr("not a recording"));
}

TEST(Rosbag2Database, NoSpaceToUnpackItIsAnError) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(500, Encoding::cdr));
  const std::string packed = folder.write("a.db3.gz", files::gzipped(test::contentOf(path)));
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100'000, before.rlim_max};  // the second write of 64 kB is short
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string error = errorOfBag(packed);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(error, HasSubstr("cannot unpack the database"));
  EXPECT_THAT(error, HasSubstr("No space left"));
}

TEST(Rosbag2Database, ADatabaseThatIsCutOffIsDamaged) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(500, Encoding::cdr));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_THAT(errorOfBag(path), HasSubstr("damaged database, or cut off"));
}

TEST(Rosbag2Database, DamagedDatabasesDoNoHarm) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(50, Encoding::cdr));
  const std::string bytes = test::contentOf(path);
  for (size_t i = 16; i < bytes.size(); i += bytes.size() / 100) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
    errorOfBag(test::write(path, damaged));
  }
}

}  // namespace
}  // namespace hybrid_slam::bags
