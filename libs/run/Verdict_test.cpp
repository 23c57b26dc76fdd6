#include "run/Verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/Degree.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPose2D;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Level = Verdict::Level;

/// Scans every 0.5 m along the x axis; those in [first, last) are contradicted.
std::vector<Revisit> scans(size_t count, size_t first = 0, size_t last = 0) {
  std::vector<Revisit> all;
  for (size_t i = 0; i < count; ++i) {
    Revisit revisit;
    revisit.distance = 0.5 * static_cast<double>(i), revisit.pose.x = revisit.distance, revisit.update = i;
    revisit.compared = 50, revisit.contradicted = i >= first && i < last ? 40 : 2;
    all.push_back(revisit);
  }
  return all;
}

Verdict of(const std::vector<Revisit>& returning, const std::vector<Revisit>& recent = scans(200)) {
  Evidence evidence;
  evidence.returning = returning, evidence.recent = recent;
  return verdictOf(evidence);
}

TEST(Verdict, NoContradictionIsConsistent) {
  const Verdict verdict = of(scans(100));
  EXPECT_EQ(verdict.level, Level::consistent);
  EXPECT_THAT(verdict.reasons, IsEmpty());
  EXPECT_THAT(verdict.places, IsEmpty());
  EXPECT_EQ(verdict.line(), "verdict: consistent");
}

TEST(Verdict, FewBeamsCannotConfirmAMap) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.recent = scans(200);
  evidence.beams = 31;
  EXPECT_EQ(verdictOf(evidence).level, Level::consistent);
  evidence.beams = 12;
  EXPECT_EQ(verdictOf(evidence).line(),
            "verdict: doubtful: scans have too few beams to judge the map: 12 on average");
}

TEST(Verdict, ScansFarApartCannotConfirmAMap) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.recent = scans(200);
  evidence.spacing = 1.2;
  EXPECT_EQ(verdictOf(evidence).level, Level::consistent);
  evidence.spacing = 1.75;
  EXPECT_EQ(verdictOf(evidence).line(), "verdict: doubtful: scans are too far apart to judge the map: 1.8 m");
}

TEST(Verdict, LasersThatSeeDifferentWallsAreInDoubt) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.recent = scans(200);
  evidence.lasers = {{"REAR", "FRONT", 0.5 * kDegree, 50}};
  EXPECT_EQ(verdictOf(evidence).level, Level::consistent);
  evidence.lasers[0].turn = -1.5 * kDegree;
  EXPECT_THAT(verdictOf(evidence).line(),
              HasSubstr("doubtful: laser `REAR` sees the walls turned by 1.5 deg against laser `FRONT`"));
}

TEST(Verdict, AGapBetweenTheScansIsInDoubt) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.recent = scans(200);
  evidence.gap = {2.9, {1, 0}};
  EXPECT_EQ(verdictOf(evidence).level, Level::consistent);
  evidence.gap = {20, {1.5, 2}};
  EXPECT_EQ(verdictOf(evidence).line(),
            "verdict: doubtful: no scans along 20.0 m of odometry from (1.5, 2.0) m on");
}

TEST(Verdict, ScansBeforeAllOdometryAreInDoubtIfManyAreNotUsed) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.recent = scans(200);
  evidence.early = 10, evidence.scans = 90;
  EXPECT_EQ(verdictOf(evidence).level, Level::consistent);
  evidence.early = 995, evidence.scans = 5;
  EXPECT_EQ(verdictOf(evidence).line(),
            "verdict: doubtful: 100 % of 1000 scans are not used: they are older than all odometry");
}

TEST(Verdict, SaysThatNoPlaceWasSeenTwice) {
  EXPECT_EQ(of({}).line(), "verdict: consistent: no place was seen twice");
  EXPECT_EQ(of({}, {}).level, Level::consistent);
}

TEST(Verdict, MostReturningScansContradictedIsLost) {
  const Verdict verdict = of(scans(100, 40, 100));
  EXPECT_EQ(verdict.name(), "lost");
  EXPECT_THAT(verdict.reasons[0],
              testing::StrEq("60 % of 100 returning scans contradict what was mapped before"));
  EXPECT_THAT(verdict.line(), HasSubstr("longest at (35.0, 0.0) m"));
}

TEST(Verdict, SomeReturningScansContradictedIsDoubtful) {
  EXPECT_EQ(of(scans(100, 40, 52)).level, Level::consistent);
  EXPECT_EQ(of(scans(100, 40, 53)).level, Level::doubtful);
  EXPECT_TRUE(of(scans(100, 40, 53)).isContradicted);
  EXPECT_EQ(of(scans(100, 40, 90)).level, Level::doubtful);
  EXPECT_EQ(of(scans(100, 40, 91)).level, Level::lost);
}

TEST(Verdict, FewScansAreDoubtfulAtMost) {
  EXPECT_EQ(of(scans(3, 0, 3)).level, Level::doubtful);
  EXPECT_EQ(of(scans(1, 0, 1)).level, Level::doubtful) << "all there are";
  EXPECT_EQ(of(scans(4, 0, 1)).level, Level::consistent) << "one may be a person";
  EXPECT_EQ(of(scans(4, 0, 4)).level, Level::lost);
}

TEST(Verdict, ScansThatDoNotFitTheirSurroundings) {
  const auto everySecond = [](size_t count) {  // not successive
    std::vector<Revisit> recent = scans(100);
    for (size_t i = 0; i < count; ++i) recent[10 + 2 * i].contradicted = 40;
    return recent;
  };
  EXPECT_EQ(of({}, everySecond(12)).level, Level::consistent);
  EXPECT_EQ(of({}, everySecond(20)).level, Level::doubtful);
  EXPECT_EQ(of({}, everySecond(30)).level, Level::lost);
}

TEST(Verdict, OneLongPlaceIsDoubtfulInALargeMap) {
  const Verdict verdict = of(scans(2000, 100, 140));
  EXPECT_EQ(verdict.level, Level::doubtful);
  ASSERT_EQ(verdict.places.size(), 1u);
  EXPECT_NEAR(verdict.places[0].at.x, 60, 1e-9);
  EXPECT_NEAR(verdict.places[0].length, 19.5, 1e-9);
  EXPECT_EQ(verdict.places[0].update, 120u);
  EXPECT_EQ(of(scans(2000, 100, 120)).level, Level::consistent);
}

/// A share of 4 % of the path: the rule on the share does not see it.
TEST(Verdict, SuccessiveScansThatContradictTheirSurroundingsAreAJump) {
  const Verdict verdict = of({}, scans(100, 40, 43));
  EXPECT_EQ(
      verdict.line(),
      "verdict: doubtful: the path may have jumped at (20.5, 0.0) m: successive scans contradict what was "
      "mapped just before; no place was seen twice; longest at (20.5, 0.0) m");
  EXPECT_EQ(of(scans(100), scans(100, 40, 42)).level, Level::consistent) << "people";
  std::vector<Revisit> recent = scans(100, 40, 46);
  recent[42].contradicted = 2;
  EXPECT_EQ(of(scans(100), recent).level, Level::doubtful);
  recent[44].contradicted = 2;
  EXPECT_EQ(of(scans(100), recent).level, Level::consistent) << "not successive";
  for (Revisit& scan : recent) scan.contradicted = std::min<size_t>(scan.contradicted, 20);
  for (size_t i = 40; i < 46; ++i) recent[i].contradicted = 20;
  EXPECT_EQ(of(scans(100), recent).level, Level::consistent) << "40 % of the beams";
}

TEST(Verdict, PeopleDoNotCountForTheLevelButForAnotherRun) {
  std::vector<Revisit> seen = scans(100, 20, 90);
  for (Revisit& scan : seen) scan.narrow = scan.contradicted / 40 * 38;
  const Verdict among = of(seen);
  EXPECT_EQ(among.line(),
            "verdict: consistent: scans contradict the map, but only at narrow things, such as people");
  EXPECT_TRUE(among.isContradicted) << "another run may be better";
  EXPECT_NEAR(among.contradiction, 0.7, 1e-9);
  EXPECT_TRUE(among.isWorseThan(of(scans(100))));
}

TEST(Verdict, PeopleAreNoJumpAndDoNotHideOne) {
  std::vector<Revisit> seen = scans(100, 40, 46);
  for (Revisit& scan : seen) scan.narrow = scan.contradicted / 40 * 38;
  EXPECT_EQ(of(scans(100), seen).level, Level::consistent) << "2 of the other 12 beams";
  EXPECT_TRUE(of(scans(100), seen).isContradicted) << "another run may be better";
  for (Revisit& scan : seen) scan.narrow = scan.contradicted / 40 * 20;
  EXPECT_THAT(of(scans(100), seen).line(), HasSubstr("doubtful: the path may have jumped at (21.5, 0.0) m"));
}

TEST(Verdict, PlacesAreSeparateAndTheLongestComesFirst) {
  std::vector<Revisit> revisits = scans(100, 10, 15);
  for (size_t i = 60; i < 80; ++i) revisits[i].contradicted = 40;
  revisits[30].contradicted = 40;  // alone: a person
  const Verdict verdict = of(revisits);
  ASSERT_EQ(verdict.places.size(), 2u);
  EXPECT_NEAR(verdict.places[0].at.x, 35, 1e-9);
  EXPECT_NEAR(verdict.places[1].at.x, 6, 1e-9);
}

TEST(Verdict, ScansThatContradictTheEarlierMap) {
  const auto against = [](size_t contradicted, size_t count) {
    Evidence evidence;
    evidence.returning = scans(100), evidence.recent = scans(200);
    evidence.earlier = scans(count, 0, contradicted);
    return verdictOf(evidence);
  };
  EXPECT_EQ(against(30, 100).level, Level::consistent) << "the building has changed";
  EXPECT_EQ(against(31, 100).level, Level::doubtful);
  EXPECT_FALSE(against(31, 100).isContradicted) << "a second run would find the same place";
  EXPECT_EQ(against(51, 100).line(),
            "verdict: lost: 51 % of 100 scans contradict the map that the run continues");
  EXPECT_EQ(against(3, 3).level, Level::consistent) << "too few";
}

/// Of two runs over a log: the level decides, then the contradicted shares.
TEST(Verdict, WorseIsALowerLevelOrMoreContradiction) {
  const Verdict good = of(scans(100, 0, 5)), bent = of(scans(100, 0, 30)), lost = of(scans(100, 0, 60));
  const Verdict more = of(scans(200, 0, 62)), jumped = of(scans(100, 0, 30), scans(200, 40, 43));
  EXPECT_NEAR(good.contradiction, 0.05, 1e-9);
  EXPECT_NEAR(jumped.contradiction, 0.3 + 0.015, 1e-9);
  for (const auto& [worse, better] :
       {std::pair(lost, bent), std::pair(bent, good), std::pair(more, bent), std::pair(jumped, bent)}) {
    EXPECT_TRUE(worse.isWorseThan(better)) << worse.line() << better.line();
    EXPECT_FALSE(better.isWorseThan(worse)) << worse.line() << better.line();
  }
  EXPECT_FALSE(bent.isWorseThan(bent));
  Evidence spread;  // doubtful for another reason, with 10 % of contradicted scans
  spread.returning = scans(100, 0, 10), spread.recent = scans(200), spread.spread = 1.5;
  const Verdict jump = of(scans(100), scans(200, 40, 43));
  EXPECT_TRUE(jump.isWorseThan(verdictOf(spread)));
  EXPECT_FALSE(verdictOf(spread).isWorseThan(jump));
}

TEST(Verdict, HypothesesThatDisagreeAreDoubtful) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.spread = 1.5, evidence.slips = 2;
  const Verdict verdict = verdictOf(evidence);
  EXPECT_EQ(verdict.level, Level::doubtful);
  EXPECT_FALSE(verdict.isContradicted);
  EXPECT_THAT(verdict.reasons, ElementsAre("hypotheses still disagree at the end: spread 1.5 m",
                                           "odometry rejected in 2 updates"));
}

TEST(Verdict, OdometryThatIsMostlyBrokenIsDoubtful) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.scans = 100;
  evidence.odometryFaults = 10;
  EXPECT_EQ(verdictOf(evidence).level, Level::consistent);
  evidence.odometryFaults = 11;
  EXPECT_EQ(verdictOf(evidence).line(),
            "verdict: doubtful: 11 odometry readings are impossible or jump, in 100 scans");
  EXPECT_FALSE(verdictOf(evidence).isContradicted);
}

TEST(Verdict, AMapThatWasNotComparedToItsEndIsDoubtful) {
  Evidence evidence;
  evidence.notCompared = "out of memory";
  EXPECT_EQ(verdictOf(evidence).line(),
            "verdict: doubtful: not all scans were compared with the map: out of memory");
}

TEST(Verdict, SlipsAloneAreNoReason) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.slips = 2, evidence.updates = 3;
  EXPECT_EQ(verdictOf(evidence).line(), "verdict: consistent");
  evidence.slips = 9, evidence.updates = 9;
  EXPECT_EQ(verdictOf(evidence).line(), "verdict: consistent");
  evidence.slips = 40, evidence.updates = 200;
  EXPECT_EQ(verdictOf(evidence).line(), "verdict: consistent");
}

TEST(Verdict, SlipsAreListedWithAnyOtherReason) {
  Evidence cut, poor, faulty;
  cut.notCompared = "out of memory";
  poor.beams = 10;
  faulty.odometryFaults = 50;
  for (Evidence evidence : {cut, poor, faulty}) {
    evidence.returning = scans(100), evidence.slips = 1, evidence.updates = 200, evidence.scans = 200;
    EXPECT_EQ(verdictOf(evidence).reasons.size(), 2u);
    EXPECT_EQ(verdictOf(evidence).reasons.back(), "odometry rejected in 1 update");
  }
}

TEST(Verdict, AMapThatIsMirroredIsDoubtful) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.turns = {100, 50};
  EXPECT_EQ(verdictOf(evidence).line(), "verdict: consistent");
  evidence.turns = {17, 9};
  EXPECT_EQ(verdictOf(evidence).line(), "verdict: consistent") << "few turns";
  evidence.turns = {100, 51};
  EXPECT_EQ(verdictOf(evidence).line(),
            "verdict: doubtful: the scans turn against the odometry, 51 of 100 times: the map may be "
            "mirrored; input.laser_pose can say that the laser is upside down");
}

TEST(Verdict, TurnsOfTheOdometryAreComparedWithThoseOfThePath) {
  const auto turn = [](double degrees) { return TPose2D(0.3, 0, degrees * kDegree); };
  std::vector<TPose2D> odometry{{}}, path{{1, 2, 3}};
  const auto move = [&](double byOdometry, double byPath) {
    odometry.push_back(turn(byOdometry));
    path.push_back(path.back() + turn(byPath));
  };
  move(10, 9), move(-10, -12), move(2, -2), move(10, -1), move(10, -9), move(-4, 4), move(-40, 30);
  const Turns turns = turnsOf(odometry, path);
  EXPECT_EQ(turns.all, 6u);
  EXPECT_EQ(turns.against, 3u);
}

TEST(Verdict, OdometryThatIsOftenRejectedIsDoubtful) {
  Evidence evidence;
  evidence.returning = scans(100), evidence.slips = 41, evidence.updates = 200;
  EXPECT_EQ(verdictOf(evidence).line(),
            "verdict: doubtful: odometry rejected in 41 updates: the laser's pose on the robot "
            "(input.laser_pose) or the times of scans and odometry may be wrong");
}

}  // namespace
}  // namespace hybrid_slam::run
