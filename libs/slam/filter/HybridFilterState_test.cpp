#include <gtest/gtest.h>

#include "base/State.h"
#include "slam/filter/HybridFilter.h"
#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

using Drive = std::vector<DrivenPose>;

std::string bytesOf(HybridFilter& filter) {
  std::string bytes;
  StateWriter out(bytes);
  filter.save(out);
  return bytes;
}

void read(HybridFilter& filter, const std::string& bytes) {
  StateReader in(bytes);
  filter.load(in);
  EXPECT_TRUE(in.isAtEnd());
}

void process(HybridFilter& filter, const Drive& drive, size_t from, size_t to) {
  for (size_t i = from; i < to; ++i) filter.process(drive[i].motion, observed(drive[i].scans[0]));
}

FilterConfiguration configuration(ParticleFilterOptions::Proposal proposal) {
  FilterConfiguration c;
  c.filter.proposal = proposal;
  c.filter.minParticles = 4, c.filter.maxParticles = 8;
  return c;
}

/// Loads the state after `step` poses into another filter, and expects the same end from both.
void expectSameEnd(const FilterConfiguration& c, const Drive& drive, size_t step) {
  HybridFilter whole(c), first(c), second(c);
  process(whole, drive, 0, drive.size());
  process(first, drive, 0, step);
  read(second, bytesOf(first));
  EXPECT_EQ(bytesOf(second), bytesOf(first));
  process(second, drive, step, drive.size());
  EXPECT_EQ(second.bestPath(), whole.bestPath());
  EXPECT_TRUE(bytesOf(second) == bytesOf(whole)) << "after " << step;
}

TEST(HybridFilterState, AFilterThatIsReadGoesOnToTheSameBytes) {
  Drive drive = ringDrive(0.03 * kDegree);
  drive.resize(150);
  for (const size_t step : {0, 1, 60, 149})
    expectSameEnd(configuration(ParticleFilterOptions::Proposal::improved), drive, step);
  expectSameEnd(configuration(ParticleFilterOptions::Proposal::standard), drive, 60);
  FilterConfiguration withoutLines = configuration(ParticleFilterOptions::Proposal::standard);
  withoutLines.useLines = false, withoutLines.loopClosing.enabled = false;
  expectSameEnd(withoutLines, drive, 60);
  for (const auto proposal :
       {ParticleFilterOptions::Proposal::improved, ParticleFilterOptions::Proposal::standard}) {
    FilterConfiguration withFeatures = configuration(proposal);
    withFeatures.features.enabled = true;
    expectSameEnd(withFeatures, drive, 60);
  }
  FilterConfiguration withoutGrids = configuration(ParticleFilterOptions::Proposal::improved);
  withoutGrids.useGrid = false;
  expectSameEnd(withoutGrids, drive, 60);
}

// Off, the other keys of [features] do not matter: the state is that of a filter without the section.
TEST(HybridFilterState, FeaturesThatAreOffChangeNoByte) {
  Drive drive = ringDrive(0.03 * kDegree);
  drive.resize(60);
  for (const auto proposal :
       {ParticleFilterOptions::Proposal::improved, ParticleFilterOptions::Proposal::standard}) {
    const FilterConfiguration plain = configuration(proposal);
    EXPECT_FALSE(plain.features.enabled);
    FilterConfiguration off = plain, on = plain;
    off.features.wallEnds = false;
    off.features.minWall = 0.3, off.features.maxRadius = 5, off.features.sigma = 0.02;
    off.features.floor = 0.1, off.features.minCount = 1, off.features.pruneInterval = 3;
    on.features.enabled = true;
    HybridFilter without(plain), switchedOff(off), with(on);
    for (HybridFilter* filter : {&without, &switchedOff, &with}) process(*filter, drive, 0, drive.size());
    EXPECT_TRUE(bytesOf(switchedOff) == bytesOf(without));
    EXPECT_TRUE(without.bestMap().features.features().empty());
    EXPECT_FALSE(with.bestMap().features.features().empty());
    EXPECT_NE(with.bestPath(), without.bestPath());
  }
}

TEST(HybridFilterState, LoopsCloseAfterReading) {
  const Drive drive = ringDrive(0.03 * kDegree);
  FilterConfiguration c = configuration(ParticleFilterOptions::Proposal::improved);
  expectSameEnd(c, drive, drive.size() / 2);
  expectSameEnd(c, drive, drive.size() - 20);
}

TEST(HybridFilterState, WhatParticlesShareIsWrittenOnceAndSharedAfterReading) {
  Drive drive = ringDrive(0);
  drive.resize(60);
  FilterConfiguration one = configuration(ParticleFilterOptions::Proposal::standard), many = one;
  one.filter.particles = 1, many.filter.particles = 100;
  one.loopClosing.enabled = many.loopClosing.enabled = false;
  HybridFilter small(one), large(many), read100(many);
  process(small, drive, 0, 1);
  process(large, drive, 0, 1);
  EXPECT_LT(bytesOf(large).size(), bytesOf(small).size() + 100 * 1000) << "one map, and 100 particles";
  process(large, drive, 1, drive.size());
  const std::string bytes = bytesOf(large);
  read(read100, bytes);
  EXPECT_EQ(bytesOf(read100).size(), bytes.size());
}

TEST(HybridFilterState, CutBytesAreAnError) {
  Drive drive = ringDrive(0);
  drive.resize(12);
  const FilterConfiguration c = configuration(ParticleFilterOptions::Proposal::improved);
  HybridFilter filter(c);
  process(filter, drive, 0, drive.size());
  const std::string bytes = bytesOf(filter);
  for (size_t length = 0; length < bytes.size(); length += 1 + length / 20) {
    HybridFilter other(c);
    EXPECT_THROW(read(other, bytes.substr(0, length)), StateError) << length;
  }
}

/// Damaged bytes give either an error or a filter that works.
TEST(HybridFilterState, DamagedBytesDoNoHarm) {
  Drive drive = ringDrive(0);
  drive.resize(12);
  const FilterConfiguration c = configuration(ParticleFilterOptions::Proposal::improved);
  HybridFilter filter(c);
  process(filter, drive, 0, drive.size() - 1);
  const std::string bytes = bytesOf(filter);
  RandomStream random(1, 0, 0);
  size_t refused = 0;
  for (int k = 0; k < 300; ++k) {
    std::string damaged = bytes;
    // Most bytes are cells: damage the beginning, which has the counts, as often as all the rest.
    const double size = k % 2 ? 400 : static_cast<double>(bytes.size());
    damaged[static_cast<size_t>(random.uniform() * size)] = static_cast<char>(random.bits());
    HybridFilter other(c);
    try {
      StateReader in(damaged);
      other.load(in);
      process(other, drive, drive.size() - 1, drive.size());
    } catch (const std::exception&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 30u);
}

TEST(HybridFilterState, AnotherCellSizeIsAnError) {
  Drive drive = ringDrive(0);
  FilterConfiguration c = configuration(ParticleFilterOptions::Proposal::improved);
  HybridFilter filter(c);
  process(filter, drive, 0, 5);
  c.grid.resolution = 0.1;
  HybridFilter other(c);
  EXPECT_THROW(read(other, bytesOf(filter)), StateError);
}

TEST(HybridFilter, KeepsTheScansOnlyForAMapToJoin) {
  const Drive drive = ringDrive(0);
  FilterConfiguration c = configuration(ParticleFilterOptions::Proposal::improved);
  for (const bool closesLoops : {false, true}) {
    c.loopClosing.enabled = closesLoops;
    HybridFilter filter(c), second(c);
    filter.expectMap();
    process(filter, drive, 0, 5);
    EXPECT_EQ(filter.updateScans().size(), filter.updates());
    filter.expectNoMap();
    process(filter, drive, 5, 10);
    EXPECT_EQ(filter.updateScans().size(), closesLoops ? filter.updates() : 0);
    read(second, bytesOf(filter));
  }
}

TEST(HybridFilter, MapsOnInTheMapOfAnEarlierRun) {
  const Drive drive = ringDrive(0);
  const size_t half = drive.size() / 2;
  const FilterConfiguration c = configuration(ParticleFilterOptions::Proposal::improved);
  HybridFilter first(c), second(c);
  process(first, drive, 0, half);
  second.expectMap();
  process(second, drive, half, half + 10);
  second.joinMap(first.bestMap(), drive[half + 9].truth);
  process(second, drive, half + 10, drive.size());
  const TPose2D begin = second.bestPath().front(), start = drive[half].truth;
  EXPECT_LT(std::hypot(begin.x - start.x, begin.y - start.y), 0.1);
  const TPose2D end = second.bestPath().back(), truth = drive.back().truth;
  EXPECT_LT(std::hypot(end.x - truth.x, end.y - truth.y), 0.1);
  const auto before = first.bestMap().grid.tiles().bounds(), after = second.bestMap().grid.tiles().bounds();
  EXPECT_LE(after.min.x, before.min.x);
  EXPECT_GE(after.max.x, before.max.x);
  EXPECT_GT(second.bestLines().size(), first.bestLines().size());
}

}  // namespace
}  // namespace hybrid_slam
