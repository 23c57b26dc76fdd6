#include "files/RawlogWriter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"

namespace hybrid_slam::files {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservationOdometry;

CObservationOdometry odometry(double x) {
  CObservationOdometry observation;
  observation.odometry = {x, 0, 0};
  return observation;
}

TEST(RawlogWriter, WritesFilesThatMrptReads) {
  const TemporaryFolder folder;
  RawlogWriter writer(folder.path("out.rawlog"));
  for (int i = 0; i < 1000; ++i) writer.write(odometry(i));
  writer.finish();
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(folder.path("out.rawlog")));
  ASSERT_EQ(rawlog.size(), 1000u);
  for (size_t i = 0; i < 1000; ++i)
    EXPECT_EQ(rawlog.asObservation<CObservationOdometry>(i)->odometry.x(), static_cast<double>(i));
}

TEST(RawlogWriter, GetsItsNameWhenFinished) {
  const TemporaryFolder folder;
  const std::string path = folder.write("out.rawlog", "the old one"),
                    partial = folder.path(".partial.out.rawlog");
  {
    RawlogWriter writer(path);
    writer.write(odometry(1));
    EXPECT_TRUE(fs::exists(partial));
  }
  EXPECT_FALSE(fs::exists(partial));
  EXPECT_EQ(fs::file_size(path), 11u);
  RawlogWriter writer(path);
  writer.write(odometry(1));
  writer.finish();
  EXPECT_FALSE(fs::exists(partial));
  EXPECT_NE(fs::file_size(path), 11u);
}

TEST(RawlogWriter, AnUnwritableFileIsAnError) {
  const TemporaryFolder folder;
  EXPECT_THROW(RawlogWriter(folder.path("none/out.rawlog")), InputError);
  EXPECT_THROW(RawlogWriter(folder.path("")), InputError);
  EXPECT_THROW(RawlogWriter("/dev/full"), InputError);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

}  // namespace
}  // namespace hybrid_slam::files
