#include "run/LoopNote.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

namespace hybrid_slam::run {
namespace {

TEST(LoopNote, SaysWhereByHowMuchAndOnWhatEvidence) {
  LoopClosure loop;
  loop.place = {12.34, -5.67, 1};
  loop.earlier = 1, loop.later = 3;
  loop.shift = 4.256, loop.turn = mrpt::DEG2RAD(2.34);
  loop.fit = 0.918, loop.second = 0.551;
  loop.matches = 3;
  const std::vector<double> times{1000, 1010.26, 1020, 1137.49, 1200};
  const std::string evidence =
      " at (12.3, -5.7) m between 1010.3 s and 1137.5 s: path moved by up to 4.26 m and 2.3 deg; 3 matches "
      "agree, at least 92 % of their walls fit, other places score 55 % of theirs";
  EXPECT_EQ(loopNote(loop, times, false), "loop closed" + evidence);
  loop.earlier.reset();
  EXPECT_EQ(loopNote(loop, times, false)
                .find("loop closed at (12.3, -5.7) m between the earlier map and 1137.5 s: "),
            0u);
  loop.earlier = 1;
  EXPECT_EQ(loopNote(loop, times, true), "loop closed in the refinement" + evidence);
}

}  // namespace
}  // namespace hybrid_slam::run
