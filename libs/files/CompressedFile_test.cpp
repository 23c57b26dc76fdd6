#include "files/CompressedFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "testing/CompressedBytes.h"
#include "testing/IncompressibleText.h"

namespace hybrid_slam::files {
namespace {

using test::compressed;
using test::incompressibleText;
using test::kCompressions;
using testing::AnyOf;

struct Outcome {
  std::string content, defect;
};

Outcome read(const std::string& path) {
  CompressedFile file(path, "expected a test");
  Outcome outcome;
  std::string block(777, '\0');
  while (const size_t got = file.read(block.data(), block.size())) outcome.content.append(block, 0, got);
  outcome.defect = file.defect();
  return outcome;
}

TEST(CompressedFile, PlainBytesAreThemselves) {
  const TemporaryFolder folder;
  for (const std::string& text : {std::string(), std::string("BZh9 is a text"), incompressibleText(200000)}) {
    const Outcome outcome = read(folder.write("plain", text));
    EXPECT_EQ(outcome.content, text);
    EXPECT_EQ(outcome.defect, "");
  }
}

TEST(CompressedFile, ContentDecidesWhichCompression) {
  const TemporaryFolder folder;
  const std::string text = incompressibleText(300000);
  for (const Compression compression : kCompressions) {
    const std::string path = folder.write("any.txt", compressed(compression, text));
    EXPECT_EQ(read(path).content, text) << nameOf(compression);
    CompressedFile file(path, "");
    std::string again(10, ' ');
    file.read(again.data(), 10);
    file.rewind();
    file.read(again.data(), 10);
    EXPECT_EQ(again, text.substr(0, 10));
    EXPECT_EQ(read(folder.write("empty", compressed(compression, ""))).content, "");
  }
}

TEST(CompressedFile, StreamsOneAfterAnotherAreOneContent) {
  const TemporaryFolder folder;
  for (const Compression compression : kCompressions) {
    const std::string one = compressed(compression, "one"), two = compressed(compression, "two");
    const Outcome outcome = read(folder.write("both", one + two + std::string(512, '\0')));
    EXPECT_EQ(outcome.content, "onetwo") << nameOf(compression);
    EXPECT_EQ(outcome.defect, "");
  }
}

TEST(CompressedFile, AFileThatIsShortenedWhileItIsReadIsDefective) {
  const TemporaryFolder folder;
  const std::string text = incompressibleText(300000);
  const std::string path = folder.write("plain", text);
  CompressedFile file(path, "");
  std::string block(text.size(), ' ');
  size_t got = file.read(block.data(), 100);
  std::filesystem::resize_file(path, 200000);
  while (const size_t more = file.read(block.data(), block.size())) got += more;
  EXPECT_EQ(got, 200000u);
  EXPECT_EQ(file.defect(), "shortened while it was read");
  file.rewind();
  EXPECT_EQ(file.defect(), "") << "until its end is read";

  CompressedFile growing(path, "");
  growing.read(block.data(), 100);
  std::ofstream(path, std::ios::app) << "more";
  while (growing.read(block.data(), block.size())) {
  }
  EXPECT_EQ(growing.defect(), "");
}

TEST(CompressedFile, EveryCutIsFoundAfterWhatCanBeRead) {
  const TemporaryFolder folder;
  const std::string text = incompressibleText(300000);
  for (const Compression compression : kCompressions) {
    const std::string bytes = compressed(compression, text);
    for (const size_t kept : {size_t{12}, bytes.size() / 2, bytes.size() - 1}) {
      const Outcome outcome = read(folder.write("cut", bytes.substr(0, kept)));
      EXPECT_EQ(outcome.content, text.substr(0, outcome.content.size()));
      EXPECT_EQ(outcome.defect, std::string(nameOf(compression)) + " file cut off") << kept;
    }
  }
}

TEST(CompressedFile, DamageIsFound) {
  const TemporaryFolder folder;
  for (const Compression compression : kCompressions) {
    std::string bytes = compressed(compression, incompressibleText(100000));
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
    const std::string name = nameOf(compression);
    EXPECT_THAT(read(folder.write("damaged", bytes)).defect,
                AnyOf("damaged " + name + " file", name + " file cut off"));
  }
}

TEST(CompressedFile, ContentInMemoryMustHaveTheSizeThatIsClaimed) {
  const std::string text = incompressibleText(3000000);
  for (const Compression compression : kCompressions) {
    const std::string bytes = compressed(compression, text);
    EXPECT_EQ(decoded(compression, bytes, text.size()), text) << nameOf(compression);
    EXPECT_THROW(decoded(compression, bytes, text.size() - 1), Damaged);
    EXPECT_THROW(decoded(compression, bytes, text.size() + 1), Damaged);
    EXPECT_THROW(decoded(compression, bytes.substr(0, bytes.size() - 2), text.size()), Damaged);
    EXPECT_THROW(decoded(compression, "not compressed", size_t{1} << 40), Damaged);
    EXPECT_THROW(decoded(compression, "", 0), Damaged);
  }
}

}  // namespace
}  // namespace hybrid_slam::files
