#include "bags/Bag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "files/Gzip.h"
#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"
#include "testing/RosBags.h"

namespace hybrid_slam::bags {
namespace {

using test::TestMessage;
using testing::HasSubstr;

std::vector<TestMessage> messages(size_t count, Encoding encoding = Encoding::ros1) {
  const test::MessageBytes empty(encoding);
  std::vector<TestMessage> all;
  for (size_t i = 0; i < count; ++i) {
    const double time = 100 + 0.25 * static_cast<double>(i);
    all.push_back({"/scan", "sensor_msgs/LaserScan", time,
                   test::scanBytes(empty, time, "laser", std::vector<float>(200, static_cast<float>(i)))});
    all.push_back({"/odom", "nav_msgs/Odometry", time, test::odometryBytes(empty, time, {time, 0, 0})});
  }
  return all;
}

struct Content {
  std::vector<TestMessage> messages;
  std::string defect;
};

Content read(const std::string& path) {
  const auto bag = openBag(path);
  Content content;
  while (const auto message = bag->next()) {
    const Topic& topic = bag->topics()[message->topic];
    content.messages.push_back({topic.name, topic.type, message->time, std::string(message->bytes)});
  }
  EXPECT_FALSE(bag->next());
  content.defect = bag->defect();
  return content;
}

void expectSame(const std::vector<TestMessage>& found, const std::vector<TestMessage>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].topic, expected[i].topic);
    EXPECT_EQ(messageTypeOf(found[i].type), messageTypeOf(expected[i].type));
    EXPECT_NEAR(found[i].time, expected[i].time, 1e-6);
    EXPECT_EQ(found[i].bytes, expected[i].bytes);
  }
}

std::string errorOf(const std::string& path) {
  return test::errorOf([&] { read(path); });
}

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

/// Expects that each truncated file gives the messages it holds.
/// @param isPlain  nothing is compressed: all messages before the cut are there
void expectCutsAreFound(const std::string& path, const std::vector<TestMessage>& whole, bool isPlain) {
  const std::string bytes = test::contentOf(path);
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    SCOPED_TRACE(share);
    const auto length = static_cast<size_t>(share * static_cast<double>(bytes.size()));
    const Content cut = read(test::write(path, bytes.substr(0, length)));
    if (cut.messages.size() < whole.size()) {
      EXPECT_THAT(cut.defect, HasSubstr("cut off"));
    }
    expectSame(cut.messages,
               {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut.messages.size())});
    if (!isPlain) continue;
    size_t before = 0;
    for (size_t at = 0; before < whole.size(); ++before) {
      at = bytes.find(whole[before].bytes, at);
      ASSERT_NE(at, std::string::npos);
      at += whole[before].bytes.size();
      if (at > length) break;
    }
    EXPECT_EQ(cut.messages.size(), before);
  }
}

TEST(Ros1Bag, WrittenByTheLibraryOfRos) {
  const files::TemporaryFolder folder;
  const auto written = messages(100);
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    const std::string path = test::writeRosBag(folder.path("a.bag"), written, compression);
    EXPECT_TRUE(isBag(path));
    const Content content = read(path);
    EXPECT_EQ(content.defect, "");
    expectSame(content.messages, written);
  }
}

TEST(Ros1Bag, CutBagsAreReadUpToTheCut) {
  const files::TemporaryFolder folder;
  const auto written = messages(400);
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    SCOPED_TRACE(compression);
    expectCutsAreFound(test::writeRosBag(folder.path("a.bag"), written, compression), written,
                       compression == rosbag::compression::Uncompressed);
  }
}

/// Flips one bit in each of a hundred places: the bag is read to the end or has a defect, but nothing
/// crashes.
TEST(Ros1Bag, DamagedBagsDoNoHarm) {
  const files::TemporaryFolder folder;
  const auto written = messages(20);
  for (const auto compression : {rosbag::compression::Uncompressed, rosbag::compression::LZ4}) {
    const std::string path = test::writeRosBag(folder.path("a.bag"), written, compression);
    const std::string bytes = test::contentOf(path);
    for (size_t i = 13; i < bytes.size(); i += bytes.size() / 100) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
      EXPECT_LE(read(test::write(path, damaged)).messages.size(), written.size());
    }
  }
}

/// The bags of scan_tools, recorded in 2010, state 20 bytes for each index entry, which has 12.
TEST(Ros1Bag, WrongLengthsOfTheIndexDoNotMatter) {
  const files::TemporaryFolder folder;
  const auto written = messages(100);
  const std::string path = test::writeRosBag(folder.path("a.bag"), written);
  std::string bytes = test::contentOf(path);
  const std::string version("ver=\1\0\0\0", 8);
  size_t indices = 0;
  for (size_t at = bytes.find(version); at != std::string::npos; at = bytes.find(version, at + 1)) {
    uint32_t length = 0;
    std::memcpy(&length, &bytes[at + version.size()], sizeof length);
    length = length / 12 * 20;
    std::memcpy(&bytes[at + version.size()], &length, sizeof length);
    ++indices;
  }
  EXPECT_GT(indices, 4u);
  const Content content = read(test::write(path, bytes));
  EXPECT_EQ(content.defect, "");
  expectSame(content.messages, written);
}

TEST(Ros1Bag, OldVersionsAreRefused) {
  const files::TemporaryFolder folder;
  EXPECT_THAT(errorOf(folder.write("old.bag", "#ROSBAG V1.2\nabc")), HasSubstr("rosbag fix"));
}

TEST(McapFile, EveryCompressionAndEncoding) {
  const files::TemporaryFolder folder;
  for (const Encoding encoding : {Encoding::cdr, Encoding::ros1})
    for (const char* compression : {"none", "", "zstd", "lz4"}) {
      const auto written = messages(23, encoding);
      const Content content = read(test::writeMcap(folder.path("a.mcap"), written, compression, encoding));
      EXPECT_EQ(content.defect, "") << compression;
      expectSame(content.messages, written);
    }
}

TEST(McapFile, CutsAreFound) {
  const files::TemporaryFolder folder;
  const auto written = messages(50, Encoding::cdr);
  for (const char* compression : {"none", "", "zstd", "lz4"}) {
    SCOPED_TRACE(compression);
    expectCutsAreFound(test::writeMcap(folder.path("a.mcap"), written, compression), written,
                       std::string(compression).empty() || compression == std::string("none"));
  }
  const std::string bytes = test::contentOf(test::writeMcap(folder.path("a.mcap"), written));
  const Content withoutEnd = read(folder.write("cut.mcap", bytes.substr(0, bytes.rfind('\x0f'))));
  EXPECT_EQ(withoutEnd.messages.size(), written.size());
  EXPECT_THAT(withoutEnd.defect, HasSubstr("cut off"));
}

TEST(McapFile, ChecksumsAreChecked) {
  const files::TemporaryFolder folder;
  const auto written = messages(5, Encoding::cdr);
  for (const char* compression : {"none", "", "lz4"}) {
    std::string bytes = test::contentOf(test::writeMcap(folder.path("a.mcap"), written, compression));
    const size_t at = bytes.find(std::string("\x00\x00\xa0\x41", 4));  // a range_max
    ASSERT_NE(at, std::string::npos);
    bytes[at + 2] = static_cast<char>(bytes[at + 2] ^ 1);
    EXPECT_THAT(read(test::write(folder.path("a.mcap"), bytes)).defect, HasSubstr("checksum")) << compression;
  }
}

TEST(McapFile, LengthsThatAreNotThereTakeNoMemory) {
  const files::TemporaryFolder folder;
  const std::string huge(8, '\xff');
  const std::string start = test::McapBytes(Encoding::cdr).unfinished();
  for (const char kind : {'\1', '\3', '\4', '\5', '\6', '\t'}) {
    const Content content = read(folder.write("huge.mcap", start + kind + huge + "abc"));
    EXPECT_TRUE(content.messages.empty());
    EXPECT_THAT(content.defect, testing::AnyOf(HasSubstr("cut off"), HasSubstr("256 MiB")));
  }
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
  EXPECT_THAT(errorOf(path), HasSubstr("not a recording"));
  execute(path, "DROP VIEW messages; CREATE VIRTUAL TABLE messages USING fts5(topic_id, timestamp, data)");
  EXPECT_THAT(errorOf(path), HasSubstr("not a recording"));
  EXPECT_THAT(errorOf(folder.write("b.db3", std::string("SQLite format 3\0", 16) + std::string(5000, 'x'))),
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
  EXPECT_THAT(errorOf(path), HasSubstr("over 10,000 topics"));
}

TEST(Rosbag2Database, TopicsOfOneNameAreBoundedAsWell) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(1, Encoding::cdr));
  addTopics(path, 3, 10001, "'/scan'");
  EXPECT_THAT(errorOf(path), HasSubstr("over 10,000 topics"));
}

TEST(Rosbag2Database, ComputedColumnsAreRefused) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(1, Encoding::cdr));
  execute(path, "ALTER TABLE topics ADD COLUMN extra TEXT AS (name || name)");
  EXPECT_EQ(errorOf(path), "computed columns in table topics: " + path +
                               "; expected a ROS 2 recording with the tables topics and messages");
  test::writeDatabase(path, messages(1, Encoding::cdr));
  execute(path,
          "ALTER TABLE messages DROP COLUMN data;"
          "ALTER TABLE messages ADD COLUMN data BLOB AS (zeroblob(1000000))");
  EXPECT_THAT(errorOf(path), HasSubstr("computed columns in table messages"));
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
  EXPECT_THAT(errorOf(path), HasSubstr("not a recording"));
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
  const std::string error = errorOf(packed);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(error, HasSubstr("cannot unpack the database"));
  EXPECT_THAT(error, HasSubstr("No space left"));
}

TEST(Rosbag2Database, DamagedDatabasesDoNoHarm) {
  const files::TemporaryFolder folder;
  const std::string path = test::writeDatabase(folder.path("a.db3"), messages(50, Encoding::cdr));
  const std::string bytes = test::contentOf(path);
  for (size_t i = 16; i < bytes.size(); i += bytes.size() / 100) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
    errorOf(test::write(path, damaged));
  }
}

TEST(RecordingFolder, ItsFilesInTheOrderOfTheirNumbers) {
  const files::TemporaryFolder folder;
  const auto all = messages(15, Encoding::cdr);
  const auto part = [&](size_t from, size_t to) {
    return std::vector<TestMessage>(all.begin() + static_cast<std::ptrdiff_t>(from),
                                    all.begin() + static_cast<std::ptrdiff_t>(to));
  };
  test::writeDatabase(folder.path("drive_10.db3"), part(20, 30));
  test::writeDatabase(folder.path("drive_2.db3"), part(10, 20));
  test::write(folder.path("drive_2.db3.zstd"), test::zstdOf(test::contentOf(folder.path("drive_2.db3"))));
  std::filesystem::remove(folder.path("drive_2.db3"));
  test::writeMcap(folder.path("drive_0.mcap"), part(0, 10));
  folder.write("metadata.yaml", "rosbag2_bagfile_information:\n");
  EXPECT_TRUE(isBag(folder.path("")));
  const Content content = read(folder.path(""));
  EXPECT_EQ(content.defect, "");
  expectSame(content.messages, all);
}

TEST(RecordingFolder, AFileThatCannotBeReadIsTheEnd) {
  const files::TemporaryFolder folder;
  const auto written = messages(5, Encoding::cdr);
  folder.write("drive_0.db3", "");
  EXPECT_THAT(errorOf(folder.path("")), HasSubstr("not a bag: " + folder.path("drive_0.db3")));
  test::writeDatabase(folder.path("drive_0.db3"), written);
  folder.write("drive_1.db3", "");
  const Content content = read(folder.path(""));
  EXPECT_EQ(content.defect, "ends before drive_1.db3, which cannot be read");
  expectSame(content.messages, written);
}

TEST(Bag, CompressedFilesAreReadAsWell) {
  const files::TemporaryFolder folder;
  const auto written = messages(9, Encoding::cdr);
  const std::string plain = test::contentOf(test::writeMcap(folder.path("a.mcap"), written));
  expectSame(read(test::write(folder.path("b"), files::gzipped(plain))).messages, written);
}

TEST(Bag, NamesCannotControlATerminal) {
  const files::TemporaryFolder folder;
  auto written = messages(1, Encoding::cdr);
  written[0].topic = "/scan\x1b[2J";
  EXPECT_EQ(read(test::writeMcap(folder.path("a.mcap"), written)).messages[0].topic, "/scan?[2J");
}

TEST(Bag, OtherFilesAreNone) {
  const files::TemporaryFolder folder;
  for (const char* text : {"", "#ROSBAG", "FLASER 1 2 3"}) {
    EXPECT_FALSE(isBag(folder.write("other", text)));
    EXPECT_THAT(errorOf(folder.path("other")), HasSubstr("not a bag"));
  }
  EXPECT_FALSE(isBag(folder.path("none")));
  EXPECT_FALSE(isBag(folder.path("")));
  EXPECT_THAT(errorOf(folder.path("")), HasSubstr("not a recording"));
}

}  // namespace
}  // namespace hybrid_slam::bags
