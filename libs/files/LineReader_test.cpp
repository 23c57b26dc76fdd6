#include "files/LineReader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>

#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"
#include "testing/IncompressibleText.h"

namespace hybrid_slam::files {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

void writeGzip(const std::string& path, const std::string& content) {
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, content.data(), static_cast<unsigned>(content.size()));
  gzclose(file);
}

std::vector<std::string> readAll(LineReader& lines) {
  std::vector<std::string> all;
  for (std::string line; lines.next(line);) all.push_back(line);
  return all;
}

TEST(LineReader, AFileThatIsShortenedAtTheEndOfALineIsAnError) {
  const TemporaryFolder folder;
  const std::string path = folder.write("lines", std::string(100000, '\n'));
  LineReader lines(path);
  std::string line;
  lines.next(line);
  std::filesystem::resize_file(path, 90000);
  EXPECT_EQ(test::errorOf([&] { readAll(lines); }),
            "shortened while it was read: " + path + ", after line 90000; expected a whole file");
}

std::string errorOf(const std::string& path) {
  return test::errorOf([&] {
    LineReader lines(path);
    readAll(lines);
  });
}

TEST(LineReader, ReadsPlainAndGzippedLinesWithTheirNumbers) {
  const TemporaryFolder folder;
  const std::string text = "one\n\nthree \r\nlast without an end";
  folder.write("plain.gz", text);  // the content decides, not the name
  writeGzip(folder.path("zipped.txt"), text);
  for (const char* name : {"plain.gz", "zipped.txt"}) {
    LineReader lines(folder.path(name));
    EXPECT_THAT(readAll(lines), ElementsAre("one", "", "three \r", "last without an end")) << name;
    EXPECT_EQ(lines.number(), 4u);
    lines.rewind();
    std::string line;
    ASSERT_TRUE(lines.next(line));
    EXPECT_EQ(line, "one");
    EXPECT_EQ(lines.number(), 1u);
  }
}

TEST(LineReader, SkipsTheByteOrderMarkOfTheFile) {
  const TemporaryFolder folder;
  const std::string mark = "\xEF\xBB\xBF";
  for (const std::string end : {"\n", ""}) {
    LineReader lines(folder.write("lines", mark + "one\n" + mark + "two" + end));
    EXPECT_THAT(readAll(lines), ElementsAre("one", mark + "two"));
    lines.rewind();
    EXPECT_THAT(readAll(lines), ElementsAre("one", mark + "two"));
  }
}

TEST(LineReader, EmptyFileHasNoLine) {
  const TemporaryFolder folder;
  LineReader lines(folder.write("empty", ""));
  std::string line;
  EXPECT_FALSE(lines.next(line));
  EXPECT_EQ(lines.number(), 0u);
}

TEST(LineReader, LinesLongerThanTheBufferAndZeroBytesPass) {
  const TemporaryFolder folder;
  const std::string longLine(200000, 'x'), zeros("a\0b", 3);
  LineReader lines(folder.write("long", longLine + "\n" + zeros + "\n"));
  EXPECT_THAT(readAll(lines), ElementsAre(longLine, zeros));
}

TEST(LineReader, UnreadableFilesGiveTheReason) {
  const TemporaryFolder folder;
  EXPECT_EQ(errorOf(folder.path("none")),
            "no such file: " + folder.path("none") + "; expected a log, plain or compressed");
  EXPECT_THAT(errorOf(folder.path("")), HasSubstr("a folder, not a file"));
  EXPECT_THAT(errorOf(folder.write("binary", std::string(3 << 20, 'x'))),
              HasSubstr("line 1; expected lines of at most 1 MiB"));
}

TEST(LineReader, TruncatedGzipIsAnErrorForEveryCut) {
  const TemporaryFolder folder;
  writeGzip(folder.path("whole"), test::incompressibleText(400000));
  std::ifstream in(folder.path("whole"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  EXPECT_EQ(errorOf(folder.path("whole")), "no error");
  for (const size_t kept :
       {size_t{12}, bytes.size() / 3, bytes.size() / 2, bytes.size() - 9, bytes.size() - 1})
    EXPECT_THAT(errorOf(folder.write("cut", bytes.substr(0, kept))), HasSubstr("gzip file cut off")) << kept;
}

TEST(LineReader, DamagedGzipIsAnError) {
  const TemporaryFolder folder;
  writeGzip(folder.path("whole"), test::incompressibleText(400000));
  std::ifstream in(folder.path("whole"), std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  bytes[bytes.size() - 6] = static_cast<char>(bytes[bytes.size() - 6] ^ 1);  // the checksum
  EXPECT_THAT(errorOf(folder.write("damaged", bytes)), HasSubstr("damaged gzip file"));
}

}  // namespace
}  // namespace hybrid_slam::files
