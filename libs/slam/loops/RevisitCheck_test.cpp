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
  const auto count = std::count_if(revisits.begin(), revisits.end(),
                                   [](const Revisit& revisit) { return revisit.isContradicted(); });
  return static_cast<double>(count) / static_cast<double>(revisits.size());
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

TEST(RevisitCheck, AContradictedScanHasThreeOfTenBeamsAgainstIt) {
  Revisit revisit;
  revisit.compared = 100, revisit.contradicted = 30;
  EXPECT_FALSE(revisit.isContradicted());
  revisit.contradicted = 31;
  EXPECT_TRUE(revisit.isContradicted());
  EXPECT_FALSE(Revisit().isContradicted());
}

}  // namespace
}  // namespace hybrid_slam
