/// Bags as a user reads them: the same drive as a rawlog and as the recordings of ROS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "Shell.h"
#include "files/TemporaryFolder.h"
#include "files/Trajectory.h"
#include "readings/LogReader.h"
#include "readings/RawlogSource.h"
#include "readings/Timestamps.h"
#include "testing/CompressedBytes.h"
#include "testing/RosBags.h"

namespace hybrid_slam {
namespace {

using bags::Encoding;
using testing::HasSubstr;
using testing::IsEmpty;

class Bags : public testing::Test {
 protected:
  test::Outcome run(const std::string& program, const std::string& arguments) {
    return test::shell(folder, "'" + program + "' " + arguments);
  }
  files::Trajectory mapped(const std::string& log) {
    const std::string out = folder.path("out-" + std::filesystem::path(log).filename().string());
    const test::Outcome outcome = run(HYBRID_SLAM, "'" + log + "' -q -s 1 -o '" + out + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return files::loadTum(out + "/trajectory.tum");
  }

  files::TemporaryFolder folder;
  /// The step between 129 beams is a 32-bit number without rounding.
  const test::Log drive = test::laps(60, 80, 129);
};

TEST_F(Bags, GiveTheTrajectoryOfTheRawlog) {
  const auto expected = mapped(test::writeGzipped(folder.path("drive.rawlog"), drive));
  ASSERT_EQ(expected.size(), 60u);
  const auto ros1 = test::messagesOf(drive, Encoding::ros1), ros2 = test::messagesOf(drive, Encoding::cdr);
  for (const std::string& log : {test::writeRosBag(folder.path("drive.bag"), ros1, rosbag::compression::LZ4),
                                 test::writeDatabase(folder.path("drive.db3"), ros2),
                                 test::writeMcap(folder.path("drive.mcap"), ros2)}) {
    const auto found = mapped(log);
    ASSERT_EQ(found.size(), expected.size()) << log;
    for (size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].timestamp, expected[i].timestamp, 1e-6);
      EXPECT_NEAR(found[i].pose.x, expected[i].pose.x, 1e-6) << log << " " << i;
      EXPECT_NEAR(found[i].pose.y, expected[i].pose.y, 1e-6);
      EXPECT_NEAR(found[i].pose.phi, expected[i].pose.phi, 1e-6);
    }
  }
}

/// The beams are corrected for the motion during the scan, also from the rawlog of log2rawlog.
TEST_F(Bags, TellTheTimeFromBeamToBeam) {
  const std::string bag = test::writeRosBag(folder.path("drive.bag"),
                                            test::messagesOf(drive, Encoding::ros1, 5e-4F)),
                    rawlog = folder.path("drive.rawlog"),
                    instant = test::writeRosBag(folder.path("instant.bag"),
                                                test::messagesOf(drive, Encoding::ros1));
  ASSERT_EQ(run(LOG2RAWLOG, "'" + bag + "' '" + rawlog + "'").status, 0);
  mapped(bag), mapped(rawlog), mapped(instant);
  const auto trajectory = [&](const std::string& log) {
    return test::contentOf(folder.path("out-" + log) + "/trajectory.tum");
  };
  EXPECT_EQ(trajectory("drive.rawlog"), trajectory("drive.bag"));
  EXPECT_NE(trajectory("instant.bag"), trajectory("drive.bag"));
  const std::string without = folder.path("without.rawlog");
  ASSERT_EQ(run(LOG2RAWLOG, "--scan-time 0 '" + bag + "' '" + without + "'").status, 0);
  mapped(without);
  EXPECT_EQ(trajectory("without.rawlog"), trajectory("instant.bag"));
  const test::Outcome outcome = run(HYBRID_SLAM, "'" + bag + "' -o '" + folder.path("out") + "'");
  EXPECT_THAT(outcome.out, HasSubstr("corrected for motion during its scans of 64.0 ms"));
}

/// Broken drivers or a clock set back cause such times.
TEST_F(Bags, AnImpossibleTimeFromBeamToBeamIsNotUsedWithAWarning) {
  for (const float timeStep : {-5e-4F, 1e7F}) {
    const std::string bag =
        test::writeRosBag(folder.path("odd.bag"), test::messagesOf(drive, Encoding::ros1, timeStep));
    const test::Outcome converted = run(LOG2RAWLOG, "'" + bag + "' '" + folder.path("odd.rawlog") + "'");
    EXPECT_EQ(converted.status, 0);
    EXPECT_THAT(converted.err, HasSubstr("60 scans with an impossible time from beam to beam"));
    const test::Outcome outcome =
        run(HYBRID_SLAM, "'" + bag + "' --overwrite -o '" + folder.path("odd") + "'");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr("below 0 or over 1 s"));
    EXPECT_THAT(outcome.out, testing::Not(HasSubstr("corrected for motion")));
  }
}

/// The angles of 181 beams round. The objects of the bag still equal those of the rawlog.
TEST_F(Bags, GiveTheObjectsOfTheRawlog) {
  const test::Log log = test::laps(20);
  readings::LogReader reader(
      test::writeRosBag(folder.path("drive.bag"), test::messagesOf(log, Encoding::ros1)));
  for (const auto& expected : log) {
    const auto object = reader.next();
    if (const auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(expected)) {
      const auto found = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(object);
      ASSERT_TRUE(found);
      EXPECT_NEAR((found->odometry - odometry->odometry).norm(), 0, 1e-12);
      EXPECT_NEAR(found->odometry.phi(), odometry->odometry.phi(), 1e-12);
    } else {
      const auto& scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*expected);
      const auto found = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(object);
      ASSERT_TRUE(found);
      EXPECT_NEAR(readings::seconds(found->timestamp), readings::seconds(scan.timestamp), 1e-6);
      EXPECT_NEAR(found->aperture, scan.aperture, 1e-6);
      EXPECT_NEAR(found->sensorPose.yaw(), 0, 1e-6);
      EXPECT_EQ(found->maxRange, scan.maxRange);
      ASSERT_EQ(found->getScanSize(), scan.getScanSize());
      for (size_t i = 0; i < scan.getScanSize(); ++i) ASSERT_EQ(found->getScanRange(i), scan.getScanRange(i));
    }
  }
  EXPECT_FALSE(reader.next());
}

TEST_F(Bags, CompressedOnesGiveTheSameRawlog) {
  const auto rawlogOf = [&](const std::string& bag) {
    const std::string rawlog = folder.path("out.rawlog");
    std::filesystem::remove(rawlog);
    const test::Outcome outcome = run(LOG2RAWLOG, "'" + bag + "' '" + rawlog + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return test::contentOf(rawlog);
  };
  const auto ros1 = test::messagesOf(drive, Encoding::ros1), ros2 = test::messagesOf(drive, Encoding::cdr);
  for (const std::string& bag : {test::writeRosBag(folder.path("drive.bag"), ros1),
                                 test::writeDatabase(folder.path("drive.db3"), ros2),
                                 test::writeMcap(folder.path("drive.mcap"), ros2)}) {
    const std::string expected = rawlogOf(bag);
    EXPECT_THAT(expected, testing::Not(IsEmpty()));
    for (const files::Compression compression : test::kCompressions) {
      const std::string packed = folder.write("packed", test::compressed(compression, test::contentOf(bag)));
      EXPECT_EQ(rawlogOf(packed), expected) << bag << " " << files::nameOf(compression);
    }
  }
}

TEST_F(Bags, ListsTheirTopics) {
  const std::string bag =
      test::writeRosBag(folder.path("drive.bag"), test::messagesOf(drive, Encoding::ros1));
  for (const char* program : {LOG2RAWLOG, HYBRID_SLAM}) {
    const test::Outcome outcome = run(program, "--list '" + bag + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "       60  /odom  nav_msgs/Odometry\n       60  /scan  sensor_msgs/LaserScan\n");
  }
}

TEST_F(Bags, AreConvertedWithTheTopicsThatAreChosen) {
  auto messages = test::messagesOf(drive, Encoding::cdr);
  for (size_t i = 0; i < 20; ++i) {
    test::TestMessage other = messages[2 * i + 1];
    other.topic = "/other";
    messages.push_back(other);
  }
  const std::string bag = test::writeMcap(folder.path("drive.mcap"), messages),
                    rawlog = folder.path("out.rawlog");
  const std::string files = "'" + bag + "' '" + rawlog + "'";
  test::expectInputError(run(LOG2RAWLOG, files), "log2rawlog",
                         "several scan topics: " + bag + "; choose with --topic or [input] sensor_label: ");
  EXPECT_FALSE(std::filesystem::exists(rawlog));
  test::expectInputError(run(HYBRID_SLAM, "'" + bag + "'"), "hybrid-slam", "--topic");
  const std::string ignored = "warning: laser `/other` is not used: not in --topic or [input] sensor_label\n";
  const test::Outcome outcome = run(LOG2RAWLOG, "--topic /scan " + files);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "log2rawlog: " + ignored);
  EXPECT_THAT(outcome.out, HasSubstr("out.rawlog: MCAP file, 60 scans, 60 odometry readings, 11.8 s, path "));
  const test::Outcome mapped =
      run(HYBRID_SLAM, "--topic /scan -q -o '" + folder.path("out") + "' '" + bag + "'");
  EXPECT_EQ(mapped.status, 0);
  EXPECT_THAT(mapped.err, HasSubstr("hybrid-slam: " + ignored));
  EXPECT_EQ(mapped.err.find(ignored), mapped.err.rfind(ignored)) << "once";
}

TEST_F(Bags, CutOnesAreConvertedUpToTheCutUnlessStrict) {
  const std::string bag = test::writeMcap(folder.path("drive.mcap"), test::messagesOf(drive, Encoding::cdr));
  const std::string bytes = test::contentOf(bag), rawlog = folder.path("out.rawlog");
  test::write(bag, bytes.substr(0, bytes.size() / 2));
  const std::string files = "'" + bag + "' '" + rawlog + "'";
  test::expectInputError(run(LOG2RAWLOG, "--strict " + files), "log2rawlog", "cut off");
  EXPECT_FALSE(std::filesystem::exists(rawlog));
  const test::Outcome outcome = run(LOG2RAWLOG, files);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err,
              HasSubstr("cut off in the middle of a record: " + bag + "; converted up to this point"));
}

TEST_F(Bags, WrongFilesAreOneError) {
  const std::string odometry = test::writeDatabase(
      folder.path("odometry.db3"),
      {{"/odom", "nav_msgs/Odometry", 1, test::odometryBytes(test::MessageBytes(Encoding::cdr), 1, {})}});
  test::expectInputError(run(HYBRID_SLAM, "'" + odometry + "'"), "hybrid-slam",
                         "no laser scans: " + odometry);
  test::expectInputError(run(LOG2RAWLOG, "--list '" + folder.write("text", "abc") + "'"), "log2rawlog",
                         "not a bag: ");
  test::expectInputError(run(LOG2RAWLOG, "'" + folder.write("a.bag", "#ROSBAG V2.0\nabc") + "' '" +
                                             folder.path("out.rawlog") + "'"),
                         "log2rawlog", "cut off");
}

std::string recorded(const std::string& name) { return std::string(RECORDED) + "/" + name; }

/// The numbers were read from the bytes by hand: three whole scans of 681 beams, then the cut.
TEST_F(Bags, RecordedByRos1) {
  const std::string rawlog = folder.path("scan_tools.rawlog");
  const test::Outcome outcome = run(LOG2RAWLOG, "'" + recorded("scan_tools.bag") + "' '" + rawlog + "'");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("cut off in the middle of a record"));
  EXPECT_THAT(outcome.out, HasSubstr("3 scans, 0 odometry readings, 0.2 s"));
  readings::InputOptions input;
  input.requireOdometry = false;
  readings::RawlogSource source(rawlog, input, readings::summarise(rawlog, input));
  const auto first = source.next();
  ASSERT_TRUE(first && first->scans.size() == 1);
  const auto& scan = *first->scans[0];
  EXPECT_NEAR(first->timestamp, 1282836370.970876, 1e-6);
  ASSERT_EQ(scan.getScanSize(), 681u);
  EXPECT_EQ(scan.getScanRange(0), 3.002F);
  EXPECT_EQ(scan.getScanRange(340), 0.942F);
  EXPECT_NEAR(scan.aperture, 2 * 2.0862138, 1e-6);
  size_t more = 0;
  while (source.next()) ++more;
  EXPECT_EQ(more, 2u);
}

/// What is written to the folder of a recording does not change the recording.
TEST_F(Bags, MayHaveTheirRawlogInTheirFolder) {
  std::filesystem::create_directory(folder.path("drive"));
  test::writeDatabase(folder.path("drive/drive_0.db3"), test::messagesOf(drive, Encoding::cdr));
  const std::string recording = "'" + folder.path("drive") + "' ";
  const test::Outcome converted = run(LOG2RAWLOG, recording + "'" + folder.path("drive/out.rawlog") + "'");
  EXPECT_EQ(converted.status, 0) << converted.err;
}

/// The counts are those of rosbag2's metadata.yaml.
TEST_F(Bags, RecordedByRos2) {
  for (const std::string name : {"talker.db3", "talker.mcap"}) {
    const test::Outcome outcome = run(LOG2RAWLOG, "--list '" + recorded(name) + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out,
              "        0  /parameter_events  rcl_interfaces/msg/ParameterEvent\n"
              "       10  /rosout  rcl_interfaces/msg/Log\n"
              "       10  /topic  std_msgs/msg/String\n");
    test::expectInputError(run(LOG2RAWLOG, "'" + recorded(name) + "' '" + folder.path("a.rawlog") + "'"),
                           "log2rawlog", "no laser scans");
  }
}

}  // namespace
}  // namespace hybrid_slam
