/// Rawlogs of both forms, converted into both.
#include "readings/RawlogLog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CRawlog.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "files/RawlogReader.h"
#include "readings/LogConversion.h"
#include "testing/ErrorOf.h"
#include "testing/ReplayedLog.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationComment;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;
using test::action;
using test::areNear;
using test::frame;
using test::Log;
using test::odometry;
using test::Replayed;
using test::replayed;
using test::scan;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

LogConversionOptions pairs() {
  LogConversionOptions options;
  options.actionObservation = true;
  return options;
}

struct ConvertedRawlog {
  LogSummary summary;
  Log log;

  template <class Object>
  std::shared_ptr<Object> at(size_t i) const {
    return std::dynamic_pointer_cast<Object>(log.at(i));
  }
  /// Expects an increment of the action at an entry.
  void expectIncrement(size_t i, const TPose2D& expected) const {
    const auto increment = incrementOf(log.at(i));
    ASSERT_TRUE(increment);
    EXPECT_NEAR(increment->x, expected.x, 1e-9);
    EXPECT_NEAR(increment->y, expected.y, 1e-9);
    EXPECT_NEAR(increment->phi, expected.phi, 1e-9);
  }
  CObservation2DRangeScan::Ptr scanOfFrame(size_t i) const {
    return at<CSensoryFrame>(i)->getObservationByClass<CObservation2DRangeScan>();
  }
};

LogSummary convert(const std::string& input, const std::string& output, const LogConversionOptions& options) {
  return convertLog(input, output, options,
                    [](size_t number, const std::string& why) { ADD_FAILURE() << number << ": " << why; });
}

ConvertedRawlog converted(const Log& log, const LogConversionOptions& options = {}) {
  const files::TemporaryFolder folder;
  ConvertedRawlog out;
  out.summary = convert(test::writePlain(folder.path("in.rawlog"), log), folder.path("out.rawlog"), options);
  mrpt::obs::CRawlog rawlog;
  EXPECT_TRUE(rawlog.loadFromRawLogFile(folder.path("out.rawlog"))) << "MRPT reads it";
  files::RawlogReader reader(folder.path("out.rawlog"));  // CRawlog keeps comments apart
  while (const auto object = reader.next()) out.log.push_back(object);
  return out;
}

/// The filter gets the same scans, times and odometry.
void expectSameReadings(const Log& log, const Log& other) {
  const Replayed a = replayed(log), b = replayed(other);
  EXPECT_EQ(b.error, "");
  EXPECT_THAT(b.times, areNear(a.times));
  EXPECT_THAT(b.x, areNear(a.x));
  EXPECT_THAT(b.phi, areNear(a.phi));
  EXPECT_EQ(b.sizes, a.sizes);
}

/// 12 scans from 10 s on, a turn with the laser ahead of the robot's centre.
Log observations() {
  Log log;
  for (int i = 0; i < 12; ++i) {
    const TPose2D pose(0.1 * i, 0.02 * i, 0.05 * i);
    log.push_back(odometry(10 + 0.1 * i, pose));
    const auto one = scan(10 + 0.1 * i, pose, 11);
    one->sensorPose = mrpt::poses::CPose3D(0.3, 0, 0.2, 0, 0, 0);
    log.push_back(one);
  }
  return log;
}

TEST(RawlogLog, ObservationsBecomePairs) {
  const Log log = observations();
  const ConvertedRawlog out = converted(log, pairs());
  ASSERT_EQ(out.log.size(), 24u);
  for (size_t i = 0; i < 12; ++i) {
    const auto seen = out.scanOfFrame(2 * i + 1);
    ASSERT_TRUE(seen);
    const auto before = std::dynamic_pointer_cast<CObservation2DRangeScan>(log[2 * i + 1]);
    EXPECT_EQ(seen->timestamp, before->timestamp);
    EXPECT_EQ(seen->sensorLabel, "LASER");
    EXPECT_NEAR(seen->sensorPose.x(), 0.3, 1e-9);
    EXPECT_EQ(seen->maxRange, before->maxRange);
    ASSERT_EQ(seen->getScanSize(), 11u);
    for (size_t k = 0; k < 11; ++k) EXPECT_EQ(seen->getScanRange(k), before->getScanRange(k));
  }
  out.expectIncrement(0, {0, 0, 0});
  out.expectIncrement(2, {0.1, 0.02, 0.05});
  EXPECT_EQ(out.summary.format, "rawlog");
  EXPECT_EQ(out.summary.scans, 12u);
  EXPECT_EQ(out.summary.odometryReadings, 12u);
  EXPECT_NEAR(out.summary.latest - out.summary.earliest, 1.1, 1e-6);
  EXPECT_NEAR(out.summary.pathLength, 11 * std::hypot(0.1, 0.02), 1e-6);
  expectSameReadings(log, out.log);
}

TEST(RawlogLog, PairsBecomeObservations) {
  const Log log{action({0, 0, 0}),        frame({scan(10, {}, 3)}), action({1, 0, 0.5}),
                frame({scan(11, {}, 4)}), action({1, 0, 0}),        frame({scan(12, {}, 5)})};
  const ConvertedRawlog out = converted(log);
  ASSERT_EQ(out.log.size(), 6u);
  for (size_t i = 0; i < 3; ++i) {
    const auto odometry = out.at<CObservationOdometry>(2 * i);
    const auto seen = out.at<CObservation2DRangeScan>(2 * i + 1);
    ASSERT_TRUE(odometry && seen);
    EXPECT_EQ(odometry->timestamp, test::stamp(10 + static_cast<double>(i)));
    EXPECT_EQ(seen->timestamp, odometry->timestamp);
    EXPECT_EQ(seen->getScanSize(), 3 + i);
  }
  const auto last = out.at<CObservationOdometry>(4);
  EXPECT_EQ(last->sensorLabel, "ODOMETRY");
  EXPECT_NEAR(last->odometry.x(), 1 + std::cos(0.5), 1e-9);
  EXPECT_NEAR(last->odometry.y(), std::sin(0.5), 1e-9);
  EXPECT_NEAR(last->odometry.phi(), 0.5, 1e-9);
  EXPECT_EQ(out.summary.scans, 3u);
  EXPECT_EQ(out.summary.odometryReadings, 3u);
  EXPECT_NEAR(out.summary.pathLength, 2, 1e-9);
  expectSameReadings(log, out.log);
}

TEST(RawlogLog, OfTheFormThatIsAskedForItStaysAsItIs) {
  const Log single = observations();
  const ConvertedRawlog same = converted(single);
  EXPECT_EQ(same.log.size(), single.size());
  expectSameReadings(single, same.log);

  const Log two{action({0, 0, 0}), frame({scan(10, {}, 3, "front"), scan(10, {}, 4, "rear")}),
                action({1, 0, 0}), frame({scan(11, {}, 3, "front"), scan(11, {}, 4, "rear")})};
  const ConvertedRawlog out = converted(two, pairs());
  ASSERT_EQ(out.log.size(), 4u) << "the scans of both lasers stay in one frame";
  out.expectIncrement(2, {1, 0, 0});
  EXPECT_EQ(out.at<CSensoryFrame>(3)->size(), 2u);
  EXPECT_EQ(out.summary.scans, 4u);
  expectSameReadings(two, out.log);
}

TEST(RawlogLog, ThereAndBackGivesTheSameReadings) {
  const Log log = observations();
  expectSameReadings(log, converted(converted(log, pairs()).log).log);
}

TEST(RawlogLog, OdometryReadingsBesideActionsAreUsedAlone) {
  const auto both = [](double time, double x) {
    const auto one = frame({scan(time)});
    one->insert(odometry(time, {x, 0, 0}));
    return one;
  };
  const Log log{action({0, 0, 0}), both(10, 5), action({1, 0, 0}), both(10.5, 7)};
  const ConvertedRawlog out = converted(log);
  ASSERT_EQ(out.log.size(), 4u);
  ASSERT_TRUE(out.at<CObservationOdometry>(3));
  EXPECT_EQ(out.at<CObservationOdometry>(3)->odometry.x(), 7);
  expectSameReadings(log, out.log);
}

TEST(RawlogLog, ActionsWithoutOdometryAndTimesThatAreMissingAreKept) {
  const Log log{mrpt::obs::CActionCollection::Create(), frame({scan(test::kNoTime)}), action({1, 0, 0}),
                frame({scan(test::kNoTime)})};
  const ConvertedRawlog out = converted(log);
  ASSERT_EQ(out.log.size(), 3u) << "no odometry before the first increment";
  ASSERT_TRUE(out.at<CObservationOdometry>(1));
  EXPECT_EQ(out.at<CObservationOdometry>(1)->timestamp, INVALID_TIMESTAMP);
  EXPECT_EQ(out.summary.latest, 0);
  EXPECT_EQ(converted(log, pairs()).log.size(), 4u);
}

TEST(RawlogLog, OdometryThatIsNotANumberIsSkipped) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Log log{odometry(10, {0, 0, 0}), odometry(10.5, {nan, 0, 0}), scan(11), odometry(11, {1, 0, 0}),
                scan(12)};
  EXPECT_THAT(converted(log).summary.otherRecords,
              ElementsAre(Pair("odometry readings that are not numbers", 1u)));
  EXPECT_EQ(converted(log).log.size(), 4u);
  const ConvertedRawlog out = converted(log, pairs());
  out.expectIncrement(2, {1, 0, 0});
}

TEST(RawlogLog, OtherObservationsAreLeftOutOfPairsThatAreMade) {
  const auto comment = CObservationComment::Create();
  comment->text = "a drive";
  Log log = observations();
  log.insert(log.begin(), comment);
  EXPECT_EQ(converted(log).log.size(), 25u);
  const ConvertedRawlog out = converted(log, pairs());
  EXPECT_EQ(out.log.size(), 24u);
  EXPECT_THAT(out.summary.otherRecords, ElementsAre(Pair("CObservationComment", 1u)));
  const Log withAComment{action({0, 0, 0}), frame({scan(10)})};
  std::dynamic_pointer_cast<CSensoryFrame>(withAComment[1])->insert(comment);
  EXPECT_EQ(converted(withAComment, pairs()).at<CSensoryFrame>(1)->size(), 2u);
  EXPECT_TRUE(converted(withAComment).at<CObservationComment>(2));
}

/// Lasers of which a log states the scan time (s).
std::map<std::string, double> sweepsOf(const Log& log) { return replayed(log).summary.sweeps; }

TEST(RawlogLog, ScanTimesAreKeptOrSetInBothForms) {
  Log single = observations();
  single.insert(single.begin(), commentOf({"LASER", 0.025}, test::stamp(10)));
  const Log paired = converted(single, pairs()).log;
  for (const Log& log : {single, paired})
    for (LogConversionOptions options : {LogConversionOptions(), pairs()}) {
      EXPECT_THAT(sweepsOf(converted(log, options).log), ElementsAre(Pair("LASER", 0.025)));
      options.sweep.seconds = 0.05;
      const ConvertedRawlog set = converted(log, options);
      EXPECT_THAT(sweepsOf(set.log), ElementsAre(Pair("LASER", 0.05)));
      EXPECT_EQ(set.summary.wrongSweeps, 0u);
      options.sweep.seconds = 0;
      EXPECT_THAT(sweepsOf(converted(log, options).log), IsEmpty());
    }
}

TEST(RawlogLog, AMaximumRangeMakesNoReturns) {
  const Log single = observations();
  for (const Log& log : {single, converted(single, pairs()).log}) {
    LogConversionOptions options;
    options.maxRange = 4;
    const ConvertedRawlog out = converted(log, options);
    const auto seen = out.at<CObservation2DRangeScan>(1);
    EXPECT_EQ(seen->maxRange, 4);
    size_t valid = 0;
    for (size_t k = 0; k < seen->getScanSize(); ++k) {
      EXPECT_EQ(seen->getScanRangeValidity(k), seen->getScanRange(k) < 4);
      valid += seen->getScanRangeValidity(k);
    }
    EXPECT_GT(valid, 0u);
    EXPECT_LT(valid, seen->getScanSize());
    EXPECT_EQ(out.summary.ranges, 12 * 11u);
    EXPECT_GT(out.summary.rangesBeyond, 0u);
  }
}

TEST(RawlogLog, ACutOneIsConvertedUpToTheCutUnlessStrict) {
  const files::TemporaryFolder folder;
  std::vector<size_t> ends;
  const std::string whole = test::contentOf(test::writePlain(folder.path("whole"), observations(), &ends));
  const std::string cut = folder.write("cut", whole.substr(0, ends[11] + 40)),
                    out = folder.path("out.rawlog");
  LogConversionOptions strict;
  strict.strict = true;
  EXPECT_THAT(test::errorOf([&] { convert(cut, out, strict); }), HasSubstr("rawlog cut off"));
  EXPECT_FALSE(std::filesystem::exists(out));
  const LogSummary summary = convert(cut, out, {});
  EXPECT_EQ(summary.scans, 6u);
  EXPECT_THAT(summary.defect, HasSubstr("cut off"));
  EXPECT_TRUE(std::filesystem::exists(out));
}

TEST(RawlogLog, ReplacesAnEarlierRawlogOnly) {
  const files::TemporaryFolder folder;
  const std::string log = test::writePlain(folder.path("in.rawlog"), observations());
  const std::string text = folder.write("b.clf", "a second log of the user");
  EXPECT_THAT(test::errorOf([&] { convert(log, text, {}); }),
              HasSubstr("the output exists and is no rawlog: " + text));
  EXPECT_EQ(test::contentOf(text), "a second log of the user");
  convert(log, folder.write("empty.rawlog", ""), {});
  const std::string out = test::writePlain(folder.path("out.rawlog"), {scan(1)}),
                    before = test::contentOf(out);
  convert(log, out, {});
  EXPECT_NE(test::contentOf(out), before);
}

TEST(RawlogLog, NeverReplacesARecording) {
  const files::TemporaryFolder folder;
  const std::string log = test::writePlain(folder.path("in.rawlog"), observations());
  const std::string name = folder.path("recording-2026-11-26T10-00-00.rawlog");
  convert(log, name, {});
  const std::string before = test::contentOf(name);
  EXPECT_THAT(test::errorOf([&] { convert(log, name, pairs()); }),
              HasSubstr("the output would replace a recording: " + name));
  const std::string link = folder.path("latest.rawlog");
  std::filesystem::create_symlink(name, link);
  EXPECT_THAT(test::errorOf([&] { convert(log, link, pairs()); }),
              HasSubstr("the output would replace a recording: " + link));
  EXPECT_EQ(test::contentOf(name), before);
}

TEST(RawlogLog, AFailureLeavesNoFile) {
  const files::TemporaryFolder folder;
  const std::string log = test::writePlain(folder.path("in.rawlog"), observations()),
                    out = folder.path("out.rawlog");
  const std::string before = test::contentOf(log);
  EXPECT_THAT(test::errorOf([&] { convert(log, log, pairs()); }), HasSubstr("the output is the input"));
  EXPECT_EQ(test::contentOf(log), before);
  const std::string none = test::writePlain(folder.path("none.rawlog"), {odometry(1, {})});
  EXPECT_THAT(test::errorOf([&] { convert(none, out, {}); }), HasSubstr("no laser scans: " + none));
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_FALSE(std::filesystem::exists(folder.path(".partial.out.rawlog")));
}

}  // namespace
}  // namespace hybrid_slam::readings
