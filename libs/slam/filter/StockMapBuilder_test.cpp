#include "slam/filter/StockMapBuilder.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/random/RandomGenerators.h>
#include <tbb/global_control.h>

#include <cstring>
#include <filesystem>
#include <iterator>
#include <string>
#include <thread>
#include <tuple>

#include "base/Errors.h"
#include "testing/TestRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

FilterConfiguration configuration() {
  FilterConfiguration c = test::roomConfiguration();
  c.filter.particles = 5;
  c.filter.updateDistance = 0.4;
  c.filter.updateAngle = 25 * kDegree;
  c.grid.resolution = 0.1;
  return c;
}

auto construction() { return stockOptions(configuration().filter, configuration().grid); }

TEST(MrptRandomGenerator, EachThreadHasItsOwn) {
  using mrpt::random::getRandomGenerator;
  getRandomGenerator().randomize(1);
  const auto expected = mrpt::random::CRandomGenerator(1).drawUniform32bit();
  auto* other = &getRandomGenerator();
  std::thread([&] {
    other = &getRandomGenerator();
    other->randomize(2);
  }).join();
  EXPECT_NE(other, &getRandomGenerator());
  EXPECT_EQ(getRandomGenerator().drawUniform32bit(), expected) << "seeding in another thread changed nothing";
}

TEST(StockMapBuilder, TakesOurSettings) {
  FilterConfiguration c = configuration();
  c.filter.essThreshold = 0.75;
  c.filter.resampling = mrpt::bayes::CParticleFilter::prStratified;
  const auto options = stockOptions(c.filter, c.grid);
  EXPECT_EQ(options.PF_options.PF_algorithm, mrpt::bayes::CParticleFilter::pfStandardProposal);
  EXPECT_EQ(options.PF_options.resamplingMethod, mrpt::bayes::CParticleFilter::prStratified);
  EXPECT_EQ(options.PF_options.sampleSize, 5u);
  EXPECT_NEAR(options.PF_options.BETA, 0.75, 1e-6);
  EXPECT_NEAR(options.insertionLinDistance, 0.4, 1e-6);
  EXPECT_NEAR(options.localizeLinDistance, 0.4, 1e-6);
  EXPECT_NEAR(options.insertionAngDistance, 25 * kDegree, 1e-6);
  EXPECT_NEAR(options.localizeAngDistance, 25 * kDegree, 1e-6);
}

/// MRPT takes them as they are, and crashes or fills the memory.
TEST(StockMapBuilder, NumbersThatMrptDoesNotCheckAreRefused) {
  const std::string s = "MappingApplication", map = s + "_occupancyGrid_00_creationOpts";
  const std::tuple<std::string, std::string, std::string> wrong[] = {
      {s, "sampleSize", "0"},    {s, "sampleSize", "-1"},     {s, "occupancyGrid_count", "-1"},
      {map, "resolution", "0"},  {map, "resolution", "1e9"},  {map, "resolution", "nan"},
      {map, "resolution", "-1"}, {map, "resolution", "1e-9"}, {map, "max_x", "1e9"}};
  for (const auto& [section, key, value] : wrong) {
    mrpt::config::CConfigFileMemory ini;
    ini.write(s, "sampleSize", 5);
    ini.write(s, "occupancyGrid_count", 1);
    ini.write(map, "resolution", 0.1);
    ini.write(section, key, value);
    try {
      stockOptions(ini);
      ADD_FAILURE() << key << " = " << value;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("section [" + section + "], key `" + key + "`"), std::string::npos)
          << e.what();
    }
  }
}

TEST(StockMapBuilder, CanBeQueriedBeforeTheFirstScan) {
  const StockMapBuilder builder(construction(), MotionModelOptions(), 1);
  EXPECT_EQ(builder.updates(), 0u);
  EXPECT_TRUE(builder.bestPath().empty());
  EXPECT_EQ(builder.particlePoses().size(), 5u);
  EXPECT_TRUE(builder.bestLines().empty());
}

TEST(StockMapBuilder, MapsTheRoomThroughTheSameInterface) {
  StockMapBuilder builder(construction(), MotionModelOptions(), 1);
  const test::Replayed replayed = feed(builder, builder, test::drive(2));
  const auto path = builder.bestPath();
  ASSERT_GT(builder.updates(), 10u);
  ASSERT_EQ(replayed.truth.size(), builder.updates());
  ASSERT_EQ(path.size(), builder.updates());
  EXPECT_EQ(builder.lastStep().particles, 5u);
  EXPECT_FALSE(builder.lastStep().resampled);
  EXPECT_GT(builder.lastStep().ess, 0);
  EXPECT_LE(builder.lastStep().ess, 1);
  // Its five particles are about as accurate as the poor odometry.
  EXPECT_LT(test::rms(path, replayed.truth), 1.5 * test::rms(replayed.odometry, replayed.truth));
  for (size_t i = 1; i < path.size(); ++i)
    EXPECT_LT(std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y), 1) << i;

  const auto grid = builder.bestGrid();
  EXPECT_NEAR(grid.getResolution(), 0.1, 1e-6);
  EXPECT_GT(grid.getPos(3, 1), 0.5);  // free where the robot drove
  EXPECT_LT(grid.getXMin(), -2);      // behind the robot's start
  size_t occupied = 0;
  for (const auto cell : grid.getRawMap()) occupied += cell < 0;
  EXPECT_GT(occupied, 300u);  // 39 m of walls in cells of 0.1 m
}

TEST(StockMapBuilder, EndsBeforeItsMapsFillTheMemory) {
  const auto steps = test::drive(2);
  StockMapBuilder builder(construction(), MotionModelOptions(), 1, 1.9e6);
  EXPECT_THROW(feed(builder, builder, steps), std::runtime_error);
  EXPECT_GT(builder.updates(), 0u);
  EXPECT_LT(builder.updates(), steps.size());
  EXPECT_EQ(builder.bestPath().size(), builder.updates()) << "what it has done is there";
}

TEST(StockMapBuilder, DrawsFromItsOwnGenerator) {
  const auto steps = test::drive(1);
  StockMapBuilder alone(construction(), MotionModelOptions(), 1);
  feed(alone, alone, steps);
  StockMapBuilder builder(construction(), MotionModelOptions(), 1),
      beside(construction(), MotionModelOptions(), 2);
  for (const test::DriveStep& step : steps) {
    std::thread([&] { feed(builder, step); }).join();
    feed(beside, step);
  }
  EXPECT_EQ(builder.bestPath(), alone.bestPath());
  EXPECT_NE(beside.bestPath(), alone.bestPath());
}

TEST(StockMapBuilder, GivesTheThreadsGeneratorBackIfMrptFails) {
  auto options = construction();
  const int unknown = 77;  // no value that a cast may give
  std::memcpy(&options.PF_options.PF_algorithm, &unknown, sizeof unknown);
  StockMapBuilder builder(options, MotionModelOptions(), 2);
  const auto steps = test::drive(1);
  mrpt::random::getRandomGenerator().randomize(1);
  EXPECT_THROW(feed(builder, builder, steps), std::exception);
  EXPECT_EQ(mrpt::random::getRandomGenerator().drawUniform32bit(),
            mrpt::random::CRandomGenerator(1).drawUniform32bit());
}

/// MRPT 2.14.7 weighs the particles on all cores.
TEST(StockMapBuilder, StartsNoThreads) {
  const tbb::global_control manyThreads(tbb::global_control::max_allowed_parallelism, 4);
  const auto threads = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
  };
  const auto before = threads();
  StockMapBuilder builder(construction(), MotionModelOptions(), 1);
  feed(builder, builder, test::drive(1));
  EXPECT_LE(threads(), before);
}

}  // namespace
}  // namespace hybrid_slam
