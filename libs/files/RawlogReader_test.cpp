#include "files/RawlogReader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <new>

#include "base/Errors.h"
#include "base/MrptVersion.h"
#include "base/RandomStream.h"
#include "files/TemporaryFolder.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::files {
namespace {

using test::Log;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;

struct Read {
  size_t entries = 0;
  std::string defect, error;
  bool operator==(const Read& o) const {
    return entries == o.entries && defect.empty() == o.defect.empty() && error.empty() == o.error.empty();
  }
};

Read readAll(const std::string& path) {
  Read result;
  try {
    RawlogReader reader(path);
    while (reader.next())
      ;
    EXPECT_EQ(reader.next(), nullptr) << "an end stays an end";
    result.entries = reader.entry();
    result.defect = reader.defect();
  } catch (const InputError& e) {
    result.error = e.what();
  }
  return result;
}

/// One of each kind of object that logs hold.
test::Log smallLog() {
  return {test::odometry(1, {1, 2, 3}), test::scan(2, {}, 7), test::action({0.1, 0, 0}),
          test::frame({test::scan(3, {}, 5), test::scan(4, {}, 3)}), test::scan(5, {}, 0)};
}

TEST(RawlogReader, ReadsPlainAndGzipped) {
  const TemporaryFolder folder;
  EXPECT_EQ(readAll(test::writePlain(folder.path("plain"), smallLog())), (Read{5, "", ""}));
  EXPECT_EQ(readAll(test::writeGzipped(folder.path("gzip"), smallLog())), (Read{5, "", ""}));
}

TEST(RawlogReader, ALogThatIsShortenedBetweenTwoEntriesIsDefective) {
  const TemporaryFolder folder;
  std::vector<size_t> ends;
  const std::string path = test::writePlain(folder.path("log"), test::laps(300), &ends);
  RawlogReader reader(path);
  reader.next();
  std::filesystem::resize_file(path, ends[500]);
  while (reader.next()) {
  }
  EXPECT_EQ(reader.entry(), 501u);
  EXPECT_EQ(reader.defect(), "shortened while it was read");
}

TEST(RawlogReader, EveryCutOfAPlainLogIsDetected) {
  const TemporaryFolder folder;
  std::vector<size_t> ends;
  const std::string bytes = test::contentOf(test::writePlain(folder.path("whole"), smallLog(), &ends));
  ASSERT_EQ(ends.back(), bytes.size());
  for (size_t cut = 0; cut < bytes.size(); ++cut) {
    SCOPED_TRACE(cut);
    const Read read = readAll(folder.write("cut", bytes.substr(0, cut)));
    const auto next = std::upper_bound(ends.begin(), ends.end(), cut);
    EXPECT_EQ(read.entries, static_cast<size_t>(next - ends.begin()));
    const bool isBetween = next != ends.begin() && *(next - 1) == cut;
    if (next == ends.begin()) {
      EXPECT_THAT(read.error, HasSubstr(cut == 0 ? "empty" : "not a log"));
    } else {
      EXPECT_EQ(read.defect.empty(), isBetween) << read.defect;
      EXPECT_THAT(read.error, IsEmpty());
    }
  }
}

/// A log of noise-like readings, so that gzip has several blocks.
test::Log longLog() {
  test::Log log;
  for (size_t i = 0; i < 40; ++i)
    log.push_back(test::scan(static_cast<double>(i), test::poseOnLap(i, 40), 91));
  return log;
}

TEST(RawlogReader, EveryCutOfAGzippedLogIsADefectAlsoBetweenTwoObjects) {
  const TemporaryFolder folder;
  const std::string bytes = test::contentOf(test::writeGzipped(folder.path("whole"), longLog()));
  ASSERT_EQ(readAll(folder.path("whole")), (Read{40, "", ""}));
  for (size_t cut = 20; cut < bytes.size(); cut += cut + 40 < bytes.size() ? 37 : 1) {
    SCOPED_TRACE(cut);
    const Read read = readAll(folder.write("cut", bytes.substr(0, cut)));
    EXPECT_TRUE(!read.defect.empty() || !read.error.empty());
  }
}

TEST(RawlogReader, ACutAfterTheLastObjectOfAGzippedLogIsADefect) {
  const TemporaryFolder folder;
  const std::string bytes = test::contentOf(test::writeGzipped(folder.path("whole"), longLog()));
  const Read read = readAll(folder.write("cut", bytes.substr(0, bytes.size() - 1)));  // in the check sum
  EXPECT_EQ(read.entries, 40u);
  EXPECT_THAT(read.defect, HasSubstr("gzip"));
}

TEST(RawlogReader, AWrongCheckSumIsADefect) {
  const TemporaryFolder folder;
  const std::string bytes = test::contentOf(test::writeGzipped(folder.path("whole"), longLog()));
  for (size_t fromEnd = 1; fromEnd <= 8; ++fromEnd) {
    std::string damaged = bytes;
    damaged[bytes.size() - fromEnd] = static_cast<char>(damaged[bytes.size() - fromEnd] ^ 1);
    EXPECT_THAT(readAll(folder.write("damaged", damaged)).defect, HasSubstr("gzip"));
  }
}

TEST(RawlogReader, AnEmptyObjectIsSkipped) {
  const TemporaryFolder folder;
  const std::string scan = test::contentOf(test::writePlain(folder.path("one"), {test::scan(1)}));
  const std::string null = std::string("\x87") + "nullptr" + "\x88";
  EXPECT_EQ(readAll(folder.write("log", scan + null + scan)), (Read{3, "", ""}));
}

TEST(RawlogReader, AnUnknownClassIsADefectInOneLine) {
  const TemporaryFolder folder;
  const std::string scan = test::contentOf(test::writePlain(folder.path("one"), {test::scan(1)}));
  std::string other = scan;
  other.replace(other.find("CObservation2DRangeScan"), 23, "CSomething2DRangeScan_x");
  const Read read = readAll(folder.write("log", scan + other + scan));
  EXPECT_EQ(read.entries, 1u);
  EXPECT_THAT(read.defect, HasSubstr("CSomething2DRangeScan_x"));
  EXPECT_THAT(read.defect, testing::Not(HasSubstr("\n")));
  EXPECT_THAT(read.defect, testing::Not(HasSubstr("====")));
}

/// Renames the class of `object` to one that is not listed.
std::string ofOtherClass(std::string object) {
  return object.replace(object.find("RangeScan"), 9, "RangeScam");
}

TEST(RawlogReader, AnObservationOfAnUnknownClassIsPassedOver) {
  const TemporaryFolder folder;
  const std::string scan = test::contentOf(test::writePlain(folder.path("one"), {test::scan(1)}));
  const std::string other = ofOtherClass(scan);
  for (const std::string& bytes : {scan + other + other + scan, other + scan + scan + other}) {
    RawlogReader reader(folder.write("log", bytes));
    size_t scans = 0;
    while (reader.next()) ++scans;
    EXPECT_EQ(scans, 2u);
    EXPECT_EQ(reader.entry(), 4u);
    EXPECT_THAT(reader.defect(), IsEmpty());
    EXPECT_EQ(reader.passedOver(), 2u);
    EXPECT_EQ(reader.firstPassedOver(), bytes.compare(0, scan.size(), scan) == 0 ? 2u : 1u);
    EXPECT_THAT(reader.passedOverClasses(), testing::ElementsAre("CObservation2DRangeScam"));
  }
}

TEST(RawlogReader, NamesOfUnknownClassesFillNoMemory) {
  const TemporaryFolder folder;
  const std::string scan = test::contentOf(test::writePlain(folder.path("one"), {test::scan(1)}));
  std::string bytes = scan;
  for (int i = 100; i < 400; ++i) {
    std::string other = scan;
    const size_t at = other.find("CObservation2DRangeScan");
    other.replace(at + 20, 3, std::to_string(i));
    bytes += other;
  }
  RawlogReader reader(folder.write("log", bytes));
  while (reader.next()) continue;
  EXPECT_EQ(reader.passedOver(), 300u);
  EXPECT_EQ(reader.passedOverClasses().size(), 100u);
}

TEST(RawlogReader, AnObservationOfAnUnknownClassIsPassedOverWithinAFrame) {
  const TemporaryFolder folder;
  const std::string scan = test::contentOf(test::writePlain(folder.path("one"), {test::scan(1, {}, 5)}));
  const std::string frame = test::contentOf(
      test::writePlain(folder.path("three"),
                       {test::frame({test::scan(1, {}, 5), test::scan(2, {}, 5), test::scan(3, {}, 5)})}));
  const size_t head = frame.size() - 3 * scan.size() - 1;  // before the observations, and the end flag
  for (const size_t changed : {0, 1, 2, 3, 4, 5, 6, 7}) {  // bits: which of the three
    std::string bytes = frame;
    size_t kept = 3;
    for (size_t i = 0; i < 3; ++i)
      if ((changed >> i & 1) != 0) {
        bytes.replace(head + i * scan.size(), scan.size(),
                      ofOtherClass(frame.substr(head + i * scan.size(), scan.size())));
        --kept;
      }
    for (const std::string& after : {std::string(), scan, frame}) {
      RawlogReader reader(folder.write("log", bytes + after));
      const auto read = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(reader.next());
      ASSERT_TRUE(read);
      EXPECT_EQ(read->size(), kept);
      EXPECT_EQ(reader.passedOver(), 3 - kept);
      EXPECT_EQ(reader.next() != nullptr, !after.empty());
      EXPECT_EQ(reader.next(), nullptr);
      EXPECT_THAT(reader.defect(), IsEmpty());
    }
  }
}

TEST(RawlogReader, AnUnknownVersionIsADefectThatNamesClassAndVersion) {
  const TemporaryFolder folder;
  const std::string scan = test::contentOf(test::writePlain(folder.path("one"), {test::scan(1)}));
  std::string newer = scan;
  newer[1 + std::string("mrpt::obs::CObservation2DRangeScan").size()] = 77;
  EXPECT_THAT(readAll(folder.write("log", scan + newer)).defect,
              HasSubstr("CObservation2DRangeScan of unknown version 77"));
}

TEST(RawlogReader, AFirstObjectOfANewerMrptIsAnErrorThatSaysSo) {
  const TemporaryFolder folder;
  const std::string name = "mrpt::obs::CObservationComment";
  const std::string log = static_cast<char>(0x80 | name.size()) + name + '\1' + std::string(4, '\0') +
                          std::string(8, '\1') + std::string(4, '\0') + static_cast<char>(0x88);
  const Read read = readAll(folder.write("log", log));
  if (MRPT_VERSION >= 0x20e00)
    EXPECT_EQ(read, (Read{1, "", ""}));
  else
    EXPECT_THAT(read.error,
                MatchesRegex("unreadable object \\(.*CObservationComment.*\\): .*/log; expected a "
                             "rawlog of this version of MRPT or an earlier one"));
}

TEST(RawlogReader, AFileThatIsNotALogIsAnError) {
  const TemporaryFolder folder;
  EXPECT_THAT(readAll(folder.path("none")).error, HasSubstr("no such file: " + folder.path("none")));
  EXPECT_THAT(readAll(folder.path("")).error, HasSubstr("not a file"));
  EXPECT_THAT(readAll("/dev/null").error, HasSubstr("not a file"));
  EXPECT_THAT(readAll(folder.write("empty", "")).error, HasSubstr("empty"));
  EXPECT_THAT(readAll(folder.write("text", "Once upon a time there was a robot.\n")).error,
              HasSubstr("not a log"));
  RandomStream random(1, 2, 3);
  for (int i = 0; i < 300; ++i) {
    std::string bytes(static_cast<size_t>(1 + i), '\0');
    for (char& c : bytes) c = static_cast<char>(random.bits());
    EXPECT_THAT(readAll(folder.write("random", bytes)).error, HasSubstr("not a log"));
  }
}

TEST(RawlogReader, LackingMemoryIsNotTakenForDamage) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need their address space";
#endif
  const TemporaryFolder folder;
  const std::string log = test::writePlain(
      folder.path("log"), {test::scan(1000), test::scan(1001, {}, 1000000), test::scan(1002)});
  RawlogReader reader(log);
  EXPECT_TRUE(reader.next());
  ::malloc_trim(0);
  size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit before{};
  ::getrlimit(RLIMIT_AS, &before);
  const rlimit now{pages * static_cast<size_t>(::sysconf(_SC_PAGESIZE)), before.rlim_max};
  ::setrlimit(RLIMIT_AS, &now);
  EXPECT_THROW(reader.next(), std::bad_alloc);
  ::setrlimit(RLIMIT_AS, &before);
  EXPECT_EQ(reader.defect(), "");
}

}  // namespace
}  // namespace hybrid_slam::files
