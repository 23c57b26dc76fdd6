/// The motion between the scans of a log, from its odometry.
#include "readings/RawlogSource.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "files/TemporaryFolder.h"
#include "readings/LogWarnings.h"
#include "testing/ReplayedLog.h"

namespace hybrid_slam::readings {
namespace {

using test::areNear;
using test::kNaN;
using test::Replayed;
using test::replayed;
using test::scan;
using testing::ElementsAre;

TEST(RawlogSource, ActionObservationPairsSumUpTheOdometry) {
  const test::Log log{test::action({1, 0, 0}), test::frame({scan(10)}),        test::action({1, 0, M_PI / 2}),
                      test::frame({scan(11)}), test::action({0, 0, M_PI / 4}), test::action({1, 0, 0}),
                      test::frame({scan(12)})};
  for (const bool isGzipped : {false, true}) {
    const Replayed r = replayed(log, {}, isGzipped);
    EXPECT_THAT(r.times, areNear({10, 11, 12}));
    EXPECT_THAT(r.x, areNear({0, 1, 1 - std::sqrt(0.5)}))
        << "the distance before the first scan is not counted";
    EXPECT_THAT(r.phi, areNear({0, M_PI / 2, 3 * M_PI / 4}));
    EXPECT_TRUE(r.summary.hasActions);
    EXPECT_FALSE(r.summary.hasOdometryReadings);
    EXPECT_EQ(r.summary.entries, 7u);
    EXPECT_NEAR(r.summary.duration, 2, 1e-6);
  }
}

TEST(RawlogSource, ScansLongBeforeTheFirstOdometryAreCounted) {
  test::Log log, ofTwo;
  for (int i = 0; i < 1600; ++i) {
    const double time = 1000 + 0.1 * i;
    for (test::Log* each : {&log, &ofTwo}) {
      if (i >= 1500) each->push_back(test::odometry(time, {0.1 * i, 0, 0}));
      each->push_back(scan(time, {}, 3));
    }
    ofTwo.push_back(scan(time, {}, 3, "REAR"));
  }
  const Replayed r = replayed(log);  // expects as many readings as `scans` says
  EXPECT_EQ(r.summary.scans, 105u);
  EXPECT_EQ(r.summary.early.count, 1495u);
  EXPECT_EQ(r.summary.early.first, 1u);
  EXPECT_EQ(r.summary.skippedReadings(), 1495u);
  EXPECT_THAT(
      warningsOf(r.summary, "FILE"),
      testing::ElementsAre("1495 scans before the first odometry, other than the last 5: first at entry 1 of "
                           "FILE; skipped"));
  EXPECT_EQ(replayed(ofTwo).summary.scans, 105u) << "readings of both lasers";
  InputOptions ignores;
  ignores.requireOdometry = false;
  EXPECT_EQ(replayed(log, ignores).summary.scans, 1600u);
  log.resize(1500);
  EXPECT_EQ(replayed(log).summary.early.count, 0u) << "no odometry at all";
}

TEST(RawlogSource, OdometryIsInterpolatedAtTheScansOwnTime) {
  const test::Log log{test::odometry(10, {0, 0, 0}),
                      scan(10),
                      scan(10.25),
                      scan(10.5),
                      scan(10.75),
                      test::odometry(11, {1, 0, 0.4}),
                      scan(11),
                      scan(11.5),
                      test::odometry(12, {3, 0, 0.4})};
  for (const bool isGzipped : {false, true}) {
    const Replayed r = replayed(log, {}, isGzipped);
    EXPECT_THAT(r.times, areNear({10, 10.25, 10.5, 10.75, 11, 11.5}));
    EXPECT_THAT(r.x, areNear({0, 0.25, 0.5, 0.75, 1, 2}));
    EXPECT_THAT(r.phi, areNear({0, 0.1, 0.2, 0.3, 0.4, 0.4}));
  }
}

TEST(RawlogSource, HeadingsAreInterpolatedTheShorterWay) {
  const Replayed r = replayed({test::odometry(0, {0, 0, 0}), scan(0), test::odometry(1, {0, 0, M_PI - 0.1}),
                               scan(1.5), test::odometry(2, {0, 0, -M_PI + 0.1}), scan(2)});
  EXPECT_THAT(std::abs(r.phi[1]), testing::DoubleNear(M_PI, 1e-6));
  EXPECT_NEAR(r.phi[2], -M_PI + 0.1, 1e-6);
}

TEST(RawlogSource, MotionIsInTheRobotsFrame) {
  const files::TemporaryFolder folder;
  const std::string path = test::writePlain(
      folder.path("log"),
      {test::odometry(0, {5, 5, M_PI / 2}), scan(0), test::odometry(1, {5, 7, M_PI / 2}), scan(1)});
  RawlogSource source(path, {}, summarise(path, {}));
  const auto first = source.next()->motion, second = source.next()->motion;
  EXPECT_EQ(first, mrpt::math::TPose2D(0, 0, 0));
  EXPECT_NEAR(second.x, 2, 1e-9);
  EXPECT_NEAR(second.y, 0, 1e-9);
}

TEST(RawlogSource, ScansBeforeTheFirstOdometryHaveItsPose) {
  for (const double time : {9., test::kNoTime}) {
    const Replayed r = replayed({scan(time), scan(time), test::odometry(10, {7, 0, 0}), scan(10),
                                 test::odometry(11, {8, 0, 0}), scan(11)});
    EXPECT_THAT(r.x, areNear({0, 0, 0, 1})) << "no jump from the origin to the first reading";
  }
}

TEST(RawlogSource, ScansAfterTheLastOdometryHaveItsPose) {
  const Replayed r = replayed(
      {test::odometry(10, {0, 0, 0}), scan(10), test::odometry(11, {1, 0, 0}), scan(11.2), scan(11.4)});
  EXPECT_THAT(r.x, areNear({0, 1, 1}));
}

TEST(RawlogSource, EqualTimestamps) {
  const Replayed r = replayed(
      {test::odometry(10, {0, 0, 0}), scan(10), scan(10), test::odometry(10, {1, 0, 0}), scan(10, {1, 0, 0}),
       test::odometry(10, {2, 0, 0}), test::odometry(10, {3, 0, 0}), scan(10, {3, 0, 0})});
  EXPECT_THAT(r.x, areNear({0, 0, 1, 3})) << "log order kept";
  EXPECT_EQ(r.summary.repeatedStamps.count, 3u);
  EXPECT_EQ(r.summary.repeatedStamps.first, 3u);
  EXPECT_EQ(r.summary.stepsBack.count, 0u);
}

TEST(RawlogSource, TimestampsSteppingBackKeepTheOrderOfTheLog) {
  const Replayed r = replayed({test::odometry(10, {0, 0, 0}), scan(10), test::odometry(11, {1, 0, 0}),
                               scan(10.5), test::odometry(10.8, {2, 0, 0}), scan(10.9),
                               test::odometry(10.7, {3, 0, 0}), scan(11.5), test::odometry(11.6, {4, 0, 0})});
  EXPECT_THAT(r.times, areNear({10, 10.5, 10.9, 11.5}));
  EXPECT_THAT(r.x, areNear({0, 0.5, 2, 3 + 0.8 / 0.9}));
  EXPECT_EQ(r.summary.stepsBack.count, 0u);
  const Replayed back = replayed(
      {test::odometry(10, {0, 0, 0}), scan(10), test::odometry(12, {1, 0, 0}), scan(12), scan(11), scan(13)});
  EXPECT_THAT(back.times, areNear({10, 12, 11, 13}));
  EXPECT_EQ(back.summary.stepsBack.count, 1u);
  EXPECT_EQ(back.summary.stepsBack.first, 5u);
  EXPECT_NEAR(back.summary.duration, 3, 1e-6);
}

TEST(RawlogSource, AnImpossibleTimestampIsNotPartOfTheDuration) {
  for (const double wrong : {4e9, 1.0}) {
    const Replayed r = replayed({test::odometry(1e9, {0, 0, 0}), scan(1e9), scan(1e9 + 1), scan(wrong),
                                 scan(1e9 + 2), scan(1e9 + 4)});
    EXPECT_EQ(r.summary.timeJumps.count, 1u);
    EXPECT_NEAR(r.summary.duration, 3, 1e-6) << "the steps around it are not known";
  }
}

TEST(RawlogSource, LasersWithClocksThatDifferDoNotLengthenTheDuration) {
  test::Log log{test::odometry(1e9, {0, 0, 0})};
  for (int i = 0; i < 10; ++i) {
    log.push_back(scan(1e9 + i, {}, 3));
    log.push_back(scan(1e9 + i + 1.5, {}, 3, "REAR"));
    if (i == 4) log.push_back(scan(4e9, {}, 3));
  }
  EXPECT_NEAR(replayed(log).summary.duration, 5.5 + 5.5, 1e-6) << "9 s of each laser, and a clock ahead";
}

TEST(RawlogSource, FaultsOfActionsThatReadingsReplaceDoNotCount) {
  for (const bool hasReadings : {false, true}) {
    test::Log log;
    for (int i = 0; i < 4; ++i) {
      if (hasReadings) log.push_back(test::odometry(10 + i, {0.1 * i, 0, 0}));
      log.push_back(test::action({i == 2 ? 200. : 0.1, 0, 0}));
      log.push_back(scan(10 + i));
    }
    log.push_back(test::action({std::nan(""), 0, 0}));
    const Replayed r = replayed(log);
    EXPECT_EQ(r.summary.jumps.count, hasReadings ? 0u : 1u);
    EXPECT_EQ(r.summary.wrongOdometry.count, hasReadings ? 0u : 1u);
  }
}

TEST(RawlogSource, SaysWhichOdometryItUses) {
  test::Log log;
  for (int i = 0; i < 4; ++i) {
    const auto other = test::odometry(10.5 + i, {-50.0 * i, 0, 0});
    other->sensorLabel = "VISUAL";
    for (const auto& each : test::Log{test::odometry(10 + i, {0.1 * i, 0, 0}), scan(10 + i), other})
      log.push_back(each);
  }
  const Replayed r = replayed(log);
  EXPECT_EQ(r.summary.jumps.count, 0u);
  EXPECT_EQ(r.summary.otherOdometry.count, 4u);
  EXPECT_THAT(
      warningsOf(r.summary, "LOG"),
      testing::ElementsAre("4 odometry readings of other sensors than `ODOMETRY`: first at entry 3 of LOG; "
                           "not used; --odometry-topic chooses a sensor"));
  EXPECT_THAT(r.x, areNear({0, 0.1, 0.2, 0.3}));
}

TEST(RawlogSource, RangesInMillimetresAreReported) {
  test::Log log{test::odometry(10, {0, 0, 0})};
  for (int i = 0; i < 10; ++i) {
    const auto inMillimetres = scan(10 + i, {}, 3);
    inMillimetres->maxRange = 80;
    for (size_t k = 0; k < 3; ++k) inMillimetres->setScanRange(k, i == 0 && k == 0 ? 1.f : 3000.f);
    log.push_back(inMillimetres);
  }
  EXPECT_THAT(
      warningsOf(replayed(log).summary, "LOG"),
      ElementsAre(
          "only 1 of 30 ranges are above 0 and below the laser's maximum: LOG; expected ranges in metres"));
}

TEST(RawlogSource, TheFirstOdometryMayHaveNoLabel) {
  test::Log log;
  for (int i = 0; i < 4; ++i) {
    const auto unnamed = test::odometry(10 + i, {0.1 * i, 0, 0}),
               other = test::odometry(10.5 + i, {-5. * i, 0, 0});
    unnamed->sensorLabel.clear();
    other->sensorLabel = "VISUAL";
    for (const auto& each : test::Log{unnamed, scan(10 + i), other}) log.push_back(each);
  }
  const Replayed r = replayed(log);
  EXPECT_THAT(r.x, areNear({0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(r.summary.odometryLabel, "");
  EXPECT_EQ(r.summary.otherOdometry.count, 4u);
}

TEST(RawlogSource, UsesTheNamedOdometry) {
  test::Log log;
  for (int i = 0; i < 4; ++i) {
    const auto other = test::odometry(10 + i, {-5. * i, 0, 0});
    other->sensorLabel = "VISUAL";
    for (const auto& each : test::Log{test::odometry(10 + i, {0.1 * i, 0, 0}), scan(10 + i), other})
      log.push_back(each);
  }
  InputOptions options;
  options.odometryTopic = "VISUAL";
  const Replayed r = replayed(log, options);
  EXPECT_THAT(r.x, areNear({0, -5, -10, -15}));
  EXPECT_EQ(r.summary.otherOdometry.count, 4u);
  EXPECT_EQ(r.summary.otherOdometry.first, 1u);
  options.odometryTopic = "GPS";
  EXPECT_THAT(replayed(log, options).error, testing::HasSubstr("no odometry readings of the sensor `GPS`: "));
  EXPECT_THAT(replayed(log, options).error, testing::HasSubstr("the log has `ODOMETRY`, `VISUAL`"));
  const test::Log ofActions{test::action({1, 0, 0}), test::frame({scan(10)})};
  EXPECT_THAT(replayed(ofActions, options).error, testing::HasSubstr("the log has none"));
}

TEST(RawlogSource, LasersThatTakeTurnsHaveTheDurationOfBoth) {
  test::Log log{test::odometry(1e9, {0, 0, 0})};
  for (int i = 0; i < 10; ++i) log.push_back(scan(1e9 + i, {}, 3, i < 5 ? "FRONT" : "REAR"));
  EXPECT_NEAR(replayed(log).summary.duration, 9, 1e-6);
}

TEST(RawlogSource, LasersWithClocksAYearApartHaveTheDurationOfOne) {
  test::Log log{test::odometry(1e9, {0, 0, 0})};
  for (int i = 0; i < 10; ++i) {
    log.push_back(scan(1e9 + i, {}, 3));
    log.push_back(scan(1e9 + 3e7 + i, {}, 3, "REAR"));
  }
  EXPECT_NEAR(replayed(log).summary.duration, 9, 1e-6);
}

TEST(RawlogSource, AStepBackByYearsIsNotPartOfTheDuration) {
  const Replayed r =
      replayed({test::odometry(3e9, {0, 0, 0}), scan(3e9), scan(3e9 + 2), scan(1e8), scan(1e8 + 3)});
  EXPECT_NEAR(r.summary.duration, 5, 1e-6);
}

TEST(RawlogSource, MissingTimestamps) {
  const Replayed r = replayed({test::odometry(10, {0, 0, 0}), scan(10), test::odometry(11, {1, 0, 0}),
                               scan(test::kNoTime), test::odometry(12, {2, 0, 0}), scan(12)});
  EXPECT_THAT(r.times, areNear({10, 10, 12})) << "that of the previous scan";
  EXPECT_THAT(r.x, areNear({0, 1, 2}));
  EXPECT_EQ(r.summary.unstamped.count, 1u);
  EXPECT_EQ(r.summary.unstamped.first, 4u);

  const Replayed none = replayed({test::odometry(test::kNoTime, {0, 0, 0}), scan(test::kNoTime),
                                  test::odometry(test::kNoTime, {1, 0, 0}), scan(test::kNoTime, {1, 0, 0})});
  EXPECT_THAT(none.times, areNear({0, 0}));
  EXPECT_THAT(none.x, areNear({0, 1}));
  EXPECT_EQ(none.summary.duration, 0);

  const Replayed unstampedOdometry = replayed({test::odometry(test::kNoTime, {0, 0, 0}), scan(10),
                                               test::odometry(test::kNoTime, {1, 0, 0}), scan(11)});
  EXPECT_THAT(unstampedOdometry.x, areNear({0, 1}));
}

TEST(RawlogSource, AnUnstampedScanDoesNotOvertakeAWaitingOne) {
  const Replayed r = replayed({test::odometry(10, {0, 0, 0}), scan(10.5, {}, 3), scan(test::kNoTime, {}, 4),
                               test::odometry(11, {1, 0, 0})});
  ASSERT_EQ(r.scans.size(), 2u);
  EXPECT_EQ(r.scans[0]->getScanSize(), 3u);
  EXPECT_THAT(r.x, areNear({0, -0.5}));
}

TEST(RawlogSource, AcrossALargeGapThePreviousOdometryIsUsed) {
  const test::Log log{test::odometry(10, {0, 0, 0}), scan(10), scan(10.5), test::odometry(11.5, {3, 0, 0}),
                      scan(11.5)};
  EXPECT_THAT(replayed(log).x, areNear({0, 0, 3}));
  InputOptions options;
  options.maxOdometryGap = 1.5;
  EXPECT_THAT(replayed(log, options).x, areNear({0, 1, 3}));
}

TEST(RawlogSource, MemoryDoesNotGrowWhereOdometryEnds) {
  test::Log log{test::odometry(0, {0, 0, 0})};
  for (int i = 0; i < 100; ++i) log.push_back(scan(0.1 * i));
  const Replayed r = replayed(log);
  for (size_t i = 0; i < r.entries.size(); ++i) EXPECT_LE(r.entries[i], i + 14) << "within the gap of 1 s";
}

TEST(RawlogSource, MemoryDoesNotGrowWhereTimeStandsStill) {
  test::Log log{test::odometry(0, {0, 0, 0})};
  for (int i = 0; i < 3000; ++i) log.push_back(scan(0.5));
  const Replayed r = replayed(log);
  ASSERT_EQ(r.entries.size(), 3000u);
  for (size_t i = 0; i < r.entries.size(); ++i) EXPECT_LE(r.entries[i], i + 1010);
}

TEST(RawlogSource, OdometryInsideOfFrames) {
  test::Log log;
  for (int i = 0; i < 3; ++i) {
    auto both = test::frame({});
    both->insert(test::odometry(10 + i, {2. * i, 0, 0}));
    both->insert(scan(10.5 + i));
    log.push_back(both);
  }
  EXPECT_THAT(replayed(log).x, areNear({0, 2, 3}));
}

TEST(RawlogSource, NoOdometry) {
  const test::Log log{scan(10), scan(11), scan(12)};
  EXPECT_THAT(replayed(log).x, areNear({0, 0, 0}));
  EXPECT_THAT(replayed(log).entries, ElementsAre(1u, 2u, 3u)) << "scans do not wait";
  EXPECT_FALSE(replayed(log).summary.hasMotion);
  const test::Log withOdometry{test::odometry(1, {}), scan(1), test::odometry(2, {1, 0, 0}), scan(2)};
  EXPECT_THAT(replayed(withOdometry).x, areNear({0, 1}));
  EXPECT_TRUE(replayed(withOdometry).summary.hasMotion);
  const test::Log standing{test::action({}), test::frame({scan(1)}), test::action({}),
                           test::frame({scan(2)})};
  EXPECT_TRUE(replayed(standing).summary.hasActions);
  EXPECT_FALSE(replayed(standing).summary.hasMotion);
}

TEST(RawlogSource, OdometryOfTheHeadingAlone) {
  for (const test::Log& log :
       {test::Log{test::odometry(1, {3, 4, 0}), scan(1), test::odometry(2, {3, 4, 0.2}), scan(2)},
        test::Log{test::action({}), test::frame({scan(1)}), test::action({0, 0, 0.2}),
                  test::frame({scan(2)})}}) {
    EXPECT_FALSE(replayed(log).summary.hasMotion);
    EXPECT_TRUE(replayed(log).summary.hasTurns);
  }
  EXPECT_FALSE(replayed({test::odometry(1, {3, 4, 0}), scan(1), test::odometry(2, {3, 4, 0}), scan(2)})
                   .summary.hasTurns);
}

TEST(RawlogSource, OdometryOfEitherFormIsIgnoredOnRequest) {
  readings::InputOptions options;
  options.requireOdometry = false;
  for (const test::Log& log :
       {test::Log{test::odometry(1, {}), scan(1), test::odometry(2, {1, 0, 0}), scan(2)},
        test::Log{test::action({}), test::frame({scan(1)}), test::action({1, 0, 0}), test::frame({scan(2)})}})
    EXPECT_THAT(replayed(log, options).x, areNear({0, 0}));
  const Replayed apart = replayed({test::action({}), test::frame({scan(1, {}, 3, "FRONT")}),
                                   test::action({20, 0, 0}), test::frame({scan(1.02, {}, 3, "REAR")})},
                                  options);
  ASSERT_EQ(apart.allScans.size(), 2u) << "a laser that is not known yet begins a reading";
  for (const Scans& scans : apart.allScans) EXPECT_EQ(scans[0]->sensorPose.norm(), 0);
}

TEST(RawlogSource, EmptyActionsAreNoOdometry) {
  const auto nothing = mrpt::obs::CActionCollection::Create();
  EXPECT_FALSE(replayed({nothing, test::frame({scan(1)})}).summary.hasActions);
  const Replayed r = replayed({nothing, test::frame({scan(1)}), test::action({1, 0, 0}),
                               test::frame({scan(2)}), nothing, test::frame({scan(3)})});
  EXPECT_THAT(r.x, areNear({0, 1, 1}));
}

TEST(RawlogSource, OdometryThatIsNotFiniteIsIgnored) {
  const Replayed r =
      replayed({test::odometry(10, {kNaN, 0, 0}), test::odometry(10, {0, 0, 0}), scan(10),
                test::odometry(11, {1, kNaN, 0}), scan(11), test::odometry(12, {HUGE_VAL, 0, 0}),
                test::odometry(12, {2, 0, 0}), scan(12)});
  EXPECT_THAT(r.x, areNear({0, 0, 2}));
  EXPECT_EQ(r.summary.wrongOdometry.count, 3u);
  EXPECT_EQ(r.summary.wrongOdometry.first, 1u);
  EXPECT_FALSE(replayed({test::odometry(10, {kNaN, 0, 0}), scan(10)}).summary.hasOdometryReadings);
  EXPECT_THAT(replayed({test::action({1, 0, 0}), test::frame({scan(1)}), test::action({kNaN, 0, 0}),
                        test::frame({scan(2)})})
                  .x,
              areNear({0, 0}));
}

}  // namespace
}  // namespace hybrid_slam::readings
