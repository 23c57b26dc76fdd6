#include "slam/loops/RevisitCheck.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

std::vector<Revisit> revisitsOf(const std::vector<DrivenPose>& drive, bool isTrue, double delay = 20) {
  RevisitCheck check(delay);
  TPose2D pose = drive.front().truth;
  double distance = 0;
  for (size_t i = 0; i < drive.size(); ++i) {
    if (i > 0) pose = isTrue ? drive[i].truth : pose + drive[i].motion;
    distance += drive[i].motion.norm();
    if (i % 2 == 0) check.add(pose, beamsToCompare(drive[i].scans), distance, i);
  }
  return check.revisits();
}

double contradictedShare(const std::vector<Revisit>& revisits) {
  return static_cast<double>(contradictedOf(revisits)) / static_cast<double>(revisits.size());
}

TEST(RevisitCheck, ATruePathContradictsNothing) {
  const auto revisits = revisitsOf(ringDrive(0), true);
  ASSERT_GT(revisits.size(), 30u);
  EXPECT_LT(contradictedShare(revisits), 0.05);
  for (const Revisit& revisit : revisits) EXPECT_GT(revisit.distance, 20);
}

TEST(RevisitCheck, AnOpenLoopContradictsWhereItReturns) {
  const auto drive = ringDrive(0.05 * kDegree);
  const auto revisits = revisitsOf(drive, false);
  ASSERT_GT(revisits.size(), 5u);
  EXPECT_GT(contradictedShare(revisits), 0.5);
  const auto first = std::find_if(revisits.begin(), revisits.end(),
                                  [](const Revisit& revisit) { return revisit.isContradicted(); });
  EXPECT_GT(first->distance, 80) << "the ring is 105 m long";
  EXPECT_LT(first->update, drive.size());
}

TEST(RevisitCheck, NothingIsComparedBeforeTheDelay) {
  EXPECT_TRUE(revisitsOf(ringDrive(0), true, 1000).empty());
  EXPECT_GT(revisitsOf(ringDrive(0), true, 2).size(), revisitsOf(ringDrive(0), true).size());
}

TEST(RevisitCheck, ComparesWithAMapOfAnEarlierRun) {
  const auto drive = ringDrive(0);
  GridOptions options;
  options.resolution = RevisitCheck::kResolution;
  OccupancyGrid map(options.resolution);
  for (const DrivenPose& driven : drive) map.insert(ScanBeams(driven.scans), driven.truth, options);
  RevisitCheck here(map), elsewhere(map), unknown(OccupancyGrid(options.resolution));
  for (size_t i = 0; i < 60; ++i) {
    const ScanBeams beams = beamsToCompare(drive[i].scans);
    here.add(drive[i].truth, beams, 0.25 * static_cast<double>(i), i);
    elsewhere.add(TPose2D(0.4, 0.7, 0.3) + drive[i].truth, beams, 0.25 * static_cast<double>(i), i);
    unknown.add(drive[i].truth, beams, 100.0 * static_cast<double>(i), i);
  }
  EXPECT_EQ(here.revisits().size(), 60u) << "from the first scan on";
  EXPECT_LT(contradictedShare(here.revisits()), 0.05);
  ASSERT_GT(elsewhere.revisits().size(), 20u);
  EXPECT_GT(contradictedShare(elsewhere.revisits()), 0.6);
  EXPECT_TRUE(unknown.revisits().empty()) << "the scans themselves are not in the map";
}

/// The true drive, on which three things of `width` m, 1.5 m from the laser, move to and fro.
std::vector<DrivenPose> driveAmong(double width) {
  std::vector<DrivenPose> drive = ringDrive(0);
  for (size_t i = 0; i < drive.size(); ++i)
    for (LaserScan& scan : drive[i].scans)
      for (Beam& beam : scan.beams)
        for (const double bearing : {-50 * kDegree, 0.0, 50 * kDegree}) {
          const double now = bearing + (7 * static_cast<double>(i % 5) - 14) * kDegree;
          if (std::abs(beam.angle - now) < width / 3) beam.range = std::min(beam.range, 1.5);
        }
  return drive;
}

TEST(RevisitCheck, WithoutNarrowThingsPeopleDoNotContradictButBoardsDo) {
  const auto people = revisitsOf(driveAmong(0.4), true), boards = revisitsOf(driveAmong(0.8), true);
  ASSERT_GT(people.size(), 30u);
  EXPECT_GT(contradictedShare(people), 0.3);
  EXPECT_LT(contradictedShare(withoutNarrowThings(people)), 0.05);
  EXPECT_GT(contradictedShare(withoutNarrowThings(boards)), 0.5);
}

TEST(RevisitCheck, AScanOfPeopleAloneContradictsNothing) {
  Revisit revisit;
  revisit.compared = 40, revisit.contradicted = 40, revisit.narrow = 33;
  EXPECT_FALSE(withoutNarrowThings({revisit})[0].isContradicted()) << "7 beams are too few";
  revisit.narrow = 32;
  EXPECT_EQ(withoutNarrowThings({revisit})[0].share(), 1);
  revisit.contradicted = 34;
  EXPECT_EQ(withoutNarrowThings({revisit})[0].share(), 0.25);
  revisit.narrow = revisit.compared = revisit.contradicted;
  EXPECT_FALSE(withoutNarrowThings({revisit})[0].isContradicted());
}

TEST(RevisitCheck, ComparesLongerBeamsOnlyWhereTheMapUsesThem) {
  EXPECT_EQ(RevisitCheck::rangeOf(5.6), 5.6);
  EXPECT_EQ(RevisitCheck::rangeOf(8), 8);
  EXPECT_EQ(RevisitCheck::rangeOf(20), 8);
  EXPECT_EQ(RevisitCheck::rangeOf(80), 32);
}

/// The beams, one per degree, that see a wall along y = `wall` within 8 m.
ScanBeams beamsToWall(const TPose2D& pose, double wall) {
  ScanBeams beams;
  beams.origins = {{0, 0}};
  for (int degree = -90; degree <= 90; ++degree) {
    const double angle = degree * kDegree, height = std::sin(pose.phi + angle);
    if (height * RevisitCheck::rangeOf(20) > wall - pose.y)
      beams.rays.push_back({std::cos(angle), std::sin(angle), (wall - pose.y) / height, 0});
  }
  return beams;
}

/// Compares a scan of a robot at (x, 0), in front of a wall, with earlier ones from near the origin.
Revisit seenAtGrazingAngles(double x, double before, double now) {
  RevisitCheck check(20);
  for (int turn = 0; turn < 12; ++turn) {
    const TPose2D pose(0.05 * turn, 0, 0.3 * turn * kDegree);
    check.add(pose, beamsToWall(pose, before), pose.x, turn);
  }
  const TPose2D back(x, 0, 90 * kDegree);
  ScanBeams beams = beamsToWall(back, now);
  beams.rays.erase(std::remove_if(beams.rays.begin(), beams.rays.end(),
                                  [](const ScanBeams::Ray& ray) { return ray.dirX < 0.7; }),
                   beams.rays.end());
  check.add(back, beams, 40, 12);
  EXPECT_EQ(check.revisits().size(), 1u);
  return check.revisits().empty() ? Revisit() : check.revisits()[0];
}

// Beams that end further along the wall pass through its cells.
TEST(RevisitCheck, AWallSeenAtAGrazingAngleContradictsNothing) {
  for (const double wall : {0.92, 0.95, 0.98, 0.995}) {
    const Revisit revisit = seenAtGrazingAngles(6, wall, wall);
    EXPECT_GT(revisit.compared, 20u) << wall;
    EXPECT_LE(revisit.share(), 0.05) << wall;
  }
  EXPECT_GT(seenAtGrazingAngles(5, 0.995, 0.75).share(), 0.9) << "0.25 m off";
}

TEST(RevisitCheck, AContradictedScanHasMoreThanAFifthOfItsBeamsAgainstIt) {
  Revisit revisit;
  revisit.compared = 100, revisit.contradicted = 20;
  EXPECT_FALSE(revisit.isContradicted());
  revisit.contradicted = 21;
  EXPECT_TRUE(revisit.isContradicted());
  EXPECT_FALSE(Revisit().isContradicted());
}

/// A returning scan, of update `update`, with `contradicted` of its 100 beams against the map.
Revisit returned(size_t update, size_t contradicted) { return {{}, update, 0, 100, contradicted}; }

/// `count` scans from update `first` on.
std::vector<Revisit> returned(size_t first, size_t count, size_t contradicted) {
  std::vector<Revisit> revisits;
  for (size_t i = 0; i < count; ++i) revisits.push_back(returned(first + i, contradicted));
  return revisits;
}

std::vector<Revisit> operator+(std::vector<Revisit> a, const std::vector<Revisit>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(RevisitCheck, ACorrectionThatContradictsMoreScansIsWorse) {
  const auto few = returned(0, 20, 5), many = returned(0, 20, 6);
  EXPECT_TRUE(isMoreContradicted(few, many));
  EXPECT_FALSE(isMoreContradicted(few, few));
  EXPECT_FALSE(isMoreContradicted(many, few));
  EXPECT_FALSE(isMoreContradicted({}, many));
  EXPECT_FALSE(isMoreContradicted(few, {}));
}

TEST(RevisitCheck, ACorrectionIsJudgedByThoseThatReturnedBefore) {
  // The newest scans returned to unknown space; now they return to a place with people.
  const auto older = returned(0, 40, 1);
  EXPECT_FALSE(isMoreContradicted(older, older + returned(60, 40, 15)));
  EXPECT_FALSE(isMoreContradicted(older + returned(40, 5, 0), older + returned(42, 40, 4)));
  // The newest scans contradicted the map; its correction costs less.
  EXPECT_FALSE(isMoreContradicted(older + returned(40, 20, 90), returned(0, 40, 4) + returned(40, 20, 4)));
  // The same, and the newest now return to another place.
  EXPECT_FALSE(isMoreContradicted(older + returned(40, 20, 90), returned(0, 40, 4) + returned(60, 20, 4)));
  // The newest scans fit in their new place; the older ones do not fit any more.
  EXPECT_TRUE(isMoreContradicted(older + returned(40, 20, 10), returned(0, 40, 12) + returned(40, 20, 0)));
}

TEST(RevisitCheck, FewScansOrBeamsDoNotJudgeACorrection) {
  EXPECT_FALSE(isMoreContradicted(returned(0, 19, 5), returned(0, 19, 60)));
  const auto before = returned(0, 400, 5);
  auto after = before;
  for (size_t i = 0; i < 140; ++i) after[i].contradicted = 6;
  EXPECT_FALSE(isMoreContradicted(before, after)) << "0.35 %";
  after[140].contradicted = 7;
  EXPECT_TRUE(isMoreContradicted(before, after));
}

}  // namespace
}  // namespace hybrid_slam
