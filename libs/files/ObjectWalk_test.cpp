#include "files/ObjectWalk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationBatteryState.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussianInf.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/poses/CPosePDFSOG.h>

#include <vector>

#include "base/RandomStream.h"
#include "files/ObjectReader.h"
#include "testing/Restricted.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::files {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::serialization::CSerializable;
using testing::HasSubstr;

std::string bytesOf(const CSerializable::Ptr& object) {
  std::vector<uint8_t> bytes;
  mrpt::serialization::ObjectToOctetVector(object.get(), bytes);
  return {bytes.begin(), bytes.end()};
}

/// Makes random objects of the listed classes.
class Objects {
 public:
  explicit Objects(uint64_t seed) : random_(seed, 0, 0) {}

  CSerializable::Ptr any() {
    switch (below(9)) {
      case 0:
        return scan();
      case 1:
        return odometry();
      case 2:
        return actions();
      case 3:
        return frame();
      case 4:
        return imu();
      case 5:
        return battery();
      case 6:
        return range();
      case 7:
        return robotPose();
      default:
        return comment();
    }
  }

 private:
  size_t below(size_t n) { return static_cast<size_t>(random_.bits() % n); }
  bool coin() { return below(2) == 1; }
  double number() { return 20 * random_.uniform() - 10; }
  std::string text() {
    std::string out(below(30), ' ');
    for (char& c : out) c = static_cast<char>(random_.bits());
    return out;
  }
  mrpt::poses::CPose2D pose2D() { return {number(), number(), number()}; }
  mrpt::poses::CPose3D pose3D() { return {number(), number(), number(), number(), number(), number()}; }

  CSerializable::Ptr scan() {
    auto out = test::scan(number(), {number() / 10, 0, number()}, below(200), text());
    out->sensorPose = pose3D();
    if (out->getScanSize() > 0) out->setScanHasIntensity(coin());  // MRPT would not write an empty one
    return out;
  }
  CSerializable::Ptr odometry() {
    auto out = test::odometry(number(), {number(), number(), number()});
    out->hasEncodersInfo = coin(), out->hasVelocities = coin();
    out->sensorLabel = text();
    return out;
  }
  CSerializable::Ptr imu() {
    auto out = mrpt::obs::CObservationIMU::Create();
    for (size_t i = 0; i < out->dataIsPresent.size(); ++i)
      if (coin()) out->set(static_cast<mrpt::obs::TIMUDataIndex>(i), number());
    out->sensorLabel = text(), out->sensorPose = pose3D();
    return out;
  }
  CSerializable::Ptr battery() {
    auto out = mrpt::obs::CObservationBatteryState::Create();
    const size_t n = below(5);
    out->voltageOtherBatteries.resize(n), out->voltageOtherBatteriesValid.resize(n, coin());
    out->sensorLabel = text();
    return out;
  }
  CSerializable::Ptr range() {
    auto out = mrpt::obs::CObservationRange::Create();
    out->sensedData.resize(below(20));
    return out;
  }
  CSerializable::Ptr robotPose() {
    auto out = mrpt::obs::CObservationRobotPose::Create();
    out->pose.mean = pose3D(), out->sensorPose = pose3D();
    return out;
  }
  CSerializable::Ptr comment() {
    auto out = mrpt::obs::CObservationComment::Create();
    out->text = text();
    return out;
  }
  mrpt::poses::CPosePDF::Ptr pdf() {
    switch (below(4)) {
      case 0:
        return mrpt::poses::CPosePDFGaussian::Create(pose2D());
      case 1:
        return mrpt::poses::CPosePDFGaussianInf::Create(pose2D());
      case 2: {
        auto out = mrpt::poses::CPosePDFParticles::Create();
        out->resetDeterministic({number(), number(), number()}, 1 + below(20));
        return out;
      }
      default:
        return mrpt::poses::CPosePDFSOG::Create(1 + below(5));
    }
  }
  CSerializable::Ptr actions() {
    auto out = mrpt::obs::CActionCollection::Create();
    for (size_t n = below(4); n > 0; --n) {
      if (below(4) == 0) {
        mrpt::obs::CActionRobotMovement3D spatial;
        spatial.poseChange.mean = pose3D();
        out->insert(spatial);
        continue;
      }
      mrpt::obs::CActionRobotMovement2D flat;
      mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
      model.modelSelection =
          coin() ? mrpt::obs::CActionRobotMovement2D::mmThrun : mrpt::obs::CActionRobotMovement2D::mmGaussian;
      if (coin())
        flat.computeFromOdometry(pose2D(), model);
      else
        flat.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching, flat.poseChange = pdf();
      flat.hasVelocities = coin(), flat.hasEncodersInfo = coin();
      out->insert(flat);
    }
    return out;
  }
  CSerializable::Ptr frame() {
    auto out = mrpt::obs::CSensoryFrame::Create();
    for (size_t n = below(4); n > 0; --n) {
      const auto inside = coin() ? scan() : coin() ? imu() : odometry();
      out->insert(std::dynamic_pointer_cast<mrpt::obs::CObservation>(inside));
    }
    return out;
  }

  RandomStream random_;
};

/// Returns why the bytes are rejected, or "" and their length.
std::string walked(const std::string& bytes, size_t* length = nullptr) {
  ObjectBytes in(bytes);
  ObjectWalk walk(in, false);
  try {
    walk.entry();
    if (length) *length = walk.at();
    return "";
  } catch (const ObjectError& e) {
    return e.what();
  }
}

/// MRPT 2.5.8 writes version 0, MRPT 2.14 version 1, which ends with a label.
TEST(ObjectWalk, ReadsCommentsOfBothVersions) {
  const auto number = [](uint32_t n) { return std::string(reinterpret_cast<const char*>(&n), sizeof n); };
  const auto comment = [&](char version) {
    const std::string name = "mrpt::obs::CObservationComment";
    return static_cast<char>(0x80 | name.size()) + name + version + number(2) + "hi" + std::string(8, '\1') +
           (version == 0 ? "" : number(5) + "LASER") + static_cast<char>(0x88);
  };
  for (const char version : {'\0', '\1'}) EXPECT_EQ(walked(comment(version)), "") << int{version};
  EXPECT_EQ(walked(comment(2)), "mrpt::obs::CObservationComment of unknown version 2");
}

TEST(ObjectWalk, AcceptsWhatMrptWritesToTheLastByte) {
  Objects objects(1);
  for (int i = 0; i < 2000; ++i) {
    const std::string bytes = bytesOf(objects.any());
    size_t length = 0;
    ASSERT_EQ(walked(bytes + "more", &length), "") << bytes.substr(1, 40);
    ASSERT_EQ(length, bytes.size());
    ASSERT_EQ(walked(bytes.substr(0, bytes.size() - 1 - static_cast<size_t>(i) % bytes.size())),
              "cut off in the middle of an object");
  }
}

TEST(ObjectWalk, MrptReadsWhatItAcceptsOrThrows) {
  Objects objects(2);
  RandomStream random(3, 0, 0);
  size_t accepted = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string bytes = bytesOf(objects.any());
    for (uint64_t changes = 1 + random.bits() % 4; changes > 0; --changes)
      bytes[random.bits() % bytes.size()] = static_cast<char>(random.bits());
    size_t length = 0;
    if (!walked(bytes, &length).empty()) continue;
    ++accepted;
    try {
      buildObject(bytes.substr(0, length));
    } catch (const ObjectError& e) {
      ADD_FAILURE() << "MRPT reads other fields: " << e.what() << ": " << bytes.substr(1, 40);
    } catch (const std::exception&) {
    }
  }
  EXPECT_GT(accepted, 1000u);
}

std::string header(const std::string& name, char version) {
  return static_cast<char>(0x80 | name.size()) + name + version;
}

size_t peakKilobytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<size_t>(used.ru_maxrss);
}

TEST(ObjectWalk, AClaimedLengthTakesNoMemory) {
  const std::string pose = bytesOf(mrpt::poses::CPose3D::Create());
  const std::string count("\xff\xff\xff\xff", 4), many("\0\0\0\x07", 4);
  const size_t before = peakKilobytes();
  for (const std::string& n : {count, many})
    for (const std::string& bytes :
         {header("CObservation2DRangeScan", 7) + std::string("\0\0\0\0\1\0\0\0\0", 9) + pose + n + "few",
          header("CSensoryFrame", 2) + n + "few", header("CActionCollection", 0) + n + "few",
          header("CObservationComment", 0) + n + "few"}) {
      EXPECT_THAT(walked(bytes), testing::AnyOf(HasSubstr("cut off"), HasSubstr("more than 64 MiB")));
    }
  EXPECT_LT(peakKilobytes() - before, 4000u);
}

TEST(ObjectWalk, ALengthThatTheBytesDoNotHaveIsNotReadAheadForFromAStream) {
  size_t asked = 0;
  const std::string bytes = header("CObservationComment", 0) + std::string("\0\0\0\x03", 4);
  ObjectBytes in([&](char* to, size_t n) {
    asked += n;
    return bytes.copy(to, asked == n ? n : 0);
  });
  ObjectWalk walk(in, false);
  EXPECT_THROW(walk.entry(), ObjectCut);
  EXPECT_LE(asked, 20000u);
}

TEST(ObjectWalk, NestingIsBounded) {
  std::string frames, actions;
  for (int i = 0; i < 5000; ++i) {
    frames += header("CSensoryFrame", 2) + std::string("\1\0\0\0", 4);
    actions += header("CActionCollection", 0) + std::string("\1\0\0\0", 4);
  }
  frames += std::string(20, ' '), actions += std::string(20, ' ');
  EXPECT_THAT(walked(frames), HasSubstr("CSensoryFrame instead of an observation"));
  EXPECT_THAT(walked(actions), HasSubstr("CActionCollection instead of an action"));
}

/// Builds the scan as RawlogReader does.
CObservation2DRangeScan::Ptr built(const std::string& bytes) {
  ObjectBytes in(bytes);
  ObjectWalk walk(in, false);
  walk.entry();
  return std::dynamic_pointer_cast<CObservation2DRangeScan>(buildObject(walk.rest()));
}

TEST(ObjectWalk, OnlyListedClassesAndTheirValues) {
  EXPECT_THAT(walked(header("mrpt::maps::CSimpleMap", 1) + "x"), HasSubstr("class mrpt::maps::CSimpleMap"));
  EXPECT_THAT(walked(header("CObservationImage", 4) + "x"), HasSubstr("class CObservationImage"));
  const std::string scan = bytesOf(test::scan(1));
  std::string wrong = scan;
  wrong[scan.find("RangeScan") + 9 + 1 + 4] = 2;  // rightToLeft
  EXPECT_EQ(built(wrong)->rightToLeft, true) << "a byte that is no bool";
  wrong = scan;
  wrong.back() = 0;
  EXPECT_THAT(walked(wrong), HasSubstr("without its end"));
}

TEST(ObjectWalk, LabelsAreBoundedBecauseTheyAreKept) {
  for (const size_t length : {kLongestLabel, kLongestLabel + 1, size_t{1} << 20}) {
    const std::string label(length, 'x');
    const auto odometry = test::odometry(1, {});
    odometry->sensorLabel = label;
    for (const CSerializable::Ptr& object :
         {CSerializable::Ptr(test::scan(1, {}, 3, label)), CSerializable::Ptr(odometry)})
      EXPECT_EQ(walked(bytesOf(object)),
                length <= kLongestLabel ? "" : "a label of more than 1000 characters");
  }
  const auto comment = mrpt::obs::CObservationComment::Create();
  comment->text = std::string(1 << 20, 'x');
  EXPECT_EQ(walked(bytesOf(comment)), "") << "a text is no label";
}

TEST(ObjectWalk, AnEstimationMethodThatMrptDoesNotKnowIsAnError) {
  std::string bytes = bytesOf(test::action({1, 0, 0}));
  const std::string name = "CActionRobotMovement2D";
  bytes[bytes.find(name) + name.size() + 1 + 1] = '\xfe';
  EXPECT_THAT(walked(bytes), HasSubstr("unknown estimation method"));
}

TEST(ObjectWalk, AnObjectHasAtMost64Mebibytes) {
  const auto comment = mrpt::obs::CObservationComment::Create();
  for (const size_t size : {ObjectWalk::kMostBytes - 1000, ObjectWalk::kMostBytes}) {
    comment->text = std::string(size, 'x');
    EXPECT_EQ(walked(bytesOf(comment)), size < ObjectWalk::kMostBytes ? "" : "an object of more than 64 MiB");
  }
}

TEST(ObjectWalk, AScanHasAtMost2To20Beams) {
  for (const size_t beams : {size_t{1} << 20, (size_t{1} << 20) + 1}) {
    const auto scan = CObservation2DRangeScan::Create();
    scan->resizeScan(beams);
    const std::string bytes = bytesOf(scan);
    EXPECT_EQ(walked(bytes).find("2^20 beams") != std::string::npos, beams > size_t{1} << 20);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they reserve address space
// MRPT's allocator returns a null pointer then, and its scan writes to it.
TEST(ObjectReader, WithoutMemoryNoObjectIsBuilt) {
  const auto scan = CObservation2DRangeScan::Create();
  scan->resizeScan(size_t{1} << 20);
  const std::string bytes = bytesOf(scan);
  EXPECT_TRUE(test::throwsWithoutMemory([&] { buildObject(bytes); }));
}
#endif

TEST(ObjectWalk, CountsThatCostTimeAreBounded) {
  for (const char rows : {'\xe8', '\xe9'})  // 1000 and 1001
    EXPECT_THAT(
        walked(header("CObservation2DRangeScan", 7) + std::string("\0\0\0\0\1\0\0\0\0", 9) +
               header("CPose3D", 1) + header("CMatrixD", 0) + rows + std::string("\3\0\0\0\0\0\0", 7)),
        rows == '\xe8' ? HasSubstr("cut off") : HasSubstr("a matrix of more than 1000 rows"));
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  for (const uint32_t particles : {10000u, 10001u}) {
    model.thrunModel.nParticlesCount = particles;
    mrpt::obs::CActionRobotMovement2D movement;
    movement.computeFromOdometry({1, 0, 0}, model);
    const auto actions = mrpt::obs::CActionCollection::Create();
    actions->insert(movement);
    EXPECT_EQ(walked(bytesOf(actions)),
              particles == 10000 ? "" : "a motion model of more than 10000 particles");
  }
}

TEST(ObjectWalk, OldLogsHaveFourByteHeadersAndNoEndFlags) {
  const auto old = [](const std::string& name, char version) {
    return std::string(1, static_cast<char>(name.size())) + std::string(3, '\0') + name + version +
           std::string(3, '\0');
  };
  const std::string bytes =
      old("CObservationOdometry", 0) + old("CPose2D", 0) + std::string(12, '\0') + std::string(4 + 8, '\0');
  size_t length = 0;
  EXPECT_EQ(walked(bytes, &length), "");
  EXPECT_EQ(length, bytes.size());
  EXPECT_TRUE(buildObject(bytes));
}

}  // namespace
}  // namespace hybrid_slam::files
