#include "run/SimpleMapFile.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>

#include <cmath>

#include "files/TemporaryFolder.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

TEST(SimpleMapFile, HasTheScansOfTheUpdatesAtTheirPoses) {
  const files::TemporaryFolder root;
  const files::OutputFolder folder(root.path("out"));
  const std::string log = test::writeGzipped(root.path("log"), test::laps(10));
  const readings::RawlogSummary summary = readings::summarise(log, {});
  readings::RawlogSource source(log, {}, summary);
  LogAgain again(log, {}, summary);

  std::vector<bool> isUpdate;
  std::vector<mrpt::math::TPose2D> path;
  std::vector<mrpt::obs::CObservation2DRangeScan::Ptr> scans;
  for (size_t i = 0; const auto reading = source.next(); ++i) {
    isUpdate.push_back(i % 3 == 1);
    if (!isUpdate.back()) continue;
    path.emplace_back(0.5 * static_cast<double>(i), -1, 0.1 * static_cast<double>(i));
    scans.push_back(reading->scans.at(0));
  }
  ASSERT_EQ(path.size(), 3u);
  saveSimpleMap(folder, again, isUpdate, path);

  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(folder.path("map.simplemap.gz")));
  ASSERT_EQ(map.size(), 3u);
  for (size_t i = 0; i < map.size(); ++i) {
    const auto pose = map.begin()[i].pose;
    const auto frame = map.begin()[i].sf;
    const mrpt::math::TPose2D error = mrpt::math::TPose2D(pose->getMeanVal().asTPose()) - path[i];
    EXPECT_LT(error.norm() + std::abs(error.phi), 1e-9);
    ASSERT_EQ(frame->size(), 1u);
    const auto scan = frame->getObservationByClass<mrpt::obs::CObservation2DRangeScan>();
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->timestamp, scans[i]->timestamp);
    EXPECT_EQ(scan->getScanSize(), 181u);
    EXPECT_EQ(scan->getScanRange(90), scans[i]->getScanRange(90));
  }
}

TEST(SimpleMapFile, OfNoScans) {
  const files::TemporaryFolder root;
  const std::string log = test::writeGzipped(root.path("log"), test::laps(2));
  LogAgain again(log, {}, readings::summarise(log, {}));
  saveSimpleMap(files::OutputFolder(root.path("out")), again, {}, {});
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(root.path("out/map.simplemap.gz")));
  EXPECT_EQ(map.size(), 0u);
}

}  // namespace
}  // namespace hybrid_slam::run
