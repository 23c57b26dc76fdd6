#include "bags/Bag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "bags/RecordingFolder.h"
#include "files/Gzip.h"
#include "files/TemporaryFolder.h"
#include "testing/BagContents.h"
#include "testing/RosBags.h"

namespace hybrid_slam::bags {
namespace {

using test::Content;
using test::errorOfBag;
using test::expectSame;
using test::messages;
using test::read;
using test::TestMessage;
using testing::HasSubstr;

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
  EXPECT_THAT(errorOfBag(folder.write("old.bag", "#ROSBAG V1.2\nabc")), HasSubstr("rosbag fix"));
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

TEST(RecordingFolder, ItsFilesAreOrderedByTheirLastNumber) {
  const files::TemporaryFolder folder;
  for (const char* name : {"v1.5_10.mcap", "v1.5_2.mcap", "v1.5_0.mcap.zstd"}) folder.write(name, "");
  const auto files = filesOfRecording(folder.path(""));
  ASSERT_EQ(files.size(), 3u);
  EXPECT_THAT(files[0], testing::EndsWith("v1.5_0.mcap.zstd"));
  EXPECT_THAT(files[1], testing::EndsWith("v1.5_2.mcap"));
  EXPECT_THAT(files[2], testing::EndsWith("v1.5_10.mcap"));
}

TEST(RecordingFolder, SeveralRecordingsAreAnErrorUnlessMetadataListTheFiles) {
  const files::TemporaryFolder folder;
  const auto all = messages(5, Encoding::cdr);
  test::writeDatabase(folder.path("monday_0.db3"), all);
  test::writeDatabase(folder.path("tuesday_0.db3"), all);
  EXPECT_THAT(errorOfBag(folder.path("")), HasSubstr("several recordings in one folder: " + folder.path("")));
  EXPECT_THAT(errorOfBag(folder.path("")),
              HasSubstr("expected the files of one; it has `monday_0.db3` and `tuesday_0.db3`"));
  folder.write(
      "metadata.yaml",
      "rosbag2_bagfile_information:\n  relative_file_paths:\n    - monday_0.db3\n    - tuesday_0.db3\n");
  EXPECT_EQ(read(folder.path("")).messages.size(), 2 * all.size());
}

TEST(RecordingFolder, AFileThatIsThereTwiceOrNotListedIsNotRead) {
  const files::TemporaryFolder folder;
  const auto all = messages(5, Encoding::cdr);
  const std::string plain = test::contentOf(test::writeDatabase(folder.path("drive_0.db3"), all));
  test::write(folder.path("drive_0.db3.zstd"), test::zstdOf(plain));
  expectSame(read(folder.path("")).messages, all);
  test::write(folder.path("copy.db3"), plain);
  folder.write("metadata.yaml",
               "rosbag2_bagfile_information:\n  relative_file_paths:\n    - drive_0.db3.zstd\n");
  expectSame(read(folder.path("")).messages, all);
}

TEST(RecordingFolder, AFileThatItsMetadataListIsMissed) {
  const files::TemporaryFolder folder;
  const auto all = messages(5, Encoding::cdr);
  test::writeDatabase(folder.path("drive_0.db3"), all);
  const auto defect = [&](const std::string& metadata) {
    folder.write("metadata.yaml", metadata);
    const Content content = read(folder.path(""));
    expectSame(content.messages, all);
    return content.defect;
  };
  const std::string list = "rosbag2_bagfile_information:\n  relative_file_paths:\n";
  EXPECT_EQ(defect(list + "    - drive_0.db3.zstd\n"), "");
  EXPECT_EQ(defect(list + "    - recorded/drive_0.db3\n    - recorded/drive_1.db3\n"),
            "lacks drive_1.db3, which its metadata.yaml lists");
  for (const std::string& broken :
       {std::string("]"), list, list + "    - [1]\n", std::string(2'000'000, '[')})
    EXPECT_EQ(defect(broken), "");
}

TEST(RecordingFolder, AFileThatCannotBeReadIsTheEnd) {
  const files::TemporaryFolder folder;
  const auto written = messages(5, Encoding::cdr);
  folder.write("drive_0.db3", "");
  EXPECT_THAT(errorOfBag(folder.path("")), HasSubstr("not a bag: " + folder.path("drive_0.db3")));
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
    EXPECT_THAT(errorOfBag(folder.path("other")), HasSubstr("not a bag"));
  }
  EXPECT_FALSE(isBag(folder.path("none")));
  EXPECT_FALSE(isBag(folder.path("")));
  EXPECT_THAT(errorOfBag(folder.path("")), HasSubstr("not a recording"));
}

}  // namespace
}  // namespace hybrid_slam::bags
